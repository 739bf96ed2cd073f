// SPDX-License-Identifier: MIT
#include "study_app/panel_window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>

#include "study_app/page_parts.h"

namespace study_app {
namespace {

constexpr double kNewS = 1;

}  // namespace

void PanelWindow::toggle() {
    if (window_) {
        window_.reset();
    } else {
        const auto px = [&](float atScale1) {
            return static_cast<int>(std::lround(atScale1 * study_.uiScale()));
        };
        const WindowOptions options{.widthPx = px(1180),
                                    .heightPx = px(920),
                                    .uiScale = uiScale_,
                                    .title = "Stairwell experimenter"};
        window_ = std::make_unique<Window>(options, study_);
        opened_ = Window::now();
        noteChange();
    }
    study_.makeCurrent();
}

void PanelWindow::takeInput() {
    if (!window_) return;
    // Window managers may hand the keyboard to a window that is new.
    if (Window::now() < opened_ + kNewS && window_->focused()) study_.takeKeyboard();
    Input& input = window_->input();
    const auto isF2 = [](const Input::Press& press) { return press.key == GLFW_KEY_F2; };
    const bool close = input.closeRequested || std::ranges::any_of(input.presses, isF2);
    if (input.any) noteChange();
    input.clear();
    if (close) toggle();
}

void PanelWindow::noteChange() {
    framesWanted_ = kFramesToSettle;
}

void PanelWindow::draw(const AppState& state, Screenshots& screenshots) {
    --framesWanted_;
    window_->beginFrame(kPageGrey);
    std::vector<PlacedImage> none;
    drawPanel(state, {*window_, Window::now(), false, none});
    window_->renderInterface();
    const std::string name = state.runner ? "panel" : "panel-before";
    if (framesWanted_ == 0 && screenshots.wanted(name)) {
        screenshots.take(name, window_->readPixels());
    }
    window_->endFrame();
    study_.makeCurrent();
}

}  // namespace study_app

// SPDX-License-Identifier: MIT
#include "demo/demo_window.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>

namespace demo {
namespace {

constexpr int kSmallestFixed = 128;  // key 1; each further digit doubles it
constexpr float kDegreesPerPx = 0.3F;

void orbit(renderer::Renderer& frame, const renderer::WindowInput& input) {
    renderer::OrbitCamera camera = frame.scene().camera;
    camera.yawDeg =
        std::remainder(camera.yawDeg - kDegreesPerPx * static_cast<float>(input.dragX), 360.0F);
    camera.pitchDeg =
        std::clamp(camera.pitchDeg + kDegreesPerPx * static_cast<float>(input.dragY), 2.0F, 88.0F);
    camera.distanceM = std::clamp(
        camera.distanceM * std::pow(0.9F, static_cast<float>(input.scroll)), 1.5F, 40.0F);
    frame.setCamera(camera);
}

std::string titleOf(const ViewState& state, const ChosenResolution& chosen, double frameMs) {
    char ms[32];
    std::snprintf(ms, sizeof ms, "%.1f ms", frameMs);
    return "shadow_demo: " + std::string(renderer::builtInScenes()[state.scene].name) + ", " +
           std::string(renderer::techniques()[state.technique].title) +
           ", N = " + std::to_string(chosen.resolution) +
           (chosen.automatic ? " (auto: " + chosen.reason + ")" : " (fixed)") + ", " + ms;
}

}  // namespace

std::string keyHelp() {
    return "R  automatic or fixed size\n"
           "1..6  fixed size 128, 256, 512, 1024, 2048, 4096\n"
           "T  next technique\n"
           "S  next scene\n"
           "drag, wheel  turn, zoom\n"
           "Esc  close\n";
}

bool applyKey(char key, ViewState& state) {
    if (key >= '1' && key <= '6') {
        state.resolution = kSmallestFixed << (key - '1');
        return true;
    }
    switch (key) {
        case 'R':
            state.resolution = state.resolution ? ResolutionOption() : ResolutionOption(2048);
            return true;
        case 'T':
            state.technique = (state.technique + 1) % renderer::techniques().size();
            return true;
        case 'S':
            state.scene = (state.scene + 1) % renderer::builtInScenes().size();
            return true;
        default:
            return false;
    }
}

void showWindow(renderer::Window& window, const ViewState& start,
                const resolution_controller::Slope& slope,
                const renderer::ParameterValues& parameters, int widthPx, int heightPx, int frames,
                const std::function<void(renderer::Renderer&, ShadowRun&)>& onEnd) {
    ViewState state = start;
    renderer::Renderer frame(window.info(), renderer::builtInScenes()[state.scene].make(), widthPx,
                             heightPx);
    const auto makeRun = [&] {
        const renderer::Technique& technique = renderer::techniques()[state.technique];
        const Softness softness = chooseSoftness(frame, state.radiusM, state.radiusUv);
        return std::make_unique<ShadowRun>(
            frame, window.info(),
            ShadowRun::Settings{.technique = &technique,
                                .parameters = state.technique == start.technique
                                                  ? parameters
                                                  : technique.standardParameters(),
                                .radiusUv = softness.radiusUv,
                                .resolution = state.resolution,
                                .slope = slope});
    };
    auto run = makeRun();
    double smoothMs = 0;
    auto lastTitle = std::chrono::steady_clock::time_point();
    for (int shown = 0; !window.closeWanted() && (frames == 0 || shown < frames); ++shown) {
        const auto begin = std::chrono::steady_clock::now();
        const renderer::WindowInput input = window.poll();
        bool changed = false;
        bool newScene = false;
        for (const char key : input.keys) {
            if (key == '\x1b') return onEnd(frame, *run);
            const std::size_t scene = state.scene;
            changed = applyKey(key, state) || changed;
            newScene = newScene || state.scene != scene;
        }
        if (newScene) frame.setScene(renderer::builtInScenes()[state.scene].make());
        if (changed) run = makeRun();
        if (input.widthPx > 0 && input.heightPx > 0) frame.resize(input.widthPx, input.heightPx);
        orbit(frame, input);
        run->step();
        window.present(frame.litFramebuffer(), frame.widthPx(), frame.heightPx());

        const auto now = std::chrono::steady_clock::now();
        const double ms = std::chrono::duration<double, std::milli>(now - begin).count();
        smoothMs = smoothMs == 0 ? ms : 0.9 * smoothMs + 0.1 * ms;
        if (now - lastTitle > std::chrono::milliseconds(250)) {
            window.setTitle(titleOf(state, run->chosen(), smoothMs));
            lastTitle = now;
        }
    }
    onEnd(frame, *run);
}

}  // namespace demo

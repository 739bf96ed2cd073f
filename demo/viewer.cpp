// SPDX-License-Identifier: MIT
#include "demo/viewer.h"

#include <stdexcept>
#include <utility>

#include "demo/demand_glsl.h"
#include "renderer/scene_file.h"

namespace demo {
namespace {

const ViewerState& checked(const ViewerState& state) {
    if (const std::string problem = validate(state); !problem.empty())
        throw std::invalid_argument(problem);
    return state;
}

/// The softness, in a window that has room for it. A radius given as a share of the window widens
/// with it, so the window is fitted again, twice at most: its extent grows in steps.
Softness fittedSoftness(renderer::Renderer& frame, const ViewerState& state) {
    Softness softness = chooseSoftness(frame, state.radiusM, state.radiusUv);
    for (int i = 0; i < 3; ++i) {
        frame.setReach(renderer::kReachOfSoftness * softness.radiusM);
        const Softness again = chooseSoftness(frame, state.radiusM, state.radiusUv);
        const bool same = again.radiusUv == softness.radiusUv && again.radiusM == softness.radiusM;
        softness = again;
        if (same) break;
    }
    return softness;
}

}  // namespace

Viewer::Viewer(const renderer::GlInfo& info, const ViewerState& state, int widthPx, int heightPx,
               const renderer::ShaderLibrary& shaders)
    : info_(info),
      state_(checked(state)),
      frame_(info, renderer::openScene(state.scene), widthPx, heightPx, shaders),
      view_(shaders, kDemandGlsl) {
    sceneCamera_ = frame_.scene().camera;
    sceneSun_ = frame_.scene().sun;
    apply(state_);
    run_ = std::make_unique<ShadowRun>(frame_, info_, settingsOf(state_, state_.resolution));
}

ShadowRun::Settings Viewer::settingsOf(const ViewerState& state,
                                       ResolutionOption resolution) const {
    return {.technique = &renderer::findTechnique(state.technique),
            .parameters = parametersOf(state),
            .radiusUv = softness_.radiusUv,
            .resolution = resolution,
            .slope = slope_.slope,
            .sizing = {.percentile = state.percentile, .crossFadeFrames = state.crossFadeFrames},
            .budgetTexels = state.budgetTexels};
}

void Viewer::show(const ViewerState& state) {
    if (state == state_) return;
    checked(state);
    const renderer::Technique& technique = renderer::findTechnique(state.technique);
    frame_.prepare(technique);
    view_.prepare(technique, run_->demandRule());
    try {
        apply(state);
    } catch (const std::exception&) {
        apply(state_);
        throw;
    }
    state_ = state;
}

void Viewer::useSlope(const std::optional<std::filesystem::path>& file) {
    LoadedSlope last = std::exchange(slope_, loadSlope(file, state_.audience));
    try {
        run_->change(settingsOf(state_, state_.resolution));
        view_.prepare(renderer::findTechnique(state_.technique), run_->demandRule());
    } catch (const std::exception&) {
        slope_ = std::move(last);
        run_->change(settingsOf(state_, state_.resolution));
        throw;
    }
    state_.slopeFile = file;
    slopeFor_ = {file, state_.audience};
}

void Viewer::apply(const ViewerState& state) {
    if (const std::pair wanted{state.slopeFile, state.audience}; slopeFor_ != wanted) {
        slope_ = loadSlope(state.slopeFile, state.audience);
        slopeFor_ = wanted;
    }
    if (state.scene != frame_.scene().source) {
        renderer::Scene scene = renderer::openScene(state.scene);
        sceneCamera_ = scene.camera;
        sceneSun_ = scene.sun;
        frame_.setScene(std::move(scene));
        cut_ = true;
    }
    frame_.setCamera(cameraOf(state, sceneCamera_, frame_.scene().cameraPath));
    frame_.setSun(sunOf(state, sceneSun_, frame_.scene().sunPath));
    softness_ = fittedSoftness(frame_, state);
    if (run_) run_->change(settingsOf(state, state.resolution));
}

void Viewer::reload(const renderer::ShaderLibrary& shaders) {
    renderer::ViewPass view(shaders, kDemandGlsl);
    view.prepare(renderer::findTechnique(state_.technique), run_->demandRule());
    run_->reload(shaders);
    view_ = std::move(view);
    otherRun_.reset();  // made again when it is needed
    otherFrame_.reset();
    otherShows_.reset();
}

void Viewer::resize(int widthPx, int heightPx) {
    frame_.resize(widthPx, heightPx);
}

void Viewer::step(renderer::PassClock* clock) {
    run_->step(clock, cut_);
    cut_ = false;
    drawView();
}

int Viewer::settle() {
    const int frames = run_->settle();
    cut_ = false;
    drawView();
    return frames;
}

void Viewer::drawOther() {
    if (!otherFrame_)
        otherFrame_ = std::make_unique<renderer::Renderer>(info_, frame_.scene(), frame_.widthPx(),
                                                           frame_.heightPx(), frame_.shaders());
    const bool sameSize =
        otherFrame_->widthPx() == frame_.widthPx() && otherFrame_->heightPx() == frame_.heightPx();
    if (otherShows_ == state_ && sameSize) return;  // a still view: it is often the slower frame
    otherFrame_->resize(frame_.widthPx(), frame_.heightPx());
    if (otherFrame_->scene().source != state_.scene) otherFrame_->setScene(frame_.scene());
    otherFrame_->setCamera(frame_.scene().camera);
    otherFrame_->setSun(frame_.scene().sun);
    otherFrame_->setLightViews(frame_.lightViews());
    const ShadowRun::Settings settings = settingsOf(state_, state_.compareWith);
    if (!otherRun_) otherRun_ = std::make_unique<ShadowRun>(*otherFrame_, info_, settings);
    otherRun_->change(settings);
    otherRun_->step();
    otherShows_ = state_;
}

void Viewer::drawView() {
    if (state_.view == renderer::View::picture) return;
    if (compares(state_.view)) drawOther();
    const std::size_t maps = frame_.lightViews().size();
    view_.draw(frame_, compares(state_.view) ? otherFrame_.get() : nullptr,
               {.view = state_.view,
                .splitAt = state_.splitAt,
                .gain = state_.gain,
                .rule = run_->demandRule(),
                .map = std::min(static_cast<std::size_t>(state_.viewMap), maps) - 1});
}

unsigned Viewer::framebuffer() const {
    return state_.view == renderer::View::picture ? frame_.litFramebuffer() : view_.framebuffer();
}

renderer::ByteImage Viewer::picture(int samplesPerPixelEdge) {
    return state_.view == renderer::View::picture ? run_->picture(samplesPerPixelEdge)
                                                  : view_.read();
}

}  // namespace demo

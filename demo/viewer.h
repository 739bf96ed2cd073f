// SPDX-License-Identifier: MIT
// Draws what a ViewerState says, with or without a window: the frame at the size that the state
// asks for, a second one where the view compares, and the view over both.
//
//   demo::Viewer viewer(info, state, 1280, 720);
//   viewer.settle();  or, every frame:  viewer.show(state); viewer.step();
//   window.present(viewer.framebuffer(), ...);  or  writePng(file, viewer.picture(2));
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "demo/viewer_state.h"

namespace demo {

class Viewer {
  public:
    /// Throws std::invalid_argument for a state that is not usable, what loadSlope() throws, and
    /// what Renderer throws.
    Viewer(const renderer::GlInfo& info, const ViewerState& state, int widthPx, int heightPx,
           const renderer::ShaderLibrary& shaders = renderer::ShaderLibrary::embedded());

    /// From the next frame on. Throws std::invalid_argument, what loadSlope() throws, and
    /// std::runtime_error where the technique's shaders do not compile, and then the state stays as
    /// it was.
    void show(const ViewerState& state);
    /// Takes these shaders for picture, view and demand from the next frame on. Throws
    /// std::runtime_error where one does not compile, and then the last good ones stay.
    void reload(const renderer::ShaderLibrary& shaders);
    /// Sizes maps by this slope.json, read again, or by the published slope, from the next frame
    /// on. Throws what loadSlope() throws, and then the slope stays.
    void useSlope(const std::optional<std::filesystem::path>& file);
    void resize(int widthPx, int heightPx);

    /// The next frame. The clock sees the passes of the frame alone, not those of the one that it
    /// is compared with.
    void step(renderer::PassClock* clock = nullptr);
    /// Frames until the automatic size stays; returns their number.
    int settle();

    unsigned framebuffer() const;
    /// As the view shows it; a plain picture with samples x samples per pixel.
    renderer::ByteImage picture(int samplesPerPixelEdge);

    const ViewerState& state() const { return state_; }
    const LoadedSlope& slope() const { return slope_; }
    const Softness& softness() const { return softness_; }
    const renderer::OrbitCamera& sceneCamera() const { return sceneCamera_; }
    const renderer::Renderer& frame() const { return frame_; }
    const ShadowRun& run() const { return *run_; }
    ShadowRun& run() { return *run_; }

  private:
    ShadowRun::Settings settingsOf(const ViewerState& state, ResolutionOption resolution) const;
    void apply(const ViewerState& state);
    void drawOther();
    void drawView();

    renderer::GlInfo info_;
    ViewerState state_;
    LoadedSlope slope_;
    /// What slope_ was read for: file and audience.
    std::optional<std::pair<std::optional<std::filesystem::path>, resolution_controller::Audience>>
        slopeFor_;
    Softness softness_;
    renderer::OrbitCamera sceneCamera_;
    renderer::Sun sceneSun_;
    renderer::Renderer frame_;
    std::unique_ptr<ShadowRun> run_;
    // The frame that the view compares with, made when first needed.
    std::unique_ptr<renderer::Renderer> otherFrame_;
    std::unique_ptr<ShadowRun> otherRun_;
    std::optional<ViewerState> otherShows_;
    renderer::ViewPass view_;
    bool cut_ = true;  // the next frame shows something else than the last one
};

}  // namespace demo

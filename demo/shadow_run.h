// SPDX-License-Identifier: MIT
// One scene with one technique at one softness, frame after frame, at a fixed size or at the size
// that the controller picks. The place where renderer and controller meet; neither knows the other.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "demo/spread.h"
#include "renderer/demand_pass.h"
#include "renderer/detail_probe.h"
#include "renderer/renderer.h"
#include "resolution_controller/resolution_controller.h"

namespace demo {

/// `--resolution`: a fixed N, or absent for automatic.
using ResolutionOption = std::optional<int>;

/// "auto" or a whole number of texels from 1. Throws std::invalid_argument that names `option`
/// otherwise.
ResolutionOption parseResolution(const std::string& text, const std::string& option);

struct Softness {
    double radiusM = 0;   ///< in the scene, across the light
    double radiusUv = 0;  ///< as a fraction of the map's extent
};

/// The scene's own softness, or what was asked for in metres or as a fraction of the map. Throws
/// std::invalid_argument for a radius that is negative, not finite or wider than the map.
Softness chooseSoftness(const renderer::Renderer& frame, std::optional<double> radiusM,
                        std::optional<double> radiusUv);

/// N, and why.
struct ChosenResolution {
    int resolution = 0;
    bool automatic = false;
    std::string reason;      ///< the controller's words, or "fixed"
    int need = 0;            ///< texels asked for before limits and levels; 0 for a fixed size
    double minRadiusUv = 0;  ///< least radius where a texel is larger than a pixel; 0: none
    double shareAbove = 0;   ///< share of the samples that ask for more
    double artifactRatio =
        0;  ///< texel over what the slope allows: above 1, stair-steps are seen more often
    int detailTexels = 0;   ///< that thin casters ask for; 0: none do
    double fadeWeight = 1;  ///< below 1 while a change of size is faded
};

class ShadowRun {
  public:
    struct Settings {
        const renderer::Technique* technique = nullptr;
        renderer::ParameterValues parameters{};
        double radiusUv = 0;
        ResolutionOption resolution;  ///< absent: automatic
        resolution_controller::Slope slope;
        /// Of the automatic size, but for slope and driver's limit, which are those above and the
        /// context's.
        resolution_controller::Settings sizing = {};
    };

    /// Throws std::invalid_argument for settings that renderer or controller refuse.
    ShadowRun(renderer::Renderer& frame, const renderer::GlInfo& info, const Settings& settings);

    /// Other settings from the next frame on; an automatic size goes on from where it is. Throws as
    /// the constructor does, and then nothing has changed.
    void change(const Settings& settings);

    /// Draws the next frame. `cut`: the view has nothing to do with the one before, so an automatic
    /// size moves at once, downwards too.
    void step(renderer::PassClock* clock = nullptr, bool cut = false);
    /// Draws frames until the automatic size stays as it is; returns their number. At least one.
    int settle();

    /// What the pixels are asked with.
    renderer::DemandRule demandRule() const;
    const ChosenResolution& chosen() const { return chosen_; }
    const renderer::FrameSettings& frameSettings() const { return frameSettings_; }

    /// Whole frames, each finished before the next begins; nothing waits inside one.
    Spread timeWholeFrames(int frames);
    /// Pass by pass, in frames of their own.
    struct PassSpreads {
        std::array<Spread, renderer::kPasses>
            passes;  ///< indexed by renderer::Pass; count 0: not in the frame
    };
    PassSpreads timePasses(int frames);

    /// The same frame with samples x samples per pixel, as sRGB codes averaged in light.
    renderer::ByteImage picture(int samplesPerPixelEdge);

  private:
    /// How the view goes with the one before: sameUnseen is the same still view again, of which
    /// nothing was shown yet.
    enum class View { goesOn, another, sameUnseen };
    void draw(renderer::PassClock* clock, View view);
    /// What the frame's pixels want of the next map.
    void ask(renderer::PassClock* clock);

    renderer::Renderer& frame_;
    renderer::GlInfo info_;
    Settings settings_;
    resolution_controller::ResolutionController controller_;
    renderer::FrameSettings frameSettings_;
    renderer::DemandPass demand_;
    renderer::DetailProbe detail_;
    std::string detailOf_;  // the scene that the probe looked at
    int framesToDetail_ = 0;
    ChosenResolution chosen_;
};

}  // namespace demo

// SPDX-License-Identifier: MIT
// One scene with one technique at one softness, frame after frame, at a fixed size or at the size
// that the controller picks. The place where renderer and controller meet; neither knows the other.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "demo/spread.h"
#include "renderer/demand_pass.h"
#include "renderer/detail_probe.h"
#include "renderer/renderer.h"
#include "resolution_controller/light_set.h"
#include "resolution_controller/resolution_controller.h"
#include "resolution_controller/trace.h"

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

/// N of one map, and why.
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

/// How the maps of a frame share a budget, in texels.
struct SharedBudget {
    std::int64_t texels = 0;   ///< for all maps together
    std::uint64_t wanted = 0;  ///< what they would take without it
    std::uint64_t used = 0;
    bool feasible = true;  ///< false: even the smallest sizes take more
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
        /// For the automatic sizes of all maps together, at least 1; absent: no budget. What a fade
        /// still draws of older maps comes on top.
        std::optional<std::int64_t> budgetTexels = {};
    };

    /// Throws std::invalid_argument for settings that renderer or controller refuse.
    ShadowRun(renderer::Renderer& frame, const renderer::GlInfo& info, const Settings& settings);

    /// Other settings from the next frame on; an automatic size goes on from where it is. Throws as
    /// the constructor does, std::runtime_error for shaders that do not compile, and then nothing
    /// has changed.
    void change(const Settings& settings);
    /// Takes these shaders for the frame and for what chooses its size. Throws std::runtime_error
    /// where one that has been used does not compile, and then the last good ones stay.
    void reload(const renderer::ShaderLibrary& shaders);

    /// From here on, what the automatic sizes are chosen by and what they come to is recorded
    /// (resolution_controller/trace.h), as many frames as so many bytes hold. A frame with another
    /// number of maps begins the record anew.
    void startTrace(std::size_t bytes);
    /// The record so far; absent before startTrace().
    const std::optional<resolution_controller::TraceWriter>& trace() const { return trace_; }

    /// Draws the next frame. `cut`: the view has nothing to do with the one before, so an automatic
    /// size moves at once, downwards too.
    void step(renderer::PassClock* clock = nullptr, bool cut = false);
    /// Draws frames until the automatic size stays as it is; returns their number. At least one.
    int settle();

    /// What the pixels are asked with.
    renderer::DemandRule demandRule() const;
    /// Of the sun's map, or its first cascade's.
    const ChosenResolution& chosen() const { return chosen_.front(); }
    /// Of all maps of the frame drawn last, in the order of Renderer::lightViews().
    const std::vector<ChosenResolution>& maps() const { return chosen_; }
    /// Of the frame drawn last; absent where its sizes are fixed or have no budget.
    const std::optional<SharedBudget>& budget() const { return budget_; }
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
    /// Adds all that the GPU has finished counting to what the map's recent frames asked for; their
    /// sum, null where nothing came. What was drawn before a cut is forgotten there, so all is of
    /// this view.
    const resolution_controller::DemandHistogram* hear(std::size_t map);
    /// This frame's size, or sizes, from the demand of earlier ones.
    void chooseAlone(View view);
    void chooseTogether(View view);
    /// What the frame's pixels want of the next map: some of them, others each time.
    void ask(renderer::PassClock* clock);
    /// All the others of a still view.
    void askTheRest();
    void forgetDemand();
    /// One for each map, each for as many frames as it takes to ask every pixel.
    void fitRecent();

    renderer::Renderer& frame_;
    renderer::GlInfo info_;
    Settings settings_;
    resolution_controller::ResolutionController controller_;
    renderer::FrameSettings frameSettings_;
    renderer::DemandPass demand_;
    renderer::DetailProbe detail_;
    std::vector<resolution_controller::RecentDemand> recent_;  // one for each map
    std::vector<bool> unseen_;      // one for each map: nothing of it is in view, as last heard
    glm::ivec2 askedPx_{0};         // the frame that they are of
    std::string detailOf_;          // source of the scene that the probe looked at
    std::size_t hurriedTiles_ = 0;  // still to be drawn of a new view, one in every frame
    int framesToDetail_ = 0;
    std::size_t detailTurn_ = 0;
    /// In place of controller_ where there are several maps, a budget or a trace.
    std::optional<resolution_controller::LightSet> lights_;
    std::vector<std::byte> traceBytes_;
    std::optional<resolution_controller::TraceWriter> trace_;
    std::vector<ChosenResolution> chosen_ = std::vector<ChosenResolution>(1);
    std::optional<SharedBudget> budget_;
};

}  // namespace demo

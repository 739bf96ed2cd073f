// SPDX-License-Identifier: MIT
// Picks the size of one light's shadow map, every frame, from the slope and from what is on screen:
// the smallest of a few levels that hides the stair-steps, no sooner lowered than it pays.
//
// Source: F. Kreuzer, "Using Perception-Based Filtering to Hide Shadow Artifacts", sections 6, 7.
//
//     namespace rc = resolution_controller;
//     rc::ResolutionController controller({.slope = slope, .driverMaxSize = maxTextureSize});
//     rc::RecentDemand recent(16);  // as many frames as ask every pixel once
//     // every frame: what the GPU has finished counting; for PCF only update(radiusUv)
//     while (reading = ...) recent.add(*reading);  // all that the GPU has finished
//     const rc::Decision choice = controller.update(recent.sum());
//     if (choice.changed) resizeShadowMap(choice.size);
//     setFilterRadius(std::max(radiusUv, choice.minRadiusUv));
//     setTexelConstants(choice.map);
//
// A cascade is a light of its own; so is each face of a cube map whose faces may differ in size.
// Faces that share one size are one light: add their histograms up. light_set.h shares a budget
// among lights.
//
// The law r = c a runs both ways. Where the size is limited (by the settings, the driver, a budget,
// or because a few pixels were left above the percentile), minRadiusUv = c / size is the softest
// answer: enlarge smaller filters to it wherever a texel is larger than a screen pixel.
//
// The calls of a frame neither allocate nor throw nor look at a clock. From the demand on they use
// integers, so that every machine decides the same.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "resolution_controller/demand.h"
#include "resolution_controller/fall_memory.h"
#include "resolution_controller/levels.h"
#include "resolution_controller/map_constants.h"
#include "resolution_controller/slope.h"

namespace resolution_controller {

/// Percentile that makes the published rule: the maximum over all visible points in penumbra.
inline constexpr double kMaximumRule = 1.0;

struct Settings {
    Slope slope = {};

    std::int32_t minSize = 64;           ///< texels, >= 1, <= maxSize
    std::int32_t maxSize = 8192;         ///< texels; the largest level used is at most this
    std::int32_t driverMaxSize = 16384;  ///< texels: GL_MAX_TEXTURE_SIZE or the like
    LevelRatio levelRatio = LevelRatio::sqrtTwo;  ///< two: powers of two only

    /// Share of the samples, by weight, whose demand is met, (0, 1]: with demandWeight() of the
    /// length of the shadows' edges. 1 is the published maximum rule; below it, one contact pixel
    /// does not ask for the largest map.
    double percentile = 0.98;

    /// A map is lowered when for so many frames with data (>= 0) ...
    std::int32_t lowerAfterFrames = 45;
    /// ... the demand was below this share, in percent (1 to 100), of a lower level. It waits for
    /// the end of a fade, and longer after a lowering that had to be taken back (fall_memory.h).
    std::int32_t lowerBelowPercent = 80;

    /// Size until the first data come; taken to the next level within the limits. > 0.
    std::int32_t startSize = 1024;

    /// Edge of the texture that holds the map in a corner, texels, and so another limit; 0: the map
    /// is re-allocated with exactly its size.
    std::int32_t textureSize = 0;

    /// After a change of size, frames (0 to 10000) in which the old map still has a share in the
    /// picture; 0: it is replaced at once. Both maps are drawn meanwhile. A size that comes before
    /// the one it follows has half of the picture takes its weight over, and so gets fewer frames.
    std::int32_t crossFadeFrames = 0;

    float pixelBound = 1;       ///< k, texels per pixel that can still be seen, > 0
    float texelsPerCaster = 2;  ///< across the thinnest caster; >= 0, 0: detail asks for nothing.
                                ///< One makes sure that a bar is hit, two that its width is too

    /// What a texel of this light counts in a budget (light_set.h): layers of this size x bytes per
    /// texel, in 1 to 65536. 6 x 4 for a cube map of 32-bit depths whose faces share a size.
    std::int32_t budgetPerTexel = 1;

    bool operator==(const Settings&) const = default;
};

/// Empty when usable; else a sentence that names field, value and rule.
std::string validate(const Settings& settings);

/// Whether both choose the same size by the same data: all but crossFadeFrames, startSize and
/// budgetPerTexel is the same.
bool chooseAlike(const Settings& a, const Settings& b) noexcept;

/// What to call demand() with for the points of a light with these settings.
DemandRule demandRule(const Settings& settings) noexcept;

/// What a single frame adds to the settings.
struct Frame {
    /// Largest edge that this light's share of a memory budget allows; absent: no budget. It rounds
    /// down to a level and holds at once; where it is below minSize, the smallest level is used.
    std::optional<std::int32_t> budgetSize = {};

    /// The picture has nothing to do with the one before: the first data of the new view choose the
    /// size at once, downwards too, and without a fade.
    bool cameraCut = false;
    /// How many calls ago the data of this one were drawn: 0 for this frame's, 2 where a read-back
    /// takes two frames. Data from before a cut are not used. Negative counts as 0.
    std::int32_t dataAgeFrames = 0;

    /// For update(radiusUv), where a histogram has it in its demands: contrast of the shadows' edge
    /// ([0, 1], anything else counts as 1) and smallest pixelFootprint() of a visible point (not
    /// positive and finite: no bound).
    double contrast = 1;
    double footprintUv = 0;

    /// Texels that a finer probe found necessary for thin casters; 0 or less: none. Not subject to
    /// the percentile; limits hold.
    std::int32_t detailTexels = 0;
    /// Largest filter radius in use where it varies: width of the guard band.
    double largestRadiusUv = 0;

    bool operator==(const Frame&) const = default;
};

/// The numbers are part of traces and of the C interface: new ones are added at the end.
enum class Reason : std::uint8_t {
    // The size follows the demand:
    demandMet = 0,       ///< the smallest level that meets it
    waitingToLower = 1,  ///< a lower level would do, but with little room, not yet for long, or
                         ///< not when it was tried
    atMinimum = 2,       ///< the demand is below the smallest level
    // The size is smaller than the demand; minRadiusUv says how far to enlarge the filter:
    limitedByPercentile = 3,  ///< it meets the percentile; some samples ask for more
    limitedByMaximum = 4,     ///< by settings
    limitedByDriver = 5,
    limitedByBudget = 6,
    // There was nothing to go by; the size stays:
    heldWithoutData = 7,     ///< hold() was called
    heldEmptyHistogram = 8,  ///< no visible point in penumbra
    heldRejectedDemand = 9,  ///< a histogram of nothing but NaN, zero and negative demands
    heldBadRadius = 10,      ///< NaN, zero, negative or infinite radius
    heldBadSettings = 11,  ///< reconfigure() was given unusable settings, and no usable ones since
    heldBadSlope = 12,     ///< the same, the slope being what was unusable
    heldOldView = 13,      ///< the data were drawn before the camera cut
    // Further ones of the first two kinds:
    detailMet = 14,         ///< thin casters ask for more than the filter; their demand is met
    limitedByTexture = 15,  ///< by settings: the texture that holds the map
    // light_set.h:
    switchedOff = 16  ///< the light takes no part; the size stays
};
inline constexpr int kReasons = 17;

/// A few words for a log or an overlay.
const char* text(Reason reason) noexcept;
/// Whether the decision is the last one again, since there was nothing to go by.
bool isHeld(Reason reason) noexcept;

struct Decision {
    std::int32_t size = 0;          ///< edge of the map for this frame, texels
    std::int32_t previousSize = 0;  ///< of the frame before; equal to size unless `changed`
    bool changed = false;
    /// While fadeWeight is below 1: show fadeWeight x this size's shadow + (1 - fadeWeight) x that
    /// of a map with fadeFromSize. Where the size changes meanwhile (to a larger one or, at a
    /// limit, a smaller; other lowerings wait for the fade's end), the map with the larger share of
    /// the picture stays in it: where fadeWeight was below 1/2, fadeFromSize stays and the weight
    /// steps on; else a new fade starts from the size that is left. Back to fadeFromSize the fade
    /// turns round. So beside a step, 1 / (crossFadeFrames + 1), no more than half of the picture
    /// is replaced in a frame. Other crossFadeFrames go on from the present weight.
    std::int32_t fadeFromSize = 0;
    double fadeWeight = 1;
    Reason reason = Reason::heldWithoutData;
    /// Texels asked for by the last data, before limits and levels; 65536 stands for "or more", 0
    /// for "no data yet".
    std::int32_t need = 0;
    /// a / (r / c) at the percentile: texel edge over the edge that the study allows. 1 is at its
    /// criterion, above 1 stair-steps are seen more often. 0 before any data.
    double artifactRatio = 0;
    /// Share of the samples, by weight, that ask for more than `size`.
    double shareAbove = 0;
    /// c / size when a filter asks for more than `size`; else 0. In a fade on its way there, in
    /// equal steps.
    double minRadiusUv = 0;
    /// Viewport, kernel and bias for `size`.
    MapConstants map = {};

    bool operator==(const Decision&) const = default;
};

/// The rules by which the same data come to the same decisions, by the minor version of traces
/// (trace.h) that they came with: older traces are replayed by the rules of their time.
enum class Rules : std::uint16_t {
    nothingRemembered = 1,  ///< what falls, falls again as often as it is taken back
    needsRemembered = 2,    ///< a need in a budget does not, for ever
    /// Nor does a size, for a while (fall_memory.h), and a light whose need pauses is reserved no
    /// more than it uses. A fade keeps the map with the larger share, lowerings wait for its end,
    /// and other crossFadeFrames go on from its weight.
    fallsRemembered = 3
};
inline constexpr Rules kPresentRules = Rules::fallsRemembered;

/// Everything that a decision depends on beside settings, data and frame. For traces: to start one
/// at any frame.
struct ControllerState {
    static constexpr std::int32_t kNever = 0x7fffffff;

    Decision last;
    double radiusUv = 0;                // of the last data, 0 for a histogram
    double largestRadiusUv = 0;         // of the last frame
    std::int32_t framesBelow = 0;       // in a row, with data, below lowerBelowPercent
    std::int32_t largestNeedBelow = 0;  // of those frames
    std::int32_t framesSinceCut = kNever;
    std::int32_t fadeFrame = kNever;  // 1 in the frame of the change that is being faded
    FallMemory falls = {};            // of the size
    std::int32_t fellTo = 0;          // at the last fall; 0 none yet
    bool hadData = false;
    bool cutPending = false;  // no data of the new view yet
    bool settingsRefused = false;
    bool slopeRefused = false;

    bool operator==(const ControllerState&) const = default;
};

/// Empty when a controller could be in this state; else a sentence that names field, value and
/// rule.
std::string validate(const ControllerState& state);

class ResolutionController {
  public:
    /// Throws std::invalid_argument with validate()'s sentence.
    explicit ResolutionController(const Settings& settings);
    /// Goes on from a state that was taken earlier. Throws likewise.
    ResolutionController(const Settings& settings, const ControllerState& state);

    /// PCF: one filter radius for the whole map, as a fraction of its extent.
    Decision update(double radiusUv, const Frame& frame = {}) noexcept;

    /// PCSS and anything else with a radius per point: the demand of the visible points in
    /// penumbra.
    Decision update(const DemandHistogram& histogram, const Frame& frame = {}) noexcept;

    /// No data this frame: the size stays, within the limits.
    Decision hold(const Frame& frame = {}) noexcept;

    /// New settings from the next call on; the size moves within new limits at once. Returns
    /// validate()'s sentence; when it is not empty, the old settings stay and the size is held
    /// until usable ones come. Falls in vain are forgotten unless the settings chooseAlike().
    /// Not a call for every frame: a sentence allocates.
    std::string reconfigure(const Settings& settings);

    const Settings& settings() const noexcept { return settings_; }
    std::int32_t size() const noexcept { return state_.last.size; }
    const ControllerState& state() const noexcept { return state_; }
    /// Back to a state of this controller's own; takes back whatever came after it.
    void restore(const ControllerState& state) noexcept { state_ = state; }
    /// From here on, with no fall in mind.
    void decideBy(Rules rules) noexcept;

    struct Limits {
        std::int32_t low, high;  ///< levels
        Reason binding;          ///< what sets `high`
    };
    /// Between which sizes a frame's decision lies.
    Limits limits(const Frame& frame) const noexcept;

  private:
    /// Texels that this frame's data ask for.
    struct Need {
        double filter = 0;  // as the law has it
        std::int32_t filterTexels = 0;
        std::int32_t detailTexels = 0;
        std::int32_t texels() const {
            return filterTexels > detailTexels ? filterTexels : detailTexels;
        }
    };

    std::int32_t within(const Limits& limits) const noexcept;
    void begin(const Frame& frame) noexcept;
    std::optional<Reason> unusable(const Frame& frame) const noexcept;
    std::int32_t choose(std::int32_t need, const Limits& limits) noexcept;
    Decision decide(double texels, const DemandHistogram* histogram, std::uint64_t total,
                    const Frame& frame) noexcept;
    Reason reasonFor(const Decision& decision, const Need& need,
                     const Limits& limits) const noexcept;
    Decision held(Reason reason, const Frame& frame) noexcept;
    Decision finish(Decision decision, bool mayFade) noexcept;

    /// How a frame shows two maps.
    struct Fade {
        std::int32_t fromSize;
        double weight = 1;
        double stepsLeft = 1;  ///< to its end, this one among them
    };
    bool fades() const noexcept;
    Fade fade(const Decision& decision, bool mayFade) noexcept;
    Fade fadeBefore13(const Decision& decision, bool mayFade) noexcept;

    Rules rules_ = kPresentRules;
    Settings settings_;
    ControllerState state_;
};

}  // namespace resolution_controller

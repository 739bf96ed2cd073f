// SPDX-License-Identifier: MIT
// Picks the size of one light's shadow map, every frame, from the slope and from what is on screen:
// the smallest of a few levels that hides the stair-steps, no sooner lowered than it pays.
//
// Source: F. Kreuzer, "Using Perception-Based Filtering to Hide Shadow Artifacts", sections 6, 7.
//
//     namespace rc = resolution_controller;
//     rc::ResolutionController controller({.slope = slope, .driverMaxSize = maxTextureSize});
//     // every frame: update(radiusUv) for PCF, update(histogram) for PCSS, hold() without data
//     const rc::Decision choice = controller.update(histogram);
//     if (choice.changed) resizeShadowMap(choice.size);
//     setFilterRadius(std::max(radiusUv, choice.minRadiusUv));
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
#include "resolution_controller/levels.h"
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

    /// Share of the samples whose demand is met, (0, 1]. 1 is the published maximum rule; below it,
    /// one contact pixel does not ask for the largest map.
    double percentile = 0.98;

    /// A map is lowered when for so many frames with data (>= 0) ...
    std::int32_t lowerAfterFrames = 45;
    /// ... the demand was below this share, in percent (1 to 100), of a lower level.
    std::int32_t lowerBelowPercent = 80;

    /// Size until the first data come; taken to the next level within the limits. > 0.
    std::int32_t startSize = 1024;
};

/// Empty when usable; else a sentence that names field, value and rule.
std::string validate(const Settings& settings);

/// What a single frame adds to the settings.
struct Frame {
    /// Largest edge that this light's share of a memory budget allows; absent: no budget. It rounds
    /// down to a level and holds at once; where it is below minSize, the smallest level is used.
    std::optional<std::int32_t> budgetSize = {};
};

enum class Reason : std::uint8_t {
    // The size follows the demand:
    demandMet,       ///< the smallest level that meets it
    waitingToLower,  ///< a lower level would do, but not yet for long enough
    atMinimum,       ///< the demand is below the smallest level
    // The size is smaller than the demand; minRadiusUv says how far to enlarge the filter:
    limitedByPercentile,  ///< it meets the percentile; some samples ask for more
    limitedByMaximum,     ///< by settings
    limitedByDriver,
    limitedByBudget,
    // There was nothing to go by; the size stays:
    heldWithoutData,     ///< hold() was called
    heldEmptyHistogram,  ///< no visible point in penumbra
    heldRejectedDemand,  ///< a histogram of nothing but NaN, zero and negative demands
    heldBadRadius,       ///< NaN, zero, negative or infinite radius
    heldBadSettings      ///< reconfigure() was given unusable settings, and no usable ones since
};

/// A few words for a log or an overlay.
const char* text(Reason reason) noexcept;

struct Decision {
    std::int32_t size = 0;          ///< edge of the map for this frame, texels
    std::int32_t previousSize = 0;  ///< of the frame before; equal to size unless `changed`
    bool changed = false;
    Reason reason = Reason::heldWithoutData;
    /// Texels asked for by the last data, before limits and levels; 65536 stands for "or more", 0
    /// for "no data yet".
    std::int32_t need = 0;
    /// a / (r / c) at the percentile: texel edge over the edge that the study allows. 1 is at its
    /// criterion, above 1 stair-steps are seen more often. 0 before any data.
    double artifactRatio = 0;
    /// Share of the samples that ask for more than `size`.
    double shareAbove = 0;
    /// c / size when anything asks for more than `size`; else 0.
    double minRadiusUv = 0;
};

class ResolutionController {
  public:
    /// Throws std::invalid_argument with validate()'s sentence.
    explicit ResolutionController(const Settings& settings);

    /// PCF: one filter radius for the whole map, as a fraction of its extent.
    Decision update(double radiusUv, const Frame& frame = {}) noexcept;

    /// PCSS and anything else with a radius per point: the demand of the visible points in
    /// penumbra.
    Decision update(const DemandHistogram& histogram, const Frame& frame = {}) noexcept;

    /// No data this frame: the size stays, within the limits.
    Decision hold(const Frame& frame = {}) noexcept;

    /// New settings from the next call on; the size moves within new limits at once. Returns
    /// validate()'s sentence; when it is not empty, the old settings stay and the size is held
    /// until usable ones come. Not a call for every frame: a sentence allocates.
    std::string reconfigure(const Settings& settings);

    const Settings& settings() const noexcept { return settings_; }
    std::int32_t size() const noexcept { return last_.size; }

  private:
    struct Limits {
        std::int32_t low, high;  // levels
        Reason binding;          // what sets `high`
    };

    Limits limits(const Frame& frame) const noexcept;
    std::int32_t within(const Limits& limits) const noexcept;
    std::int32_t choose(std::int32_t need, const Limits& limits) noexcept;
    Decision decide(double texels, const DemandHistogram* histogram, const Frame& frame) noexcept;
    Reason reasonFor(const Decision& decision, const Limits& limits) const noexcept;
    Decision held(Reason reason, const Frame& frame) noexcept;

    Settings settings_;
    Decision last_;
    std::int32_t framesBelow_ = 0;       // in a row, with data, below lowerBelowPercent
    std::int32_t largestNeedBelow_ = 0;  // of those frames
    bool hadData_ = false;
    bool settingsRefused_ = false;
};

}  // namespace resolution_controller

// SPDX-License-Identifier: MIT
#include "resolution_controller/resolution_controller.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "resolution_controller/sentence.h"

namespace resolution_controller {
namespace {

constexpr std::int32_t kLargestNeed = DemandHistogram::upperEdge(DemandHistogram::kBins - 1);

/// Upper edge of the bin in which the percentile lies. The histogram is not empty.
std::int32_t needOf(const DemandHistogram& histogram, double percentile) noexcept {
    constexpr std::uint64_t kMillion = 1'000'000;
    const auto share = static_cast<std::uint64_t>(std::llround(percentile * kMillion));
    const std::uint64_t total = histogram.total();
    const std::uint64_t rank =
        std::max<std::uint64_t>(1, (total * share + kMillion - 1) / kMillion);
    std::uint64_t upToBin = 0;
    for (std::size_t b = 0; b < DemandHistogram::kBins; ++b) {
        upToBin += histogram.counts[b];
        if (upToBin >= rank) return DemandHistogram::upperEdge(b);
    }
    return kLargestNeed;
}

/// Share of the samples in bins that reach beyond `size`.
double shareAbove(const DemandHistogram& histogram, std::int32_t size) noexcept {
    std::uint64_t above = 0;
    for (std::size_t b = 0; b < DemandHistogram::kBins; ++b) {
        if (DemandHistogram::upperEdge(b) > size) above += histogram.counts[b];
    }
    return static_cast<double>(above) / static_cast<double>(histogram.total());
}

std::string validateLimits(const Settings& s) {
    if (s.minSize < 1) return sentence("minSize", s.minSize, "must be at least 1");
    if (s.minSize > s.maxSize) {
        return sentence("minSize", s.minSize,
                        "must not be above maxSize, " + std::to_string(s.maxSize));
    }
    if (s.minSize > s.driverMaxSize) {
        return sentence("minSize", s.minSize,
                        "must not be above driverMaxSize, " + std::to_string(s.driverMaxSize));
    }
    const std::int32_t largest = std::min(s.maxSize, s.driverMaxSize);
    const auto low = levelAtLeast(s.minSize, s.levelRatio);
    const auto high = levelAtMost(largest, s.levelRatio);
    if (!low || !high || *low > *high) {
        return sentence("minSize", s.minSize,
                        "there must be a level between it and the largest size, " +
                            std::to_string(largest) + " (levels.h: 16 to 32768)");
    }
    return {};
}

}  // namespace

std::string validate(const Settings& s) {
    if (std::string problem = validate(s.slope); !problem.empty()) return problem;
    if (std::string problem = validateLimits(s); !problem.empty()) return problem;
    if (s.levelRatio != LevelRatio::sqrtTwo && s.levelRatio != LevelRatio::two) {
        return sentence("levelRatio", static_cast<int>(s.levelRatio), "must be sqrtTwo or two");
    }
    if (!(s.percentile > 0 && s.percentile <= 1)) {
        return sentence("percentile", s.percentile, "must be in (0, 1]");
    }
    if (s.lowerAfterFrames < 0) {
        return sentence("lowerAfterFrames", s.lowerAfterFrames, "must be at least 0");
    }
    if (s.lowerBelowPercent < 1 || s.lowerBelowPercent > 100) {
        return sentence("lowerBelowPercent", s.lowerBelowPercent, "must be in 1 to 100");
    }
    if (s.startSize < 1) return sentence("startSize", s.startSize, "must be at least 1");
    return {};
}

const char* text(Reason reason) noexcept {
    switch (reason) {
        case Reason::demandMet:
            return "meets the demand";
        case Reason::waitingToLower:
            return "waits before it is lowered";
        case Reason::atMinimum:
            return "smallest size allowed";
        case Reason::limitedByPercentile:
            return "some samples above the percentile ask for more";
        case Reason::limitedByMaximum:
            return "limited by the largest size allowed";
        case Reason::limitedByDriver:
            return "limited by the driver";
        case Reason::limitedByBudget:
            return "limited by the budget";
        case Reason::heldWithoutData:
            return "held: no data";
        case Reason::heldEmptyHistogram:
            return "held: nothing visible in penumbra";
        case Reason::heldRejectedDemand:
            return "held: no demand is a positive number";
        case Reason::heldBadRadius:
            return "held: filter radius is not positive and finite";
        case Reason::heldBadSettings:
            return "held: settings refused";
    }
    return "unknown";
}

ResolutionController::ResolutionController(const Settings& settings) : settings_(settings) {
    if (const std::string problem = validate(settings); !problem.empty()) {
        throw std::invalid_argument("resolution controller: " + problem);
    }
    const Limits all = limits({});
    last_.size =
        std::clamp(levelAtLeast(settings.startSize, settings.levelRatio).value_or(all.high),
                   all.low, all.high);
    last_.previousSize = last_.size;
}

std::string ResolutionController::reconfigure(const Settings& settings) {
    std::string problem = validate(settings);
    settingsRefused_ = !problem.empty();
    if (problem.empty()) settings_ = settings;
    return problem;
}

ResolutionController::Limits ResolutionController::limits(const Frame& frame) const noexcept {
    const Settings& s = settings_;
    Limits result{.low = *levelAtLeast(s.minSize, s.levelRatio),
                  .high = *levelAtMost(std::min(s.maxSize, s.driverMaxSize), s.levelRatio),
                  .binding = s.driverMaxSize < s.maxSize ? Reason::limitedByDriver
                                                         : Reason::limitedByMaximum};
    if (!frame.budgetSize) return result;
    const std::int32_t affordable = levelAtMost(*frame.budgetSize, s.levelRatio).value_or(0);
    if (affordable < result.high) {
        result.high = std::max(affordable, result.low);
        result.binding = Reason::limitedByBudget;
    }
    return result;
}

/// The last size, moved onto a level within the limits.
std::int32_t ResolutionController::within(const Limits& limits) const noexcept {
    const auto level = levelAtMost(last_.size, settings_.levelRatio);
    return std::clamp(level.value_or(limits.low), limits.low, limits.high);
}

std::int32_t ResolutionController::choose(std::int32_t need, const Limits& limits) noexcept {
    const std::int32_t target = std::clamp(
        levelAtLeast(need, settings_.levelRatio).value_or(limits.high), limits.low, limits.high);
    const std::int32_t current = within(limits);
    const auto hasRoomFor = [this](std::int64_t level, std::int64_t texels) {
        return texels * 100 < level * settings_.lowerBelowPercent;
    };
    const auto startOver = [this](std::int32_t size) {
        framesBelow_ = largestNeedBelow_ = 0;
        return size;
    };
    if (!hadData_ || target >= current) return startOver(target);

    std::int32_t lower = *levelAtMost(current - 1, settings_.levelRatio);
    if (!hasRoomFor(lower, need)) return startOver(current);
    largestNeedBelow_ = std::max(largestNeedBelow_, need);
    if (++framesBelow_ < settings_.lowerAfterFrames) return current;

    // As far down at once as the whole wait allows: a size for each level would pop at each.
    while (lower > limits.low) {
        const std::int32_t next = *levelAtMost(lower - 1, settings_.levelRatio);
        if (!hasRoomFor(next, largestNeedBelow_)) break;
        lower = next;
    }
    return startOver(lower);
}

Decision ResolutionController::decide(double texels, const DemandHistogram* histogram,
                                      const Frame& frame) noexcept {
    const Limits allowed = limits(frame);
    const auto need = static_cast<std::int32_t>(std::ceil(texels));
    Decision d;
    d.size = choose(need, allowed);
    d.previousSize = last_.size;
    d.changed = d.size != d.previousSize;
    d.need = need;
    d.artifactRatio = texels / d.size;
    d.shareAbove = histogram ? shareAbove(*histogram, d.size) : (need > d.size ? 1 : 0);
    if (d.shareAbove > 0) d.minRadiusUv = settings_.slope.c / d.size;
    d.reason = reasonFor(d, allowed);
    hadData_ = true;
    return last_ = d;
}

Reason ResolutionController::reasonFor(const Decision& d, const Limits& limits) const noexcept {
    if (d.need > d.size) return limits.binding;
    if (d.shareAbove > 0) return Reason::limitedByPercentile;
    const std::int32_t enough = *levelAtLeast(d.need, settings_.levelRatio);  // need <= size
    if (std::max(enough, limits.low) < d.size) return Reason::waitingToLower;
    return enough < limits.low ? Reason::atMinimum : Reason::demandMet;
}

Decision ResolutionController::update(double radiusUv, const Frame& frame) noexcept {
    if (settingsRefused_) return held(Reason::heldBadSettings, frame);
    if (!(radiusUv > 0) || !std::isfinite(radiusUv)) return held(Reason::heldBadRadius, frame);
    const double texels = settings_.slope.c / radiusUv;
    return decide(std::min<double>(texels, kLargestNeed), nullptr, frame);
}

Decision ResolutionController::update(const DemandHistogram& histogram,
                                      const Frame& frame) noexcept {
    if (settingsRefused_) return held(Reason::heldBadSettings, frame);
    if (histogram.total() == 0) {
        return held(
            histogram.rejected > 0 ? Reason::heldRejectedDemand : Reason::heldEmptyHistogram,
            frame);
    }
    return decide(needOf(histogram, settings_.percentile), &histogram, frame);
}

Decision ResolutionController::hold(const Frame& frame) noexcept {
    return held(settingsRefused_ ? Reason::heldBadSettings : Reason::heldWithoutData, frame);
}

/// The last decision again, unless a limit has moved.
Decision ResolutionController::held(Reason reason, const Frame& frame) noexcept {
    Decision d = last_;
    d.reason = reason;
    d.previousSize = last_.size;
    d.size = within(limits(frame));
    d.changed = d.size != d.previousSize;
    if (d.changed) {
        d.artifactRatio *= static_cast<double>(d.previousSize) / d.size;
        const bool limited = d.shareAbove > 0 || d.artifactRatio > 1;
        d.minRadiusUv = limited ? settings_.slope.c / d.size : 0;
    }
    return last_ = d;
}

}  // namespace resolution_controller

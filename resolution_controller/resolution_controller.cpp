// SPDX-License-Identifier: MIT
#include "resolution_controller/resolution_controller.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "resolution_controller/sentence.h"

namespace resolution_controller {
namespace {

constexpr std::int32_t kLargestNeed = DemandHistogram::upperEdge(DemandHistogram::kBins - 1);

constexpr auto kUpperEdges = [] {
    std::array<std::int32_t, DemandHistogram::kBins> edges{};
    for (std::size_t b = 0; b < edges.size(); ++b) edges[b] = DemandHistogram::upperEdge(b);
    return edges;
}();

/// Upper edge of the bin in which the percentile lies. `total` is above 0.
std::int32_t needOf(const DemandHistogram& histogram, std::uint64_t total,
                    double percentile) noexcept {
    constexpr std::uint64_t kMillion = 1'000'000;
    const auto share = static_cast<std::uint64_t>(std::llround(percentile * kMillion));
    const std::uint64_t rank =
        std::max<std::uint64_t>(1, (total * share + kMillion - 1) / kMillion);
    // From above: the bin up to which all but total - rank samples lie.
    std::uint64_t above = 0;
    std::size_t b = DemandHistogram::kBins - 1;
    while (b > 0 && above + histogram.counts[b] <= total - rank) above += histogram.counts[b--];
    return kUpperEdges[b];
}

/// Share of the samples in bins that reach beyond `size`.
double shareAbove(const DemandHistogram& histogram, std::uint64_t total,
                  std::int32_t size) noexcept {
    std::uint64_t above = 0;
    for (std::size_t b = DemandHistogram::kBins; b > 0 && kUpperEdges[b - 1] > size; --b) {
        above += histogram.counts[b - 1];
    }
    return static_cast<double>(above) / static_cast<double>(total);
}

std::int32_t largestSize(const Settings& s) noexcept {
    const std::int32_t largest = std::min(s.maxSize, s.driverMaxSize);
    return s.textureSize > 0 ? std::min(largest, s.textureSize) : largest;
}

Reason whatLimits(const Settings& s) noexcept {
    if (largestSize(s) < std::min(s.maxSize, s.driverMaxSize)) return Reason::limitedByTexture;
    return s.driverMaxSize < s.maxSize ? Reason::limitedByDriver : Reason::limitedByMaximum;
}

std::string validateLimits(const Settings& s) {
    if (s.minSize < 1) return sentence("minSize", s.minSize, "must be at least 1");
    if (s.minSize > s.maxSize) {
        return sentence("minSize", s.minSize,
                        "must not be above maxSize, " + std::to_string(s.maxSize));
    }
    if (s.textureSize < 0) return sentence("textureSize", s.textureSize, "must be at least 0");
    if (s.textureSize > 0 && s.minSize > s.textureSize) {
        return sentence("minSize", s.minSize,
                        "must not be above textureSize, " + std::to_string(s.textureSize));
    }
    if (s.minSize > s.driverMaxSize) {
        return sentence("minSize", s.minSize,
                        "must not be above driverMaxSize, " + std::to_string(s.driverMaxSize));
    }
    const std::int32_t largest = largestSize(s);
    const auto low = levelAtLeast(s.minSize, s.levelRatio);
    const auto high = levelAtMost(largest, s.levelRatio);
    if (!low || !high || *low > *high) {
        return sentence("minSize", s.minSize,
                        "there must be a level between it and the largest size, " +
                            std::to_string(largest) + " (levels.h: 16 to 32768)");
    }
    return {};
}

std::string validateDemand(const Settings& s) {
    if (!(s.pixelBound > 0 && std::isfinite(s.pixelBound))) {
        return sentence("pixelBound", s.pixelBound, "must be finite and greater than 0");
    }
    if (!(s.texelsPerCaster >= 0 && std::isfinite(s.texelsPerCaster))) {
        return sentence("texelsPerCaster", s.texelsPerCaster, "must be finite and at least 0");
    }
    if (!(s.percentile > 0 && s.percentile <= 1)) {
        return sentence("percentile", s.percentile, "must be in (0, 1]");
    }
    return {};
}

bool isShare(double value) {
    return value >= 0 && value <= 1;
}

bool isAmount(double value) {
    return value >= 0 && std::isfinite(value);
}

}  // namespace

std::string validate(const Settings& s) {
    if (std::string problem = validate(s.slope); !problem.empty()) return problem;
    if (std::string problem = validateLimits(s); !problem.empty()) return problem;
    if (s.levelRatio != LevelRatio::sqrtTwo && s.levelRatio != LevelRatio::two) {
        return sentence("levelRatio", static_cast<int>(s.levelRatio), "must be sqrtTwo or two");
    }
    if (std::string problem = validateDemand(s); !problem.empty()) return problem;
    if (s.lowerAfterFrames < 0) {
        return sentence("lowerAfterFrames", s.lowerAfterFrames, "must be at least 0");
    }
    if (s.lowerBelowPercent < 1 || s.lowerBelowPercent > 100) {
        return sentence("lowerBelowPercent", s.lowerBelowPercent, "must be in 1 to 100");
    }
    if (s.startSize < 1) return sentence("startSize", s.startSize, "must be at least 1");
    if (s.crossFadeFrames < 0 || s.crossFadeFrames > 10000) {
        return sentence("crossFadeFrames", s.crossFadeFrames, "must be in 0 to 10000");
    }
    if (s.budgetPerTexel < 1 || s.budgetPerTexel > 65536) {
        return sentence("budgetPerTexel", s.budgetPerTexel, "must be in 1 to 65536");
    }
    return {};
}

std::string validate(const ControllerState& s) {
    const Decision& d = s.last;
    for (const std::int32_t size : {d.size, d.previousSize, d.fadeFromSize}) {
        if (levelAtLeast(size, LevelRatio::sqrtTwo) != size) {
            return sentence("state.last.size", size, "must be a level (levels.h: 16 to 32768)");
        }
    }
    if (s.fellTo != 0 && levelAtLeast(s.fellTo, LevelRatio::sqrtTwo) != s.fellTo) {
        return sentence("state.fellTo", s.fellTo, "must be 0 or a level (levels.h: 16 to 32768)");
    }
    if (d.need < 0 || d.need > kLargestNeed) {
        return sentence("state.last.need", d.need, "must be in 0 to 65536");
    }
    if (static_cast<int>(d.reason) >= kReasons) {
        return sentence("state.last.reason", static_cast<int>(d.reason), "must be a reason");
    }
    if (!isShare(d.fadeWeight) || !isShare(d.shareAbove)) {
        return sentence("state.last.fadeWeight", d.fadeWeight,
                        "it and shareAbove must be in [0, 1]");
    }
    for (const double amount : {d.artifactRatio, d.minRadiusUv, s.radiusUv}) {
        if (!isAmount(amount)) {
            return sentence("state", amount, "radii and ratios must be finite and at least 0");
        }
    }
    for (const std::int32_t count :
         {s.framesBelow, s.largestNeedBelow, s.framesSinceCut, s.fadeFrame}) {
        if (count < 0) return sentence("state", count, "counts of frames must be at least 0");
    }
    return validate(s.falls);
}

bool chooseAlike(const Settings& a, const Settings& b) noexcept {
    Settings other = b;
    other.crossFadeFrames = a.crossFadeFrames;
    other.startSize = a.startSize;
    other.budgetPerTexel = a.budgetPerTexel;
    return a == other;
}

DemandRule demandRule(const Settings& settings) noexcept {
    constexpr double kLargest = std::numeric_limits<float>::max();
    return {.c = static_cast<float>(std::min(settings.slope.c, kLargest)),
            .pixelBound = settings.pixelBound,
            .contrastExponent = static_cast<float>(settings.slope.contrastExponent),
            .texelsPerCaster = settings.texelsPerCaster};
}

const char* text(Reason reason) noexcept {
    switch (reason) {
        case Reason::demandMet:
            return "meets the demand";
        case Reason::waitingToLower:
            return "a lower size has little room or would not have done for long";
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
        case Reason::heldBadSlope:
            return "held: slope refused";
        case Reason::heldOldView:
            return "held: the data are from before the camera cut";
        case Reason::detailMet:
            return "meets the demand of thin casters";
        case Reason::limitedByTexture:
            return "limited by the texture that holds the map";
        case Reason::switchedOff:
            return "switched off";
    }
    return "unknown";
}

bool isHeld(Reason reason) noexcept {
    switch (reason) {
        case Reason::heldWithoutData:
        case Reason::heldEmptyHistogram:
        case Reason::heldRejectedDemand:
        case Reason::heldBadRadius:
        case Reason::heldBadSettings:
        case Reason::heldBadSlope:
        case Reason::heldOldView:
        case Reason::switchedOff:
            return true;
        default:
            return false;
    }
}

ResolutionController::ResolutionController(const Settings& settings) : settings_(settings) {
    if (const std::string problem = validate(settings); !problem.empty()) {
        throw std::invalid_argument("resolution controller: " + problem);
    }
    const Limits all = limits({});
    Decision& first = state_.last;
    first.size =
        std::clamp(levelAtLeast(settings.startSize, settings.levelRatio).value_or(all.high),
                   all.low, all.high);
    first.previousSize = first.fadeFromSize = first.size;
    first.map = constantsFor(first.size, settings.textureSize, 0, 0);
}

ResolutionController::ResolutionController(const Settings& settings, const ControllerState& state)
    : ResolutionController(settings) {
    if (const std::string problem = validate(state); !problem.empty()) {
        throw std::invalid_argument("resolution controller: " + problem);
    }
    state_ = state;
}

std::string ResolutionController::reconfigure(const Settings& settings) {
    std::string problem = validate(settings);
    state_.settingsRefused = !problem.empty();
    state_.slopeRefused = !problem.empty() && !validate(settings.slope).empty();
    if (problem.empty()) {
        if (!chooseAlike(settings, settings_)) state_.falls = {};
        settings_ = settings;
    }
    return problem;
}

void ResolutionController::decideBy(Rules rules) noexcept {
    rules_ = rules;
    state_.falls = {};
}

ResolutionController::Limits ResolutionController::limits(const Frame& frame) const noexcept {
    const Settings& s = settings_;
    Limits result{.low = *levelAtLeast(s.minSize, s.levelRatio),
                  .high = *levelAtMost(largestSize(s), s.levelRatio),
                  .binding = whatLimits(s)};
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
    const auto level = levelAtMost(state_.last.size, settings_.levelRatio);
    return std::clamp(level.value_or(limits.low), limits.low, limits.high);
}

/// What every call does first: time passes.
void ResolutionController::begin(const Frame& frame) noexcept {
    ControllerState& s = state_;
    if (s.framesSinceCut < ControllerState::kNever) ++s.framesSinceCut;
    if (s.fadeFrame < ControllerState::kNever) ++s.fadeFrame;
    if (frame.cameraCut) {
        s.framesSinceCut = 0;
        s.fadeFrame = ControllerState::kNever;
        s.cutPending = true;
    }
    s.largestRadiusUv = frame.largestRadiusUv;
}

/// Why this frame's data do not count, whatever they are.
std::optional<Reason> ResolutionController::unusable(const Frame& frame) const noexcept {
    if (state_.slopeRefused) return Reason::heldBadSlope;
    if (state_.settingsRefused) return Reason::heldBadSettings;
    if (frame.dataAgeFrames > state_.framesSinceCut) return Reason::heldOldView;
    return {};
}

std::int32_t ResolutionController::choose(std::int32_t need, const Limits& limits) noexcept {
    ControllerState& s = state_;
    const std::int32_t target = std::clamp(
        levelAtLeast(need, settings_.levelRatio).value_or(limits.high), limits.low, limits.high);
    const std::int32_t current = within(limits);
    const auto hasRoomFor = [this](std::int64_t level, std::int64_t texels) {
        return texels * 100 < level * settings_.lowerBelowPercent;
    };
    const auto startOver = [&s](std::int32_t size) {
        s.framesBelow = s.largestNeedBelow = 0;
        return size;
    };
    const bool remembers = rules_ >= Rules::fallsRemembered;
    if (!s.hadData || s.cutPending) {
        s.falls = {};
        return startOver(target);
    }
    if (remembers) s.falls.pass(need, s.last.size, settings_.lowerAfterFrames);
    if (target >= current) {
        // No further up than it fell, it follows a limit that is gone.
        if (target > s.fellTo) s.falls.rose(settings_.lowerAfterFrames);
        return startOver(target);
    }

    std::int32_t lower = *levelAtMost(current - 1, settings_.levelRatio);
    if (!hasRoomFor(lower, need)) return startOver(current);
    s.largestNeedBelow = std::max(s.largestNeedBelow, need);
    // Not counted before it is compared: a restored state may stand at the largest number.
    if (s.framesBelow < settings_.lowerAfterFrames - 1) {
        ++s.framesBelow;
        return current;
    }
    if (remembers && fades()) return current;
    if (s.falls.pauses()) return startOver(current);

    // As far down at once as the whole wait allows: a size for each level would pop at each.
    while (lower > limits.low) {
        const std::int32_t next = *levelAtMost(lower - 1, settings_.levelRatio);
        if (!hasRoomFor(next, s.largestNeedBelow)) break;
        lower = next;
    }
    if (remembers) {
        s.falls.fell(settings_.lowerAfterFrames, 1);
        s.fellTo = lower;
    }
    return startOver(lower);
}

Decision ResolutionController::decide(double texels, const DemandHistogram* histogram,
                                      std::uint64_t total, const Frame& frame) noexcept {
    const Limits allowed = limits(frame);
    Need need{.filter = texels, .filterTexels = static_cast<std::int32_t>(std::ceil(texels))};
    if (settings_.texelsPerCaster > 0) {
        need.detailTexels = std::clamp(frame.detailTexels, 0, kLargestNeed);
    }
    Decision d;
    d.size = choose(need.texels(), allowed);
    d.need = need.texels();
    d.artifactRatio = texels / d.size;
    d.shareAbove =
        histogram ? shareAbove(*histogram, total, d.size) : (need.filterTexels > d.size ? 1 : 0);
    if (d.shareAbove > 0) d.minRadiusUv = settings_.slope.c / d.size;
    d.reason = reasonFor(d, need, allowed);
    const bool mayFade = state_.hadData && !state_.cutPending;
    state_.hadData = true;
    state_.cutPending = false;
    return finish(d, mayFade);
}

Reason ResolutionController::reasonFor(const Decision& d, const Need& need,
                                       const Limits& limits) const noexcept {
    if (d.need > d.size) return limits.binding;
    if (d.shareAbove > 0) return Reason::limitedByPercentile;
    const auto levelFor = [&](std::int32_t texels) {  // texels <= size
        return *levelAtLeast(texels, settings_.levelRatio);
    };
    const std::int32_t enough = levelFor(d.need);
    if (std::max(enough, limits.low) < d.size) return Reason::waitingToLower;
    if (enough < limits.low) return Reason::atMinimum;
    return levelFor(need.filterTexels) < enough ? Reason::detailMet : Reason::demandMet;
}

Decision ResolutionController::update(double radiusUv, const Frame& frame) noexcept {
    begin(frame);
    if (const auto reason = unusable(frame)) return held(*reason, frame);
    if (!(radiusUv > 0) || !std::isfinite(radiusUv)) return held(Reason::heldBadRadius, frame);
    double texels = settings_.slope.c *
                    contrastFactor(frame.contrast, settings_.slope.contrastExponent) / radiusUv;
    if (frame.footprintUv > 0 && std::isfinite(frame.footprintUv)) {
        texels = std::min(texels, settings_.pixelBound / frame.footprintUv);
    }
    if (!(state_.radiusUv > 0)) state_.falls = {};  // data of another kind take nothing back
    state_.radiusUv = radiusUv;
    return decide(std::min<double>(texels, kLargestNeed), nullptr, 0, frame);
}

Decision ResolutionController::update(const DemandHistogram& histogram,
                                      const Frame& frame) noexcept {
    begin(frame);
    if (const auto reason = unusable(frame)) return held(*reason, frame);
    const std::uint64_t total = histogram.total();
    if (total == 0) {
        return held(
            histogram.rejected > 0 ? Reason::heldRejectedDemand : Reason::heldEmptyHistogram,
            frame);
    }
    if (state_.radiusUv > 0) state_.falls = {};
    state_.radiusUv = 0;
    return decide(needOf(histogram, total, settings_.percentile), &histogram, total, frame);
}

Decision ResolutionController::hold(const Frame& frame) noexcept {
    begin(frame);
    Frame without = frame;
    without.dataAgeFrames = 0;
    return held(unusable(without).value_or(Reason::heldWithoutData), frame);
}

/// The last decision again, unless a limit has moved or the slope is another: the answer to too few
/// texels is the present slope's.
Decision ResolutionController::held(Reason reason, const Frame& frame) noexcept {
    Decision d = state_.last;
    d.reason = reason;
    d.size = within(limits(frame));
    if (d.size != state_.last.size) {
        d.artifactRatio *= static_cast<double>(state_.last.size) / d.size;
    }
    const bool limited = d.shareAbove > 0 || d.artifactRatio > 1;
    d.minRadiusUv = limited ? settings_.slope.c / d.size : 0;
    return finish(d, state_.hadData);
}

/// Whether the fade that runs goes on in this frame.
bool ResolutionController::fades() const noexcept {
    const double step = 1.0 / (settings_.crossFadeFrames + 1);
    return state_.fadeFrame != ControllerState::kNever &&
           state_.last.fadeWeight + step < 1 - step / 2;  // whatever the sum was rounded to
}

ResolutionController::Fade ResolutionController::fade(const Decision& d, bool mayFade) noexcept {
    ControllerState& s = state_;
    const Fade none{.fromSize = d.size};
    const double step = 1.0 / (settings_.crossFadeFrames + 1);
    const bool running = fades();
    double before = running ? s.last.fadeWeight : 0;
    std::int32_t from = s.last.fadeFromSize;
    if (d.changed) {
        if (running && d.size == from) {
            before = 1 - s.last.fadeWeight;
            from = d.previousSize;
        } else if (!running || before >= 0.5) {
            before = 0;
            from = d.previousSize;
        }
        s.fadeFrame = 1;
    }
    const bool goesOn = mayFade && (running || d.changed) && before + step < 1 - step / 2;
    if (!goesOn) {
        s.fadeFrame = ControllerState::kNever;
        return none;
    }
    return {.fromSize = from, .weight = before + step, .stepsLeft = (1 - before) / step};
}

ResolutionController::Fade ResolutionController::fadeBefore13(const Decision& d,
                                                              bool mayFade) noexcept {
    ControllerState& s = state_;
    const std::int32_t frames = settings_.crossFadeFrames;
    if (d.changed) s.fadeFrame = mayFade ? 1 : ControllerState::kNever;
    if (s.fadeFrame > frames) {
        s.fadeFrame = ControllerState::kNever;
        return {.fromSize = d.size};
    }
    return {.fromSize = d.changed ? d.previousSize : s.last.fadeFromSize,
            .weight = static_cast<double>(s.fadeFrame) / (frames + 1),
            .stepsLeft = static_cast<double>(frames) + 2 - s.fadeFrame};
}

/// What follows from the size: the change, the fade and the constants.
Decision ResolutionController::finish(Decision d, bool mayFade) noexcept {
    ControllerState& s = state_;
    d.previousSize = s.last.size;
    d.changed = d.size != d.previousSize;
    const Fade shown =
        rules_ >= Rules::fallsRemembered ? fade(d, mayFade) : fadeBefore13(d, mayFade);
    d.fadeFromSize = shown.fromSize;
    d.fadeWeight = shown.weight;
    if (d.fadeWeight < 1) {
        // In equal steps, as the maps: a radius that is another at once would jump as far as the
        // size is kept from doing.
        d.minRadiusUv = s.last.minRadiusUv + (d.minRadiusUv - s.last.minRadiusUv) / shown.stepsLeft;
    }
    const double radius = s.radiusUv > 0 ? std::max(s.radiusUv, d.minRadiusUv) : 0;
    d.map = constantsFor(d.size, settings_.textureSize, radius,
                         std::max(s.largestRadiusUv, d.minRadiusUv));
    return s.last = d;
}

}  // namespace resolution_controller

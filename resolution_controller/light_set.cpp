// SPDX-License-Identifier: MIT
#include "resolution_controller/light_set.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "resolution_controller/sentence.h"

namespace resolution_controller {
namespace {

Decision decide(ResolutionController& controller, const LightData& data,
                const Frame& frame) noexcept {
    switch (data.kind) {
        case LightData::Kind::radius:
            return controller.update(data.radiusUv, frame);
        case LightData::Kind::histogram:
            if (data.histogram) return controller.update(*data.histogram, frame);
            break;
        default:
            break;
    }
    return controller.hold(frame);
}

/// So much less that a level could be saved.
bool isBelow(std::int64_t texels, std::int64_t others, const Settings& settings) noexcept {
    return texels * 100 < others * settings.lowerBelowPercent;
}

/// As ResolutionController::choose lowers a size: what the need falls to in this frame; absent:
/// nothing.
std::optional<std::int32_t> fallsLate(HeldNeed& held, std::int32_t need,
                                      const Settings& settings) noexcept {
    if (!isBelow(need, held.texels, settings)) {
        held.texels = std::max(held.texels, need);
        held.framesBelow = held.largestBelow = 0;
        return {};
    }
    held.largestBelow = std::max(held.largestBelow, need);
    if (held.framesBelow < settings.lowerAfterFrames - 1) {
        ++held.framesBelow;
        return {};
    }
    const std::int32_t lower = held.largestBelow;
    held.framesBelow = held.largestBelow = 0;
    return lower;
}

constexpr std::int32_t kTrialTimes = 2;  // the others take the texels first

/// `mapSize` is that of the map which the need was measured on.
void follow(HeldNeed& held, const LightData& data, std::int32_t need, std::int32_t mapSize,
            const Settings& settings) noexcept {
    if (data.kind != held.fellBy) held.falls.trialFrames = 0;
    held.falls.pass(need, mapSize, settings.lowerAfterFrames);
    if (isBelow(held.fellTo, need, settings)) held.falls.rose(settings.lowerAfterFrames);
    const auto lower = fallsLate(held, need, settings);
    if (!lower || held.falls.pauses()) return;
    held.texels = held.fellTo = *lower;
    held.fellBy = data.kind;
    held.falls.fell(settings.lowerAfterFrames, kTrialTimes);
}

/// The same by Rules::needsRemembered and older ones.
void followBefore13(HeldNeed& held, const LightData& data, std::int32_t need,
                    const Settings& settings, Rules rules) noexcept {
    std::int32_t& trialFrames = held.falls.trialFrames;
    if (data.kind != held.fellBy) trialFrames = 0;
    if (trialFrames > 0) {
        --trialFrames;
        if (isBelow(held.fellTo, need, settings)) {
            held.regretted = held.fellTo;
            trialFrames = 0;
        }
    }
    const auto lower = fallsLate(held, need, settings);
    if (!lower) return;
    const bool again = held.regretted > 0 && !isBelow(*lower, held.regretted, settings) &&
                       !isBelow(held.regretted, *lower, settings);
    if (again && rules == Rules::needsRemembered) return;
    constexpr std::int32_t kLongest = std::numeric_limits<std::int32_t>::max() / 2;
    held.texels = held.fellTo = *lower;
    held.fellBy = data.kind;
    trialFrames = 2 * std::min(settings.lowerAfterFrames, kLongest);
    held.regretted = 0;
}

/// Whether only a pause keeps the need from falling: the data of the map that the light has ask for
/// less.
bool isKeptByAPause(const HeldNeed& held, const Settings& settings) noexcept {
    return held.falls.pauses() && held.falls.needOnSize > 0 &&
           isBelow(held.falls.needOnSize, held.texels, settings);
}

}  // namespace

std::string validate(const HeldNeed& need) {
    if (need.texels < 0 || need.texels > 65536 || need.largestBelow < 0 ||
        need.largestBelow > 65536) {
        return sentence("heldNeed.texels", need.texels,
                        "it and largestBelow must be in 0 to 65536");
    }
    if (need.framesBelow < 0) {
        return sentence("heldNeed.framesBelow", need.framesBelow, "must be at least 0");
    }
    for (const std::int32_t texels : {need.fellTo, need.regretted}) {
        if (texels < 0 || texels > 65536) {
            return sentence("heldNeed.fellTo", texels, "it and regretted must be in 0 to 65536");
        }
    }
    return validate(need.falls);
}

LightSet::LightSet(std::span<const Settings> settings) {
    if (settings.size() > kMostLights) {
        throw std::invalid_argument(sentence("number of lights",
                                             static_cast<double>(settings.size()),
                                             "must be at most " + std::to_string(kMostLights)));
    }
    lights_.reserve(settings.size());
    for (std::size_t i = 0; i < settings.size(); ++i) {
        try {
            lights_.push_back(
                {.controller = ResolutionController(settings[i]), .need = {}, .before = {}});
        } catch (const std::invalid_argument& problem) {
            throw std::invalid_argument("light " + std::to_string(i) + ": " + problem.what());
        }
    }
    shares_.resize(settings.size());
    scratch_.resize(settings.size());
    decisions_.resize(settings.size());
}

std::string LightSet::reconfigure(std::size_t light, const Settings& settings) {
    if (light >= lights_.size()) {
        return sentence("light", static_cast<double>(light),
                        "must be below their number, " + std::to_string(lights_.size()));
    }
    Light& l = lights_[light];
    const Settings before = l.controller.settings();
    std::string problem = l.controller.reconfigure(settings);
    if (rules_ >= Rules::fallsRemembered && !chooseAlike(l.controller.settings(), before)) {
        l.need.falls = {};
    }
    return problem;
}

void LightSet::decideBy(Rules rules) noexcept {
    rules_ = rules;
    for (Light& light : lights_) {
        light.controller.decideBy(rules);
        light.need.falls = {};
        light.need.regretted = 0;
    }
}

void LightSet::restore(std::size_t light, const ControllerState& state, const HeldNeed& need) {
    Light& l = lights_.at(light);
    if (const std::string problem = validate(need); !problem.empty()) {
        throw std::invalid_argument("light " + std::to_string(light) + ": " + problem);
    }
    l.controller = ResolutionController(l.controller.settings(), state);
    l.need = need;
    if (rules_ >= Rules::fallsRemembered) return;
    l.controller.decideBy(rules_);
    l.need.falls = {.trialFrames = need.falls.trialFrames};
}

/// What the light would do without the others.
void LightSet::decideAlone(Light& light, const LightData& data, Decision& decision) noexcept {
    light.before = light.controller.state();
    light.on = data.kind != LightData::Kind::off;
    decision = decide(light.controller, data, data.frame);
    if (!light.on) {
        decision.reason = Reason::switchedOff;
    } else if (!isHeld(decision.reason)) {
        const bool atOnce =
            !light.before.hadData || light.before.cutPending || data.frame.cameraCut;
        HeldNeed& held = light.need;
        if (atOnce) {
            held = {.texels = decision.need};
            return;
        }
        const Settings& settings = light.controller.settings();
        if (rules_ >= Rules::fallsRemembered) {
            follow(held, data, decision.need, light.before.last.size, settings);
        } else {
            followBefore13(held, data, decision.need, settings, rules_);
        }
    }
}

/// Shares the budget out where the lights' own choices, or the needs they are held at, exceed it.
BudgetUse LightSet::share(std::span<const LightData> data, std::span<Decision> decisions,
                          std::int64_t budget) noexcept {
    const auto frameOf = [&](std::size_t i) { return i < data.size() ? data[i].frame : Frame{}; };
    BudgetUse own;
    std::size_t on = 0;
    for (std::size_t i = 0; i < lights_.size(); ++i) {
        const Light& light = lights_[i];
        if (!light.on) continue;
        const Settings& settings = light.controller.settings();
        const auto limits = light.controller.limits(frameOf(i));
        const std::int32_t need = light.need.texels > 0 ? light.need.texels : decisions[i].size;
        std::int32_t level = levelAtLeast(need, settings.levelRatio).value_or(limits.high);
        if (isKeptByAPause(light.need, settings)) level = std::min(level, decisions[i].size);
        shares_[on++] = {.need = need,
                         .lowest = limits.low,
                         .wanted = std::clamp(level, limits.low, limits.high),
                         .costPerTexel = settings.budgetPerTexel,
                         .levelRatio = settings.levelRatio};
        const auto edge =
            static_cast<std::uint64_t>(std::max(decisions[i].size, shares_[on - 1].wanted));
        own.wanted += edge * edge * static_cast<std::uint64_t>(settings.budgetPerTexel);
    }
    own.used = own.wanted;
    if (budget >= 0 && own.wanted <= static_cast<std::uint64_t>(budget)) return own;

    const BudgetUse use = shareBudget(std::span(shares_).first(on), budget, scratch_);
    on = 0;
    for (std::size_t i = 0; i < lights_.size(); ++i) {
        Light& light = lights_[i];
        if (!light.on) continue;
        const std::int32_t size = shares_[on++].size;
        if (decisions[i].size <= size) continue;
        Frame frame = frameOf(i);
        frame.budgetSize = std::min(size, frame.budgetSize.value_or(size));
        light.controller.restore(light.before);
        decisions[i] = decide(light.controller, i < data.size() ? data[i] : LightData{}, frame);
    }
    return use;
}

LightSummary LightSet::update(std::span<const LightData> data, std::span<Decision> decisions,
                              const Budget& budget) noexcept {
    for (std::size_t i = 0; i < lights_.size(); ++i) {
        decideAlone(lights_[i], i < data.size() ? data[i] : LightData{}, decisions_[i]);
    }
    LightSummary summary;
    if (budget.texels) {
        summary.budget = share(data, decisions_, *budget.texels);
    }
    std::uint64_t used = 0;
    for (std::size_t i = 0; i < lights_.size(); ++i) {
        const Decision& d = decisions_[i];
        summary.changes += d.changed;
        if (!lights_[i].on) continue;
        const auto edge = static_cast<std::uint64_t>(d.size);
        used += edge * edge *
                static_cast<std::uint64_t>(lights_[i].controller.settings().budgetPerTexel);
        if (d.artifactRatio > summary.worstArtifactRatio) {
            summary.worstArtifactRatio = d.artifactRatio;
            summary.worstLight = i;
        }
    }
    summary.budget.used = used;
    if (!budget.texels) summary.budget.wanted = used;
    std::copy_n(decisions_.begin(), std::min(decisions.size(), decisions_.size()),
                decisions.begin());
    return summary;
}

}  // namespace resolution_controller

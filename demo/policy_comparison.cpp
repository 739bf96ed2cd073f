// SPDX-License-Identifier: MIT
#include "demo/policy_comparison.h"

#include <algorithm>
#include <cmath>

namespace demo {

PolicyResult evaluate(const SweepTable& table, const SizingPolicy& policy,
                      const std::string& technique, int step) {
    PolicyResult result;
    result.policy = &policy;
    result.technique = technique;
    result.step = step;
    result.parameter = policyParameter(policy.standard, step);
    RippleCounts ripples;
    double logs = 0;
    for (const std::string& scene : table.scenes) {
        RippleCounts ofScene;
        double sum = 0;
        double rmse = 0;
        for (int frame = 0; frame < table.frames; ++frame) {
            const std::vector<int>* sizes =
                table.sizesOf(std::string(policy.name), scene, frame, technique);
            if (sizes == nullptr || sizes->size() != 2 * kPolicySteps + 1) {
                result.missing = scene + " frame " + std::to_string(frame) + " has no sizes";
                sum = NAN;
                continue;
            }
            const int size = (*sizes)[static_cast<std::size_t>(step + kPolicySteps)];
            result.smallest = result.smallest == 0 ? size : std::min(result.smallest, size);
            result.largest = std::max(result.largest, size);
            const SweepCell* cell = table.find(scene, frame, technique, size);
            if (cell == nullptr || !cell->measured()) {
                result.missing = scene + " frame " + std::to_string(frame) + " at " +
                                 std::to_string(size) + ": " +
                                 (cell == nullptr ? "not in the sweep" : cell->status);
                sum = NAN;
                continue;
            }
            if (!table.convergedAgainst(*cell)) {
                result.missing = scene + " frame " + std::to_string(frame) + " at " +
                                 std::to_string(size) + ": its reference is " +
                                 std::to_string(cell->reference) + " alone";
                sum = NAN;
                continue;
            }
            sum += cell->frameMs.median;
            rmse = std::max(rmse, cell->rmse);
            addCounts(ofScene, cell->ripples);
        }
        result.rippleP95 = std::max(result.rippleP95, rippleP95(ofScene));
        addCounts(ripples, ofScene);
        result.sceneMs.push_back(sum / table.frames);
        result.sceneRmse.push_back(rmse);
        result.worstRmse = std::max(result.worstRmse, rmse);
        logs += std::log(sum / table.frames);
    }
    result.geometricMeanMs = std::exp(logs / static_cast<double>(table.scenes.size()));
    result.rippleP95Together = rippleP95(ripples);
    return result;
}

std::optional<PolicyResult> calibrated(const SweepTable& table, const SizingPolicy& policy,
                                       const std::string& technique, RippleOver over,
                                       double bound) {
    std::optional<PolicyResult> best;
    for (int step = -kPolicySteps; step <= kPolicySteps; ++step) {
        PolicyResult result = evaluate(table, policy, technique, step);
        if (!result.complete() || !(result.ripple(over) <= bound)) continue;
        if (!best || result.geometricMeanMs < best->geometricMeanMs) best = std::move(result);
    }
    return best;
}

std::optional<PolicyResult> leastRipple(const SweepTable& table, const SizingPolicy& policy,
                                        const std::string& technique, RippleOver over) {
    std::optional<PolicyResult> least;
    for (int step = -kPolicySteps; step <= kPolicySteps; ++step) {
        PolicyResult result = evaluate(table, policy, technique, step);
        if (!result.complete()) continue;
        if (!least || result.ripple(over) < least->ripple(over)) least = std::move(result);
    }
    return least;
}

std::vector<PolicyComparison> comparePolicies(const SweepTable& table, RippleOver over,
                                              double bound) {
    std::vector<PolicyComparison> all;
    for (const std::string& technique : table.techniques) {
        PolicyComparison comparison;
        comparison.technique = technique;
        comparison.over = over;
        comparison.bound = bound;
        comparison.ours = calibrated(table, automaticPolicy(), technique, over, bound);
        if (!comparison.ours)
            if (const auto least = leastRipple(table, automaticPolicy(), technique, over)) {
                comparison.bound = least->ripple(over);
                comparison.ours =
                    calibrated(table, automaticPolicy(), technique, over, comparison.bound);
            }
        for (const SizingPolicy& policy : sizingPolicies()) {
            PolicyComparison::Entry entry;
            entry.policy = &policy;
            entry.result = calibrated(table, policy, technique, over, comparison.bound);
            if (!entry.result) entry.nearest = leastRipple(table, policy, technique, over);
            if (entry.result && comparison.ours)
                entry.timesOurs = entry.result->geometricMeanMs / comparison.ours->geometricMeanMs;
            comparison.entries.push_back(std::move(entry));
        }
        all.push_back(std::move(comparison));
    }
    return all;
}

std::vector<SlopeStep> sweepOverSlope(const SweepTable& table, const std::string& technique,
                                      const std::vector<double>& slopes) {
    std::vector<SlopeStep> steps;
    for (const double c : slopes) {
        const int step =
            std::clamp(static_cast<int>(std::lround(8 * std::log2(c / automaticPolicy().standard))),
                       -kPolicySteps, kPolicySteps);
        steps.push_back({policyParameter(automaticPolicy().standard, step),
                         evaluate(table, automaticPolicy(), technique, step)});
    }
    return steps;
}

}  // namespace demo

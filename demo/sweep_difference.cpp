// SPDX-License-Identifier: MIT
#include "demo/sweep_difference.h"

namespace demo {
namespace {

// Errors repeat exactly on one machine; drivers round differently.
constexpr double kLeastWorsening = 0.002;
constexpr double kLeastFactor = 1.1;

}  // namespace

std::vector<SweepDifference> slowerOrWorse(const SweepTable& before, const SweepTable& now) {
    std::vector<SweepDifference> all;
    for (const SweepCell& old : before.cells) {
        if (!old.measured()) continue;
        const auto add = [&](const char* what, double was, double is) {
            all.push_back({old.scene, old.frame, old.technique, old.resolution, what, was, is});
        };
        const SweepCell* cell = now.find(old.scene, old.frame, old.technique, old.resolution);
        if (cell == nullptr || !cell->measured()) {
            add("missing", old.frameMs.median, 0);
            continue;
        }
        if (cell->frameMs.median > kLeastFactor * old.frameMs.median &&
            cell->frameMs.p25 > old.frameMs.p75)
            add("slower", old.frameMs.median, cell->frameMs.median);
        // A NaN is worse than any number.
        if (!(cell->rmse <= kLeastFactor * old.rmse + kLeastWorsening))
            add("worse", old.rmse, cell->rmse);
    }
    return all;
}

}  // namespace demo

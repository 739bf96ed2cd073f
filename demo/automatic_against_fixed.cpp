// SPDX-License-Identifier: MIT
#include "demo/automatic_against_fixed.h"

#include <algorithm>
#include <cmath>

namespace demo {
namespace {

const DirectRow* automaticRow(const std::vector<DirectRow>& direct, const std::string& scene,
                              int frame, const std::string& technique) {
    const auto found = std::find_if(direct.begin(), direct.end(), [&](const DirectRow& row) {
        return row.policy == kControllerRun && row.scene == scene && row.frame == frame &&
               row.technique == technique;
    });
    return found == direct.end() ? nullptr : &*found;
}

AutomaticAgainstFixed compared(const std::vector<DirectRow>& direct, const SweepTable& table,
                               const std::string& technique, int fixedSize) {
    AutomaticAgainstFixed result{.technique = technique, .fixed = fixedSize, .times = {}};
    RippleCounts ripples;
    double logs = 0;
    for (const std::string& scene : table.scenes) {
        RippleCounts ofScene;
        double automaticMs = 0, fixedMs = 0;
        for (int frame = 0; frame < table.frames; ++frame) {
            const DirectRow* automatic = automaticRow(direct, scene, frame, technique);
            const SweepCell* fixed = table.find(scene, frame, technique, fixedSize);
            const bool both = automatic != nullptr && fixed != nullptr && fixed->measured();
            automaticMs += both ? automatic->frameMs : NAN;
            fixedMs += both ? fixed->frameMs.median : NAN;
            if (!both) continue;
            if (automatic->resolution > automatic->reference) {
                ++result.finerFrames;
                continue;
            }
            result.worstRmse = std::max(result.worstRmse, automatic->rmse);
            addCounts(ofScene, automatic->ripples);
        }
        result.rippleP95 = std::max(result.rippleP95, rippleP95(ofScene));
        addCounts(ripples, ofScene);
        result.times.push_back(fixedMs / automaticMs);
        logs += std::log(result.times.back());
    }
    result.geometricMean = std::exp(logs / static_cast<double>(table.scenes.size()));
    result.rippleMost = static_cast<double>(ripples.size()) / 255;
    return result;
}

}  // namespace

std::vector<AutomaticAgainstFixed> automaticAgainstFixed(const std::vector<DirectRow>& direct,
                                                         const SweepTable& table,
                                                         const std::vector<int>& fixedSizes) {
    std::vector<AutomaticAgainstFixed> all;
    for (const std::string& technique : table.techniques)
        for (const int size : fixedSizes) all.push_back(compared(direct, table, technique, size));
    return all;
}

}  // namespace demo

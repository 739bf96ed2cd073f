// SPDX-License-Identifier: MIT
#include "demo/speed_error_front.h"

#include <algorithm>
#include <cmath>

namespace demo {
namespace {

/// False where a frame was not measured.
bool addScene(const SweepTable& table, const std::string& scene, SpeedAndError& point,
              double& logs) {
    double sum = 0;
    for (int frame = 0; frame < table.frames; ++frame) {
        const SweepCell* cell = table.find(scene, frame, point.technique, point.resolution);
        if (cell == nullptr || !cell->measured() || cell->resolution == cell->reference ||
            !table.convergedAgainst(*cell))
            return false;
        sum += cell->frameMs.median;
        point.error = std::max(point.error, cell->rmse);
    }
    logs += std::log(sum / table.frames);
    return true;
}

}  // namespace

std::vector<SpeedAndError> speedAndErrors(const SweepTable& table, const std::string& scene) {
    const std::vector<std::string> scenes =
        scene.empty() ? table.scenes : std::vector<std::string>{scene};
    std::vector<SpeedAndError> all;
    for (const std::string& technique : table.techniques)
        for (const int size : table.sizes) {
            SpeedAndError point;
            point.technique = technique;
            point.resolution = size;
            double logs = 0;
            if (!std::all_of(scenes.begin(), scenes.end(), [&](const std::string& name) {
                    return addScene(table, name, point, logs);
                }))
                continue;
            point.frameMs = std::exp(logs / static_cast<double>(scenes.size()));
            all.push_back(point);
        }
    std::sort(all.begin(), all.end(),
              [](const auto& a, const auto& b) { return a.frameMs < b.frameMs; });
    double best = INFINITY;
    for (SpeedAndError& point : all) {
        point.dominated = !(point.error < best);
        best = std::min(best, point.error);
    }
    return all;
}

const SpeedAndError* recommended(const std::vector<SpeedAndError>& all, const Wish& wish) {
    const SpeedAndError* best = nullptr;
    for (const SpeedAndError& point : all) {
        if (wish.mostError && !(point.error <= *wish.mostError)) continue;
        if (wish.mostMs && !(point.frameMs <= *wish.mostMs)) continue;
        const bool better = best == nullptr || (wish.mostError ? point.frameMs < best->frameMs
                                                                    : point.error < best->error);
        if (better) best = &point;
    }
    return best;
}

}  // namespace demo

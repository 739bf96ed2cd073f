// SPDX-License-Identifier: MIT
#include "resolution_controller/fall_memory.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "resolution_controller/sentence.h"

namespace resolution_controller {
namespace {

constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max();

bool isFarBelow(std::int64_t texels, std::int64_t others) noexcept {
    return texels * 100 < others * FallMemory::kSceneChangedPercent;
}

/// In which data of another map arrive.
std::int32_t arrivalFrames(std::int32_t lowerAfterFrames) noexcept {
    return std::max(lowerAfterFrames, FallMemory::kArrivalFrames);
}

}  // namespace

void FallMemory::pass(std::int32_t need, std::int32_t mapSize,
                      std::int32_t lowerAfterFrames) noexcept {
    if (trialFrames > 0 && --trialFrames == 0) takenBack = 0;  // the fall has lasted
    if (pauseFrames > 0) --pauseFrames;
    if (mapSize != size) {
        size = mapSize;
        framesOnSize = needOnSize = 0;
    } else if (framesOnSize < arrivalFrames(lowerAfterFrames)) {
        ++framesOnSize;
    } else if (needOnSize == 0) {
        needOnSize = need;
    } else if (isFarBelow(need, needOnSize) || isFarBelow(needOnSize, need)) {
        needOnSize = need;  // the scene has changed
        trialFrames = takenBack = pauseFrames = 0;
    }
}

void FallMemory::fell(std::int32_t lowerAfterFrames, std::int32_t times) noexcept {
    const std::int64_t frames = std::int64_t{arrivalFrames(lowerAfterFrames)} * times;
    trialFrames = static_cast<std::int32_t>(std::min(frames, kMost));
}

void FallMemory::rose(std::int32_t lowerAfterFrames) noexcept {
    if (trialFrames == 0) return;
    trialFrames = 0;
    takenBack = std::min(takenBack + 1, kMostTakenBack);
    const std::int64_t first = std::int64_t{kPauseWaits} * std::max(lowerAfterFrames, 1);
    pauseFrames = static_cast<std::int32_t>(std::min(first << (takenBack - 1), kMost));
}

std::string validate(const FallMemory& falls) {
    if (falls.takenBack < 0 || falls.takenBack > FallMemory::kMostTakenBack) {
        return sentence("falls.takenBack", falls.takenBack, "must be in 0 to 20");
    }
    for (const auto& [name, frames] : {std::pair{"falls.trialFrames", falls.trialFrames},
                                       {"falls.pauseFrames", falls.pauseFrames},
                                       {"falls.framesOnSize", falls.framesOnSize}}) {
        if (frames < 0) return sentence(name, frames, "must be at least 0");
    }
    for (const auto& [name, texels] :
         {std::pair{"falls.size", falls.size}, {"falls.needOnSize", falls.needOnSize}}) {
        if (texels < 0 || texels > 65536) return sentence(name, texels, "must be in 0 to 65536");
    }
    return {};
}

}  // namespace resolution_controller

// SPDX-License-Identifier: MIT
// Falls that were taken back, and when to try again.
//
// What is measured depends on the map that it is measured on: on a smaller one the same view may
// ask for more. A size, or the need that a budget goes by, that falls, is taken back and falls
// again would go up and down for ever in a still scene. So a fall is on trial until the data of the
// smaller map have come. A rise in that time takes it back, and nothing falls again until a pause
// is over: 64 waits at first, twice as long after every further fall in a row that is taken back.
//
// Where the scene was what changed, nothing is to be paused for, and that shows: once the data of a
// map have come, what they ask for differs only if the scene does. Then all is forgotten, as it is
// after a fall that lasts. A scene that asks for more right after a fall, and for less again before
// data would have come, cannot be told from such a map, and costs a pause.
//
// Integers only, no allocation: the same on every machine.
#pragma once

#include <cstdint>
#include <string>

namespace resolution_controller {

struct FallMemory {
    /// Frames with data, at least: a few of latency and the 16 to 36 that a renderer sums up.
    static constexpr std::int32_t kArrivalFrames = 45;
    /// The first pause, chosen by eye: 48 s of 60 frames at a wait of 45.
    static constexpr std::int32_t kPauseWaits = 64;
    /// A scene has changed where its need is below this share, in percent, of what it was, or the
    /// reverse: a level's worth.
    static constexpr std::int32_t kSceneChangedPercent = 80;
    static constexpr std::int32_t kMostTakenBack = 20;

    std::int32_t trialFrames = 0;   ///< left in which a rise takes the last fall back
    std::int32_t takenBack = 0;     ///< falls in a row
    std::int32_t pauseFrames = 0;   ///< left in which nothing falls
    std::int32_t size = 0;          ///< of the map that is measured on, texels
    std::int32_t framesOnSize = 0;  ///< in a row
    std::int32_t needOnSize = 0;    ///< once its data have come, texels; 0 before

    /// A frame with data that ask for `need`, measured on a map of `mapSize`.
    void pass(std::int32_t need, std::int32_t mapSize, std::int32_t lowerAfterFrames) noexcept;
    /// It fell, and is on trial for so many times as long as data take.
    void fell(std::int32_t lowerAfterFrames, std::int32_t times) noexcept;
    /// It rose.
    void rose(std::int32_t lowerAfterFrames) noexcept;
    /// Nothing is to fall in this frame.
    bool pauses() const noexcept { return pauseFrames > 0; }

    bool operator==(const FallMemory&) const = default;
};

/// Empty when it can be; else a sentence that names field, value and rule.
std::string validate(const FallMemory& falls);

}  // namespace resolution_controller

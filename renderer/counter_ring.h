// SPDX-License-Identifier: MIT
// Counters that a compute pass adds up on the GPU and that come back some frames later without
// anybody waiting for them.
//
//   CounterRing ring(65, "demand");
//   every frame:
//       if (const auto reading = ring.newest()) ...
//       ring.begin();  // zeroed, bound as storage buffer 0
//       glDispatchCompute(...);
//       ring.end();
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "renderer/gl_object.h"

namespace renderer {

class CounterRing {
  public:
    static constexpr std::size_t kFrames = 4;          ///< that may be under way
    static constexpr std::size_t kMostCounters = 128;  ///< of 32 bits

    struct Reading {
        std::array<std::uint32_t, kMostCounters> counters{};
        int age = 0;                   ///< submissions since: 0 for the last
        std::uint64_t submission = 0;  ///< counted from 0
    };

    /// Throws std::runtime_error where the driver cannot map the buffer. The label shows in GL
    /// debuggers.
    CounterRing(std::size_t counters, std::string_view label);
    ~CounterRing();
    CounterRing(const CounterRing&) = delete;
    CounterRing& operator=(const CounterRing&) = delete;

    void begin();
    void end();

    /// The newest submission that the GPU has finished and that was not returned before; absent
    /// where there is none. Never waits.
    std::optional<Reading> newest();

    std::uint64_t submissions() const { return submissions_; }
    /// Submissions that were overwritten before the GPU had finished them: 0 unless it is more than
    /// kFrames behind.
    int lost() const { return lost_; }

  private:
    struct Slot {
        GLsync fence = nullptr;  // null: nothing under way
        std::uint64_t submission = 0;
    };
    static constexpr std::size_t kSlotBytes = 512;  // offsets of storage buffers are coarse
    static_assert(kMostCounters * sizeof(std::uint32_t) <= kSlotBytes);

    static void release(Slot& slot);

    std::size_t bytes_;
    Buffer counters_;  // on the GPU
    Buffer ring_;      // mapped for good
    const std::byte* mapped_ = nullptr;
    std::array<Slot, kFrames> slots_{};
    std::uint64_t submissions_ = 0;
    int lost_ = 0;
};

}  // namespace renderer

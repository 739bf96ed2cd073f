// SPDX-License-Identifier: MIT
// Counters that a compute pass adds up on the GPU and that come back some frames later without
// anybody waiting for them. Every submission comes back, in the order in which they were made.
//
//   CounterRing ring(65, "demand");
//   every frame:
//       while (const auto reading = ring.next()) ...
//       if (!ring.hasRoom()) return;
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
    static constexpr std::size_t kFrames = 4;          ///< that may be under way or wait for next()
    static constexpr std::size_t kMostCounters = 128;  ///< of 32 bits

    struct Reading {
        std::array<std::uint32_t, kMostCounters> counters{};
        std::uint64_t submission = 0;  ///< counted from 0
    };

    /// Throws std::runtime_error where the driver cannot map the buffer. The label shows in GL
    /// debuggers.
    CounterRing(std::size_t counters, std::string_view label);
    ~CounterRing();
    CounterRing(const CounterRing&) = delete;
    CounterRing& operator=(const CounterRing&) = delete;

    /// Where there is none, nothing may be submitted: it would overwrite what is still to come
    /// back.
    bool hasRoom() const { return submissions_ - returned_ < kFrames; }
    void begin();
    void end();

    /// The oldest submission that was not returned before, if the GPU has finished it; absent where
    /// there is none. Never waits.
    std::optional<Reading> next();
    /// None of the submissions so far is returned any more, and all their room is free.
    void forget();

    std::uint64_t submissions() const { return submissions_; }

  private:
    static constexpr std::size_t kSlotBytes = 512;  // offsets of storage buffers are coarse
    static_assert(kMostCounters * sizeof(std::uint32_t) <= kSlotBytes);

    /// Where in the ring the oldest is that was not returned.
    std::size_t oldest() const { return returned_ % kFrames; }
    /// Done with the oldest.
    void release();

    std::size_t bytes_;
    Buffer counters_;  // on the GPU
    Buffer ring_;      // mapped for good
    const std::byte* mapped_ = nullptr;
    std::array<GLsync, kFrames> fences_{};
    std::uint64_t submissions_ = 0;
    std::uint64_t returned_ = 0;  // or forgotten
};

}  // namespace renderer

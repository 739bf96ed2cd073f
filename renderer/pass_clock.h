// SPDX-License-Identifier: MIT
// How long the passes of a frame take. On a GPU by timer queries. On a software rasteriser timer
// queries are wrong (a pass of 65 ms reads as .7 ms), so there the clock finishes the queue around
// each pass and reads a steady clock; that costs overlap, so the time of a whole frame is measured
// in other frames, without a PassClock.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <string_view>
#include <vector>

#include "renderer/gl_context.h"
#include "renderer/gl_object.h"

namespace renderer {

enum class Pass { depth, prefilter, prepass, lookup, lit, demand };
inline constexpr std::size_t kPasses = 6;
inline constexpr std::array<Pass, kPasses> kAllPasses = {
    Pass::depth, Pass::prefilter, Pass::prepass, Pass::lookup, Pass::lit, Pass::demand};
std::string_view toText(Pass pass);

using PassTimesMs =
    std::array<double, kPasses>;  ///< indexed by Pass; 0 for a pass that the frame did not have

class PassClock {
  public:
    explicit PassClock(const GlInfo& info);

    /// Between begin() and end() of the same pass; several stretches of one pass add up.
    void begin(Pass pass);
    void end(Pass pass);

    /// The times since the last call; waits for the GPU.
    PassTimesMs collectMs();
    /// "timer queries" or "finish and steady clock".
    std::string_view method() const;

  private:
    bool byQueries_;
    std::array<std::vector<Query>, kPasses> queries_;  // one for each begin() of a pass in a frame
    std::array<std::size_t, kPasses> used_{};
    std::chrono::steady_clock::time_point start_;
    PassTimesMs times_{};
};

}  // namespace renderer

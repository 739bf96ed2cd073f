// SPDX-License-Identifier: MIT
// What a LightSet was given and what it decided, frame by frame, as bytes: for a bug report, and to
// be replayed in a test.
//
//     TraceWriter trace(buffer);                       // a fixed buffer of the caller's
//     trace.begin(lights);                             // at any frame
//     // every frame, after update():
//     trace.frame(data, budget, decisions);
//     writeFile(trace.bytes());
//     // later, anywhere:
//     const ReplayReport report = replay(bytes);       // same == true: the same decisions
//
// Writing neither allocates nor throws. A buffer that is full takes no further frame; what is in it
// stays good. To keep the last frames instead of the first ones, begin() anew every now and then in
// another buffer: a trace starts with the state that the lights are in.
//
// Format: little-endian whatever the machine, 64-bit IEEE numbers by their bits.
//     header    "STWTRACE", u16 major 1, u16 minor 3, u32 number of lights
//     lights    settings, state and held need of each
//     records   u8 kind, then for a frame: budget, for each light data, and for each light the
//               decision (size, reason, need, fade weight, min radius); for a change of settings:
//               u32 light, settings
// A reader refuses another major version, a minor one above its own and anything after which a
// record cannot be trusted. The minor version rises where the same data come to other decisions,
// and older ones are replayed by the rules of their time: in 1.0 a size that was held without data
// kept its least radius when the slope became another, and no least radius was faded; before 1.2 no
// fall of a light's need under a budget was remembered, and in 1.2 it was for ever; before 1.3 no
// fall of a size was, no need paused, so that no light's share was capped by that, a change of size
// within a fade began another, lowerings did not wait for a fade's end, and other crossFadeFrames
// gave a fade that ran another weight at once. A set that decides by older rules
// (LightSet::decideBy) writes traces of their version.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "resolution_controller/light_set.h"

namespace resolution_controller {

inline constexpr std::uint16_t kTraceMajor = 1;
inline constexpr auto kTraceMinor = static_cast<std::uint16_t>(kPresentRules);

class TraceWriter {
  public:
    /// The buffer must outlive the writer.
    explicit TraceWriter(std::span<std::byte> buffer) noexcept : buffer_(buffer) {}

    /// Starts over with the state that the lights are in. False: the buffer is too small even for
    /// that, and nothing is recorded.
    bool begin(const LightSet& lights) noexcept;
    /// The arguments of LightSet::update and what it decided. False: it did not fit (or begin() did
    /// not succeed, or the numbers of entries are not that of the lights), and none will from here
    /// on.
    bool frame(std::span<const LightData> data, const Budget& budget,
               std::span<const Decision> decisions) noexcept;
    /// A call of LightSet::reconfigure, whatever it returned.
    bool reconfigured(std::size_t light, const Settings& settings) noexcept;

    std::span<const std::byte> bytes() const noexcept { return buffer_.first(used_); }
    std::uint64_t frames() const noexcept { return frames_; }
    std::uint64_t lost() const noexcept { return lost_; }  ///< frames that did not fit

  private:
    std::span<std::byte> buffer_;
    std::size_t used_ = 0;
    std::size_t lights_ = 0;
    std::uint64_t frames_ = 0, lost_ = 0;
    bool open_ = false;
};

struct ReplayReport {
    bool same = false;              ///< readable to its end, and every decision was made again
    std::uint64_t frames = 0;       ///< that were decided again
    std::uint64_t differences = 0;  ///< decisions (of one light in one frame) that differ
    std::uint64_t firstFrame = 0;   ///< of them, counted from 0
    std::size_t firstLight = 0;
    /// Empty, or one sentence: the first difference, or why the trace cannot be read any further
    /// (and at which byte); where it both differs and ends badly, both.
    std::string problem;
};

/// Runs the recorded frames through a new LightSet. Does not throw but for lack of memory.
ReplayReport replay(std::span<const std::byte> bytes);

}  // namespace resolution_controller

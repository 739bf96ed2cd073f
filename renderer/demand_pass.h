// SPDX-License-Identifier: MIT
// What the visible pixels of a frame ask of the shadow map, counted on the GPU and read back some
// frames later without waiting for it. The renderer does not know the formula: whoever joins it
// with a controller hands in the controller's GLSL (resolution_controller/demand.glsl) and takes
// the counters to it.
//
//   renderer::DemandPass demand(ShaderLibrary::embedded(), demandGlsl);
//   every frame:
//       if (const auto reading = demand.newest()) controller.update(reading->counters ...);
//       frame.render(settings);
//       demand.submit(frame, rule);
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "renderer/renderer.h"

namespace renderer {

/// The name under which a pass includes the formula, and the shaders with the formula among them.
inline constexpr char kDemandInclude[] = "demand.glsl";
ShaderLibrary withDemand(const ShaderLibrary& shaders, const std::string& demandGlsl);

/// The numbers of the formula, in the order in which its GLSL struct has them.
struct DemandRule {
    float c = 3.47F;             ///< slope of r = c a
    float pixelBound = 1;        ///< texels per pixel that can still be seen
    float contrastExponent = 0;  ///< e of c(C) = c max(C, .02)^e; 0: off
    float texelsPerCaster = 0;   ///< texels across the thinnest caster; 0: off
};

class DemandPass {
  public:
    static constexpr std::size_t kCounters = 65;  ///< 64 bins and one for what was rejected
    static constexpr std::size_t kRing = 4;       ///< frames that may be under way

    struct Reading {
        std::array<std::uint32_t, kCounters> counters{};
        int ageFrames = 0;  ///< submissions since: 1 for the last but one, 0 for the last
    };

    /// Pixels along the edge of a cell, of which one is asked in each frame.
    static constexpr int kCellEdge = 4;

    /// `demandGlsl`: text that defines StairwellDemandRule, stairwellDemand() and
    /// stairwellDemandCounter(). Throws std::runtime_error where it does not compile.
    DemandPass(const ShaderLibrary& shaders, const std::string& demandGlsl);
    ~DemandPass();
    DemandPass(const DemandPass&) = delete;
    DemandPass& operator=(const DemandPass&) = delete;

    /// Counts the demand of the frame that `frame` drew last. Nothing happens before its first
    /// frame. Which pixel of each cell is asked rotates from call to call, so that as many calls as
    /// a cell has pixels ask every pixel once.
    void submit(const Renderer& frame, const DemandRule& rule, PassClock* clock = nullptr);

    /// The newest submission that the GPU has finished and that was not returned before; absent
    /// where there is none. Never waits.
    std::optional<Reading> newest();

    /// Submissions that were overwritten before the GPU had finished them: 0 unless it is more than
    /// kRing frames behind.
    int lost() const { return lost_; }

  private:
    struct Slot {
        GLsync fence = nullptr;  // null: nothing under way
        std::uint64_t submission = 0;
    };
    static constexpr std::size_t kSlotBytes = 512;  // of 260: offsets of storage buffers are coarse

    void release(Slot& slot);

    Program program_;
    Buffer counters_;  // on the GPU
    Buffer ring_;      // mapped for good
    const std::byte* mapped_ = nullptr;
    std::array<Slot, kRing> slots_{};
    std::uint64_t submissions_ = 0;
    int lost_ = 0;
};

}  // namespace renderer

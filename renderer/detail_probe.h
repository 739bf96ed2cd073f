// SPDX-License-Identifier: MIT
// Thin casters that slip between the texels of a coarse map (Kreuzer, section 7): a map of
// kFineEdge texels is drawn tile by tile, and of the visible pixels under each tile one in four,
// always the same ones, are asked whether what lies before them there is narrow, and how many
// texels it takes. What a tile said holds until its turn comes again.
//
//   DetailProbe probe(ShaderLibrary::embedded(), demandGlsl);
//   every few frames, after frame.render():
//       probe.submit(frame, rule);
//   every frame:
//       controller.update(histogram, {.detailTexels = probe.detailTexels()});
//
// A caster is thin where the run of texels before the receiver's plane is short in one direction,
// with light on both sides, and at least three times as long in another; one that a kernel of the
// frame's radius thins out to less than 2 % of the light asks for nothing.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "renderer/demand_pass.h"

namespace renderer {

class DetailProbe {
  public:
    static constexpr int kFineEdge = 4096;  ///< of the finer map, texels
    static constexpr int kTileEdge = 1024;  ///< of the tiles that it is drawn in
    static constexpr int kTilesAlong = kFineEdge / kTileEdge;
    static constexpr int kTiles = kTilesAlong * kTilesAlong;
    /// A caster may be so wide, in texels of the finer map, and still be found thin.
    static constexpr int kWidestTexels = 10;

    /// See DemandPass for `demandGlsl`. Throws std::runtime_error where it does not compile.
    DetailProbe(const ShaderLibrary& shaders, const std::string& demandGlsl);

    /// Takes these shaders from now on; what the tiles said stays. Throws std::runtime_error where
    /// one does not compile, and then the last good ones stay.
    void reload(const ShaderLibrary& shaders);

    /// Draws the next tile of one of the frame's maps under the light of the frame that `frame`
    /// drew last, and asks that frame's pixels. Nothing happens before its first frame, and while
    /// CounterRing::kFrames answers are under way: the tile is the next call's.
    void submit(const Renderer& frame, const DemandRule& rule, std::size_t view = 0);
    /// Every tile at once, and waits for the answers: for a first frame or another scene.
    void submitAll(const Renderer& frame, const DemandRule& rule, std::size_t view = 0);

    /// What the newest readings of all tiles of a map ask for, at most kFineEdge; 0 for nothing.
    /// Never waits.
    int detailTexels(std::size_t view = 0);

    /// Another scene: what the tiles said is forgotten.
    void forget();

  private:
    /// Of one map.
    struct Answers {
        CounterRing ring{DemandPass::kCounters, "detail"};
        std::array<DemandPass::Counters, kTiles> tiles{};
        void take();
    };
    Program makeDetailProgram(const ShaderLibrary& shaders) const;

    std::string demandGlsl_;
    Program program_;
    Texture depths_;
    Framebuffer target_;
    Buffer shadowBlock_;
    std::vector<std::unique_ptr<Answers>> answers_;
};

/// The texels that the samples ask for, from counters as demand.glsl has them: a few samples at the
/// top are left out, since the tip of anything is narrow. 0 for too few.
int detailOf(const DemandPass::Counters& counters);

}  // namespace renderer

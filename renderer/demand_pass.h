// SPDX-License-Identifier: MIT
// What the visible pixels of a frame ask of the shadow map, counted on the GPU and read back some
// frames later without waiting for it. The renderer does not know the formula: whoever joins it
// with a controller hands in the controller's GLSL (resolution_controller/demand.glsl) and takes
// the counters to it.
//
//   renderer::DemandPass demand(ShaderLibrary::embedded(), demandGlsl);
//   every frame:
//       while (const auto counters = demand.next()) recent.add(*counters ...);
//       controller.update(recent.sum());
//       frame.render(settings);
//       demand.submit(frame, rule);
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "renderer/counter_ring.h"
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

/// Whether the technique's kernel differs from point to point: its file says how wide it is
/// (cpu_penumbra.h).
bool hasOwnRadius(const ShaderLibrary& shaders, const Technique& technique);

/// Programs with shared/pixel_demand.glsl: one for the techniques with the same radius everywhere
/// and one for each that has its own, each with and without the contrast term, made when first
/// used.
class PixelDemandPrograms {
  public:
    using Make = std::function<Program(const ShaderOptions&)>;
    /// Throws what `make` throws, as all below.
    PixelDemandPrograms(const ShaderLibrary& shaders, Make make);
    /// Makes the one for a technique and a rule, if it has not been.
    void prepare(const Technique& technique, const DemandRule& rule) { programOf(technique, rule); }
    /// Makes all that another one has.
    void prepareAs(const PixelDemandPrograms& other);
    /// Uses the one for a frame, with the frame's textures and the rule in place.
    void use(const Renderer::Outputs& frame, const DemandRule& rule);
    /// Texture units that pixel_demand.glsl takes, from 0.
    static constexpr unsigned kTextures = 6;

  private:
    /// The technique (null: the same radius everywhere), and whether with the contrast term.
    using Key = std::pair<const Technique*, bool>;
    const Program& programOf(const Technique& technique, const DemandRule& rule);
    const Program& programOf(Key key);

    ShaderLibrary shaders_;
    Make make_;
    std::map<Key, Program> programs_;
};

class DemandPass {
  public:
    static constexpr std::size_t kCounters = 65;  ///< 64 bins and one for what was rejected
    static constexpr std::size_t kRing = CounterRing::kFrames;

    using Counters = std::array<std::uint32_t, kCounters>;

    /// Pixels along the edge of a cell, of which one is asked in each frame: the first, in frames
    /// of more than 2^19 pixels the second. So a frame of 1280 x 720 asks 25,600 pixels, which is
    /// no more than what 1 in 16 is of a smaller one, and every pixel has been asked before the
    /// controller lowers a size (45 frames).
    static constexpr int kCellEdge = 4, kLargeCellEdge = 6;
    static int cellEdge(int widthPx, int heightPx);

    /// `demandGlsl`: text that defines StairwellDemandRule, stairwellDemand(),
    /// stairwellDemandWeight() and stairwellDemandCounter(). Throws std::runtime_error where it
    /// does not compile.
    DemandPass(const ShaderLibrary& shaders, const std::string& demandGlsl);

    /// Takes these shaders from now on; what is under way still arrives. Throws std::runtime_error
    /// where one that has been used does not compile, and then the last good ones stay.
    void reload(const ShaderLibrary& shaders);
    /// Compiles what technique and rule need, if it has not been; throws as the constructor does.
    void prepare(const Technique& technique, const DemandRule& rule) {
        programs_.prepare(technique, rule);
    }

    /// Counts the demand of the frame that `frame` drew last. Which pixel of each cell is asked
    /// rotates from submission to submission, so that as many as a cell has pixels ask every pixel
    /// once. False, and nothing is asked, before the first frame and where kRing submissions for
    /// the map are under way or wait for next(): the pixels are those of the next call, and nothing
    /// is lost. `view` is one of the frame's maps; only the pixels that it serves are asked.
    bool submit(const Renderer& frame, const DemandRule& rule, PassClock* clock = nullptr,
                std::size_t view = 0);

    /// Every submission for a map comes back once, in the order in which they were made; absent
    /// where the GPU has not finished the next one, or there is none. Never waits.
    std::optional<Counters> next(std::size_t view = 0);

    /// Of the submissions so far: next() returns none of them any more. After a camera cut.
    void forget();

  private:
    PixelDemandPrograms makePrograms(const ShaderLibrary& shaders) const;

    std::string demandGlsl_;
    PixelDemandPrograms programs_;
    std::vector<std::unique_ptr<CounterRing>> rings_;  // one for each map
};

/// Of a pass that asks one pixel of every cell in which a map may serve one, in groups of 16 x 8
/// cells.
struct SparsePixels {
    glm::ivec3 cell{0};  ///< x, y of the pixel in the first cell, z the cells' edge
    GLuint groupsX = 0, groupsY = 0;
};
/// Calls with turn = 0, 1, 2, ... ask every pixel of a cell in turn.
SparsePixels sparsePixels(const Renderer& frame, std::size_t view, std::uint64_t turn);

}  // namespace renderer

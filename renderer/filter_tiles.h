// SPDX-License-Identifier: MIT
// Which tiles of a filtered map visible surfaces look up, so that the prefilter leaves the others
// out: what the camera does not see, what is turned away from the light, and what another map
// serves has no penumbra to filter. Found on the GPU, from the prepass, and used there by indirect
// dispatch: nothing waits.
//
// Whether a receiver that is looked up lies in a penumbra is not known before its lookup; a tile
// may be filtered that turns out to be all light.
#pragma once

#include <array>
#include <vector>

#include "renderer/gl_object.h"
#include "renderer/served_pixels.h"
#include "renderer/shader_library.h"
#include "renderer/shader_math.h"

namespace renderer {

inline constexpr int kTile = 16;  ///< texels along a tile's edge
/// What a program needs that includes passes/tiles.glsl.
std::vector<ShaderDefine> tileDefines();

/// What may look a map up.
struct VisibleSurfaces {
    GLuint positions = 0;  ///< as Renderer::Outputs
    PixelRect pixels;
};

class FilterTiles {
  public:
    /// The passes of a prefilter in their order. One needs what the next one's kernel reads.
    enum class Pass { texels = 0, rows = 1, columns = 2 };
    static constexpr std::size_t kPasses = 3;

    explicit FilterTiles(const ShaderLibrary& shaders) : shaders_(shaders) {}

    /// Compiles what find() needs; throws std::runtime_error where it does not compile.
    void prepare();

    /// Whether less is left out than finding it costs, by the sizes alone, or a list of tiles may
    /// be longer than a driver takes. `spreadTexels`: between a receiver's place on the map and the
    /// lookups around it.
    static bool costsMoreThanItSaves(const f32::ShadowConstants& shadow, int layers,
                                     const PixelRect& pixels, float spreadTexels);

    /// For the map whose constants are bound, where that does not hold.
    void find(const f32::ShadowConstants& shadow, int layers, const VisibleSurfaces& seen,
              float spreadTexels);
    /// From now on all tiles.
    void forget() { found_ = false; }
    /// Whether the passes have lists; then their programs are those with LISTED.
    bool found() const { return found_; }

    /// A group for every tile of the pass in every layer, once they are found; the program in use
    /// includes passes/tiles.glsl.
    void dispatch(Pass pass) const;

    /// Share of the tiles that the last pass did. Waits for the GPU.
    double readShare() const;

  private:
    void reserve(int tilesEdge);

    ShaderLibrary shaders_;
    Program marksProgram_, listsProgram_;
    Buffer marks_, lists_;
    int reservedEdge_ = 0;
    int tilesEdge_ = 0;
    bool found_ = false;
};

}  // namespace renderer

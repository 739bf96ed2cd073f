// SPDX-License-Identifier: MIT
// Which tiles of a filtered map the prefilter does. It leaves out those that no visible surface
// looks up (the camera does not see it, it is turned away from the light, another map serves it),
// and those in which nothing can lie in a penumbra: the kernel meets one surface there, or several
// of which none ends before another. Such a tile holds what its texels store, unfiltered. Found on
// the GPU, from the prepass and from the depths, and used there by indirect dispatch: nothing
// waits.
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

/// What is left out of a map.
struct LeftOut {
    const VisibleSurfaces* seen = nullptr;  ///< what these do not look up; null: nothing of that
    bool outsidePenumbrae = false;          ///< where nothing can lie in one
};

class FilterTiles {
  public:
    /// The passes of a prefilter in their order. One needs what the next one's kernel reads.
    enum class Pass { texels = 0, rows = 1, columns = 2 };
    static constexpr std::size_t kPasses = 3;

    explicit FilterTiles(const ShaderLibrary& shaders) : shaders_(shaders) {}

    /// Compiles what start() needs; throws std::runtime_error where it does not compile.
    void prepare();

    /// For the map whose constants are bound: finds what is seen. What of `leave` costs more than
    /// it saves, by the sizes alone, is not left out. `spreadTexels`: between a receiver's place on
    /// the map and the lookups around it.
    void start(const f32::ShadowConstants& shadow, int layers, LeftOut leave, float spreadTexels);
    /// From now on all tiles.
    void forget();

    /// Whether the pass over texels has a list; then its program is that with LISTED.
    bool listsTexels() const { return listsTexels_; }
    /// Where the pass over texels marks gaps, or that it marks none, for the program with
    /// MARKS_GAPS that is in use.
    void bindGaps() const;

    /// Once the texels are done: `rows` and `columns` are the groups, in x and y, of passes that do
    /// the whole map.
    void listLines(std::array<GLuint, 2> rows, std::array<GLuint, 2> columns);
    /// Whether the passes along lines have lists. Each is then called twice, by dispatch() with
    /// the program with LISTED and by dispatchWhole() with the other: the GPU knows which is
    /// faster, and one of them does nothing.
    bool listsLines() const { return listsTexels_ || marksGaps_; }

    /// A group for every tile of the pass in every layer; the program in use includes
    /// passes/tiles.glsl.
    void dispatch(Pass pass) const;
    void dispatchWhole(Pass pass) const;

    /// Share of the tiles that the last pass did. Waits for the GPU.
    double readShare() const;

  private:
    void reserve(int tilesEdge);
    void list(Pass first, Pass last) const;

    ShaderLibrary shaders_;
    Program marksProgram_, listsProgram_, choiceProgram_;
    Buffer seen_, gaps_, lists_;
    int reservedEdge_ = 0;
    int tilesEdge_ = 0, reachTexels_ = 0, layers_ = 0;
    bool listsTexels_ = false, marksGaps_ = false;
};

}  // namespace renderer

// SPDX-License-Identifier: MIT
#include "renderer/filter_tiles.h"

namespace renderer {
namespace {

/// Tiles to a row of groups: along one axis alone a driver need not start as many groups as a large
/// map has tiles.
constexpr GLuint kTilesAcross = 16;

/// That every driver starts.
constexpr std::size_t kMostRows = 65535;

/// As DispatchIndirectCommand, with the number of tiles, which fill the last row in part.
struct Command {
    GLuint groupsX = kTilesAcross, groupsY = 0, groupsZ = 1, tiles = 0;
};

int parts(int whole, int size) {
    return (whole + size - 1) / size;
}

std::size_t area(int edge) {
    return static_cast<std::size_t>(edge) * static_cast<std::size_t>(edge);
}

/// What a bilinear lookup reads lies up to one and a half texels away; and what rounding moves it
/// by.
float lookupReach(float spreadTexels) {
    return spreadTexels + 2;
}

}  // namespace

std::vector<ShaderDefine> tileDefines() {
    return {{"TILE", std::to_string(kTile)}, {"TILES_ACROSS", std::to_string(kTilesAcross) + "u"}};
}

void FilterTiles::prepare() {
    if (listsProgram_.name() != 0) return;
    const ShaderOptions options{.defines = tileDefines(), .substitutions = {}};
    Program marks = makeComputeProgram(shaders_, "passes/tile_marks.comp", options);
    listsProgram_ = makeComputeProgram(shaders_, "passes/tile_lists.comp", options);
    marksProgram_ = std::move(marks);
}

bool FilterTiles::costsMoreThanItSaves(const f32::ShadowConstants& shadow, int layers,
                                       const PixelRect& pixels, float spreadTexels) {
    if (2 * lookupReach(spreadTexels) + 1 > kTile) return true;
    if (area(parts(filteredEdge(shadow), kTile)) > kMostRows * kTilesAcross) return true;
    // A kernel that reaches farther needs nearly everything around what is seen, and the search of
    // its surroundings takes as long.
    constexpr int kMostReach = 4;
    if (kernelTaps(shadow) > kMostReach * kTile) return true;
    // On a software rasteriser a pixel costs a quarter of a texel's passes, and in most scenes a
    // third of the texels is not seen.
    constexpr double kTexelsPerPixel = 1.5;
    const double texels = static_cast<double>(area(filteredEdge(shadow))) * layers;
    return texels < kTexelsPerPixel * pixels.width * pixels.height;
}

void FilterTiles::reserve(int tilesEdge) {
    if (tilesEdge <= reservedEdge_) return;
    const std::size_t tiles = area(tilesEdge);
    marks_ = makeBuffer(nullptr, static_cast<GLsizeiptr>(tiles * sizeof(GLuint)),
                        GL_DYNAMIC_STORAGE_BIT, "marked tiles");
    lists_ = makeBuffer(
        nullptr, static_cast<GLsizeiptr>(kPasses * (sizeof(Command) + tiles * sizeof(GLuint))),
        GL_DYNAMIC_STORAGE_BIT, "lists of tiles");
    reservedEdge_ = tilesEdge;
}

void FilterTiles::find(const f32::ShadowConstants& shadow, int layers, const VisibleSurfaces& seen,
                       float spreadTexels) {
    prepare();
    tilesEdge_ = parts(filteredEdge(shadow), kTile);
    reserve(tilesEdge_);
    found_ = true;
    glClearNamedBufferData(marks_.name(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr);
    std::array<Command, kPasses> commands;
    for (Command& command : commands) command.groupsZ = static_cast<GLuint>(layers);
    glNamedBufferSubData(lists_.name(), 0, sizeof commands, commands.data());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, marks_.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, lists_.name());
    glBindTextureUnit(0, seen.positions);
    glUseProgram(marksProgram_.name());
    glUniform4i(0, seen.pixels.x, seen.pixels.y, seen.pixels.width, seen.pixels.height);
    glUniform1i(1, tilesEdge_);
    glUniform1f(2, lookupReach(spreadTexels));
    glDispatchCompute(static_cast<GLuint>(parts(seen.pixels.width, 16)),
                      static_cast<GLuint>(parts(seen.pixels.height, 8)), 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    glUseProgram(listsProgram_.name());
    glUniform2i(0, tilesEdge_, parts(kernelTaps(shadow), kTile));
    glDispatchCompute(static_cast<GLuint>(parts(tilesEdge_ * tilesEdge_, 32)), 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT |
                    GL_BUFFER_UPDATE_BARRIER_BIT);
}

void FilterTiles::dispatch(Pass pass) const {
    const auto row = static_cast<int>(pass);
    glUniform2i(1, row, row * tilesEdge_ * tilesEdge_);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, lists_.name());
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, lists_.name());
    glDispatchComputeIndirect(static_cast<GLintptr>(row) * static_cast<GLintptr>(sizeof(Command)));
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
}

double FilterTiles::readShare() const {
    if (!found_) return 1;
    std::array<Command, kPasses> commands;
    glGetNamedBufferSubData(lists_.name(), 0, sizeof commands, commands.data());
    return commands.back().tiles / static_cast<double>(tilesEdge_ * tilesEdge_);
}

}  // namespace renderer

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

/// The lists', then those of whole rows and columns.
using Commands = std::array<Command, FilterTiles::kPasses + 2>;

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

/// A kernel that reaches farther needs nearly everything around a tile, and the search of its
/// surroundings takes as long.
constexpr int kMostReach = 4;

bool canBeListed(const f32::ShadowConstants& shadow) {
    return area(parts(filteredEdge(shadow), kTile)) <= kMostRows * kTilesAcross &&
           kernelTaps(shadow) <= kMostReach * kTile;
}

bool unseenIsWorthIt(const f32::ShadowConstants& shadow, int layers, const PixelRect& pixels,
                     float spreadTexels) {
    if (2 * lookupReach(spreadTexels) + 1 > kTile) return false;
    // On a software rasteriser a pixel costs a quarter of a texel's passes, and in most scenes a
    // third of the texels is not seen.
    constexpr double kTexelsPerPixel = 1.5;
    const double texels = static_cast<double>(area(filteredEdge(shadow))) * layers;
    return texels >= kTexelsPerPixel * pixels.width * pixels.height;
}

void fill(const Buffer& buffer, GLuint value) {
    glClearNamedBufferData(buffer.name(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &value);
}

GLintptr placeOf(std::size_t command) {
    return static_cast<GLintptr>(command * sizeof(Command));
}

void dispatchCommand(const Buffer& lists, std::size_t command) {
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, lists.name());
    glDispatchComputeIndirect(placeOf(command));
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
}

}  // namespace

std::vector<ShaderDefine> tileDefines() {
    return {{"TILE", std::to_string(kTile)}, {"TILES_ACROSS", std::to_string(kTilesAcross) + "u"}};
}

void FilterTiles::prepare() {
    if (listsProgram_.name() != 0) return;
    const ShaderOptions options{.defines = tileDefines(), .substitutions = {}};
    Program marks = makeComputeProgram(shaders_, "passes/tile_marks.comp", options);
    Program choice = makeComputeProgram(shaders_, "passes/tile_choice.comp", options);
    listsProgram_ = makeComputeProgram(shaders_, "passes/tile_lists.comp", options);
    marksProgram_ = std::move(marks);
    choiceProgram_ = std::move(choice);
}

void FilterTiles::reserve(int tilesEdge) {
    if (tilesEdge <= reservedEdge_) return;
    const std::size_t tiles = area(tilesEdge);
    const auto bytes = static_cast<GLsizeiptr>(tiles * sizeof(GLuint));
    seen_ = makeBuffer(nullptr, bytes, GL_DYNAMIC_STORAGE_BIT, "tiles that are seen");
    gaps_ = makeBuffer(nullptr, bytes, GL_DYNAMIC_STORAGE_BIT, "tiles with gaps");
    lists_ = makeBuffer(
        nullptr,
        static_cast<GLsizeiptr>(sizeof(Commands) + kPasses * tiles * sizeof(GLuint)),
        GL_DYNAMIC_STORAGE_BIT, "lists of tiles");
    reservedEdge_ = tilesEdge;
}

void FilterTiles::forget() {
    listsTexels_ = false;
    marksGaps_ = false;
}

void FilterTiles::start(const f32::ShadowConstants& shadow, int layers, LeftOut leave,
                        float spreadTexels) {
    prepare();
    const bool can = canBeListed(shadow);
    listsTexels_ = can && leave.seen != nullptr &&
                   unseenIsWorthIt(shadow, layers, leave.seen->pixels, spreadTexels);
    marksGaps_ = can && leave.outsidePenumbrae && kernelTaps(shadow) > 0;
    if (!listsLines()) return;
    tilesEdge_ = parts(filteredEdge(shadow), kTile);
    reachTexels_ = kernelTaps(shadow);
    layers_ = layers;
    reserve(tilesEdge_);
    fill(seen_, listsTexels_ ? 0 : 1);
    fill(gaps_, marksGaps_ ? 0 : 1);
    Commands commands;
    for (Command& command : commands) command.groupsZ = static_cast<GLuint>(layers);
    glNamedBufferSubData(lists_.name(), 0, sizeof commands, commands.data());
    if (!listsTexels_) return;
    const VisibleSurfaces& seen = *leave.seen;
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, seen_.name());
    glBindTextureUnit(0, seen.positions);
    glUseProgram(marksProgram_.name());
    glUniform4i(0, seen.pixels.x, seen.pixels.y, seen.pixels.width, seen.pixels.height);
    glUniform1i(1, tilesEdge_);
    glUniform1f(2, lookupReach(spreadTexels));
    glDispatchCompute(static_cast<GLuint>(parts(seen.pixels.width, 16)),
                      static_cast<GLuint>(parts(seen.pixels.height, 8)), 1);
    list(Pass::texels, Pass::texels);
}

void FilterTiles::bindGaps() const {
    if (marksGaps_) glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, gaps_.name());
    glUniform2i(3, marksGaps_ ? tilesEdge_ : 0, reachTexels_);
}

void FilterTiles::list(Pass first, Pass last) const {
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, seen_.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, lists_.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, gaps_.name());
    glUseProgram(listsProgram_.name());
    glUniform2i(0, tilesEdge_, parts(reachTexels_, kTile));
    glUniform2i(1, static_cast<int>(first), static_cast<int>(last));
    glDispatchCompute(static_cast<GLuint>(parts(tilesEdge_ * tilesEdge_, 32)), 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT |
                    GL_BUFFER_UPDATE_BARRIER_BIT);
}

void FilterTiles::listLines(std::array<GLuint, 2> rows, std::array<GLuint, 2> columns) {
    const auto layers = static_cast<GLuint>(layers_);
    const std::array whole{Command{rows[0], rows[1], layers, 0},
                           Command{columns[0], columns[1], layers, 0}};
    glNamedBufferSubData(lists_.name(), placeOf(kPasses), sizeof whole, whole.data());
    list(Pass::rows, Pass::columns);
    // On a software rasteriser a tile's texel takes half as long again as one of a whole line.
    constexpr double kWorthIt = 2.0 / 3;
    glUseProgram(choiceProgram_.name());
    glUniform1ui(0, static_cast<GLuint>(kWorthIt * static_cast<double>(area(tilesEdge_))));
    glDispatchCompute(1, 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT |
                    GL_BUFFER_UPDATE_BARRIER_BIT);
}

void FilterTiles::dispatch(Pass pass) const {
    const auto row = static_cast<int>(pass);
    glUniform2i(1, row, row * tilesEdge_ * tilesEdge_);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, lists_.name());
    dispatchCommand(lists_, static_cast<std::size_t>(pass));
}

void FilterTiles::dispatchWhole(Pass pass) const {
    dispatchCommand(lists_, static_cast<std::size_t>(pass) + 2);
}

double FilterTiles::readShare() const {
    if (!listsLines()) return 1;
    Commands commands;
    glGetNamedBufferSubData(lists_.name(), 0, sizeof commands, commands.data());
    if (commands.back().groupsY > 0) return 1;
    return commands[kPasses - 1].tiles / static_cast<double>(area(tilesEdge_));
}

}  // namespace renderer

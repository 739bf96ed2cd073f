// SPDX-License-Identifier: MIT
// The passes between depth pass and lookup, on the GPU, in compute shaders:
// from depths to what the technique stores, then the prefilter: along rows and
// along columns, or level by level. cpuMap() does the same on the CPU.
#pragma once

#include <array>
#include <map>
#include <tuple>
#include <vector>

#include "renderer/filter_tiles.h"
#include "renderer/gl_object.h"
#include "renderer/image.h"
#include "renderer/shader_library.h"
#include "renderer/shader_math.h"
#include "renderer/technique.h"

namespace renderer {

/// A filtered map, guard band included, its layers or mip levels one after the
/// other: 4 channels, of which the format has some. Of a summed map, sums.
struct FilteredTexels {
    int edge = 0;
    std::vector<glm::vec4> texels;
    std::vector<glm::uvec4> sums;
};

class MapFilter {
  public:
    explicit MapFilter(const ShaderLibrary& shaders);

    /// Compiles the technique's passes if they have not been; throws std::runtime_error where they
    /// do not compile.
    void prepare(const Technique& technique);
    /// What another one has compiled; throws alike.
    void prepareAs(const MapFilter& other);

    /// Filters the N x N depths in the corner of `depths`, which has several samples where the
    /// technique's parameters say so. `shadow` has to be bound as the shadow
    /// block. `spareN`: textures are at least as large as for that N, so that smaller maps need no
    /// new ones; nor does a map of fewer layers, where the technique has layers. A separable kernel
    /// leaves out what `leave` says; of a map with several samples no penumbrae are found. Throws
    /// std::runtime_error where the driver has no room.
    void run(const Technique& technique, const ParameterValues& parameters,
             const f32::ShadowConstants& shadow, const Texture& depths, int spareN,
             LeftOut leave = {});

    GLuint map() const { return textures_[0].name(); }
    FilteredTexels read() const;  ///< the last map
    std::size_t bytes() const;    ///< of all textures
    void release();               ///< gives the textures back
    /// Share of the last map's tiles that were filtered. Waits for the GPU.
    double readShare() const { return tiles_.readShare(); }

  private:
    /// For depths of one or of several samples. This one and the next: for all tiles or for lists
    /// of them.
    const Program& convertProgram(const Technique& technique, bool sampled, bool listed);
    const Program& lineProgram(const Technique& technique, GLuint strip, bool listed);
    void ensureTextures(const Technique& technique, int edge, int layers, bool keepLarger);
    void bind(GLuint source, std::size_t target, int targetLevel) const;
    /// Every layer, with the current program; `groups` along x and y.
    void dispatch(GLuint source, std::size_t target, int targetLevel, GLuint groupsX,
                  GLuint groupsY) const;
    /// The tiles that a pass has to do, where they were found.
    void dispatchTiles(GLuint source, std::size_t target, FilterTiles::Pass pass) const;
    /// One of the passes along lines, of groups in x and y where all of the map is done.
    void filterLine(const Technique& technique, GLuint strip, FilterTiles::Pass pass,
                    std::array<GLuint, 2> groups);
    void filterLines(const Technique& technique, const f32::ShadowConstants& shadow);
    void addMips(int levels);
    void sumUp();

    ShaderLibrary shaders_;
    // Made when used.
    std::map<std::tuple<const Technique*, bool, bool>, Program> convertPrograms_;
    /// By prefilter, whether texels are split, channels, strip, and whether tiles are listed.
    std::map<std::tuple<Prefilter, bool, int, GLuint, bool>, Program> linePrograms_;
    Program mipProgram_, sumsProgram_;
    FilterTiles tiles_;
    Prefilter prefilter_ = Prefilter::none;
    MapFormat format_ = MapFormat::depth32f;
    int textureEdge_ = 0;
    int layers_ = 1;
    int usedEdge_ = 0;
    int usedLayers_ = 1;
    int usedLevels_ = 1;
    std::array<Texture, 2> textures_;
};

}  // namespace renderer

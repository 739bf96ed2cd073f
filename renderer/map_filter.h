// SPDX-License-Identifier: MIT
// The passes between depth pass and lookup, on the GPU: from depths to what the technique stores,
// then the prefilter along rows and along columns. cpuMap() does the same on the CPU.
#pragma once

#include <array>
#include <vector>

#include "renderer/gl_object.h"
#include "renderer/image.h"
#include "renderer/shader_library.h"
#include "renderer/shader_math.h"
#include "renderer/technique.h"

namespace renderer {

class MapFilter {
  public:
    explicit MapFilter(const ShaderLibrary& shaders);

    /// Compiles the technique's passes if they have not been; throws std::runtime_error where they
    /// do not compile.
    void prepare(const Technique& technique);

    /// Filters the N x N depths in the corner of `depths`. `shadow` has to be bound as the shadow
    /// block. `spareN`: textures are at least as large as for that N, so that smaller maps need no
    /// new ones. Throws std::runtime_error where the driver has no room.
    void run(const Technique& technique, const ParameterValues& parameters,
             const f32::ShadowConstants& shadow, const Texture& depths, int spareN);

    GLuint map() const { return textures_[0].name(); }
    /// The last map, guard band included, its layers one below the other: 4 channels, of which the
    /// format has some.
    FloatImage read() const;
    std::size_t bytes() const;  ///< of both textures
    void release();             ///< gives the textures back

  private:
    void ensureTextures(MapFormat format, int edge, int layers, bool keepLarger);
    /// Every layer, with the current program.
    void draw(GLuint source, std::size_t target);

    ShaderLibrary shaders_;
    VertexArray noGeometry_;
    std::vector<Program> convertPrograms_;  // one per row of the technique table, made when used
    std::vector<Program> linePrograms_;     // one per Prefilter
    MapFormat format_ = MapFormat::depth32f;
    int textureEdge_ = 0;
    int layers_ = 1;
    int usedEdge_ = 0;
    std::array<Texture, 2> textures_;
    std::array<std::vector<Framebuffer>, 2> targets_;  // one per layer
};

}  // namespace renderer

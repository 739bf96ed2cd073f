// SPDX-License-Identifier: MIT
#include "renderer/map_filter.h"

#include <cmath>

namespace renderer {
namespace {

GLenum glFormat(MapFormat format) {
    switch (format) {
        case MapFormat::depth32f:
            return GL_DEPTH_COMPONENT32F;
        case MapFormat::r32f:
            return GL_R32F;
        case MapFormat::rg32f:
            return GL_RG32F;
        case MapFormat::rgba32f:
            return GL_RGBA32F;
        case MapFormat::rg16f:
            return GL_RG16F;
        case MapFormat::rgba16f:
        case MapFormat::rg16fSplit:
            return GL_RGBA16F;
        case MapFormat::rgba16:
            return GL_RGBA16;
    }
    return GL_NONE;
}

constexpr std::size_t kPrefilters = 4;

}  // namespace

MapFilter::MapFilter(const ShaderLibrary& shaders)
    : shaders_(shaders), convertPrograms_(techniques().size()), linePrograms_(kPrefilters) {
    GLuint name = 0;
    glCreateVertexArrays(1, &name);
    noGeometry_ = VertexArray(name);
}

void MapFilter::prepare(const Technique& technique) {
    if (technique.prefilter == Prefilter::none) return;
    Program& convert =
        convertPrograms_.at(static_cast<std::size_t>(&technique - techniques().data()));
    if (convert.name() == 0)
        convert = makeProgram(shaders_, "passes/fullscreen.vert", "passes/map_texel.frag",
                              techniqueOptions(technique));
    if (technique.prefilter == Prefilter::converted) return;
    Program& line = linePrograms_.at(static_cast<std::size_t>(technique.prefilter));
    if (line.name() == 0)
        line = makeProgram(
            shaders_, "passes/fullscreen.vert", "passes/map_line.frag",
            {.defines = {{"PREFILTER", std::to_string(static_cast<int>(technique.prefilter))}},
             .substitutions = {}});
}

void MapFilter::ensureTextures(MapFormat format, int edge, int layers, bool keepLarger) {
    const bool fits = keepLarger ? textureEdge_ >= edge : textureEdge_ == edge;
    if (fits && format == format_ && layers == layers_) return;
    release();  // two sets at once may be more than there is room for
    for (std::size_t i = 0; i < textures_.size(); ++i) {
        const std::string label = i == 0 ? "filtered map" : "filtered rows";
        textures_[i] = makeTextureArray(glFormat(format), edge, layers, label);
        for (int layer = 0; layer < layers; ++layer)
            targets_[i].push_back(makeLayerFramebuffer(textures_[i].name(), layer, label));
    }
    format_ = format;
    textureEdge_ = edge;
    layers_ = layers;
}

void MapFilter::release() {
    targets_ = {};
    textures_ = {};
    textureEdge_ = 0;
    usedEdge_ = 0;
}

std::size_t MapFilter::bytes() const {
    return textures_.size() * static_cast<std::size_t>(layers_) *
           static_cast<std::size_t>(textureEdge_) * static_cast<std::size_t>(textureEdge_) *
           static_cast<std::size_t>(bytesPerTexel(format_));
}

void MapFilter::draw(GLuint source, std::size_t target) {
    glViewport(0, 0, usedEdge_, usedEdge_);
    glBindTextureUnit(0, source);
    glBindVertexArray(noGeometry_.name());
    for (std::size_t layer = 0; layer < targets_[target].size(); ++layer) {
        glBindFramebuffer(GL_FRAMEBUFFER, targets_[target][layer].name());
        glUniform1i(0, static_cast<GLint>(layer));
        glDrawArrays(GL_TRIANGLES, 0, 3);
    }
}

void MapFilter::run(const Technique& technique, const ParameterValues& parameters,
                    const f32::ShadowConstants& shadow, const Texture& depths, int spareN) {
    prepare(technique);
    usedEdge_ = 0;
    const int edge = filteredEdge(shadow);
    const int spare = std::max(spareN - static_cast<int>(shadow.map.x), 0);
    ensureTextures(technique.format, edge + spare, technique.mapLayers(parameters), spareN > 0);
    usedEdge_ = edge;
    glUseProgram(
        convertPrograms_.at(static_cast<std::size_t>(&technique - techniques().data())).name());
    draw(depths.name(), 0);
    if (kernelTaps(shadow) == 0) return;
    glUseProgram(linePrograms_.at(static_cast<std::size_t>(technique.prefilter)).name());
    glUniform2i(1, 1, 0);
    draw(textures_[0].name(), 1);
    glUniform2i(1, 0, 1);
    draw(textures_[1].name(), 0);
}

FloatImage MapFilter::read() const {
    FloatImage image(usedEdge_, usedEdge_ * layers_, 4);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureSubImage(textures_[0].name(), 0, 0, 0, 0, usedEdge_, usedEdge_, layers_, GL_RGBA,
                         GL_FLOAT, static_cast<GLsizei>(image.values.size() * sizeof(float)),
                         image.values.data());
    return image;
}

}  // namespace renderer

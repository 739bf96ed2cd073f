// SPDX-License-Identifier: MIT
// Renderer's read-backs. All of them wait for the GPU.
#include <algorithm>
#include <stdexcept>

#include "renderer/renderer.h"

namespace renderer {
namespace {

/// GL's first row is the lowest; a picture's is the highest.
template <class T>
void flipRows(Image<T>& image) {
    const std::size_t row =
        static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.channels);
    for (int y = 0; y < image.height / 2; ++y)
        std::swap_ranges(
            image.values.begin() + static_cast<std::ptrdiff_t>(image.index(0, y)),
            image.values.begin() + static_cast<std::ptrdiff_t>(image.index(0, y) + row),
            image.values.begin() +
                static_cast<std::ptrdiff_t>(image.index(0, image.height - 1 - y)));
}

FloatImage readFloats(const Texture& texture, GLenum format, int width, int height, int channels) {
    FloatImage image(width, height, channels);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureSubImage(texture.name(), 0, 0, 0, 0, width, height, 1, format, GL_FLOAT,
                         static_cast<GLsizei>(image.values.size() * sizeof(float)),
                         image.values.data());
    return image;
}

/// Order in which the pixels of a cell are taken: steps that are coprime to the cell visit every
/// pixel of it.
glm::ivec2 pixelOfCell(int spacing, unsigned phase) {
    const auto cell = static_cast<unsigned>(spacing * spacing);
    unsigned step = cell / 2 + 1;
    const auto coprime = [&](unsigned a) {
        unsigned b = cell;
        while (b != 0) std::swap(a %= b, b);
        return a == 1;
    };
    while (!coprime(step)) ++step;
    const unsigned pixel = phase % cell * step % cell;
    return {static_cast<int>(pixel) % spacing, static_cast<int>(pixel) / spacing};
}

}  // namespace

std::vector<float> Renderer::footprintsUv(int spacing, unsigned phase, PassClock* clock) {
    if (spacing < 1 || spacing > 64)
        throw std::invalid_argument("footprint spacing is " + std::to_string(spacing) +
                                    " px, must be in [1, 64]");
    if (!hasFrame_) return {};
    const int width = std::max(widthPx_ / spacing, 1);
    const int height = std::max(heightPx_ / spacing, 1);
    if (width != footprintWidth_ || height != footprintHeight_) {
        footprints_ = makeTexture(GL_R32F, width, height, "footprints");
        footprintTarget_ = makeFramebuffer({footprints_.name()}, 0, "footprints");
        footprintWidth_ = width;
        footprintHeight_ = height;
    }
    if (clock != nullptr) clock->begin(Pass::footprint);
    const glm::ivec2 pixel = pixelOfCell(spacing, phase);
    glBindFramebuffer(GL_FRAMEBUFFER, footprintTarget_.name());
    glViewport(0, 0, width, height);
    glBindTextureUnit(0, positions_.name());
    glBindTextureUnit(1, planes_.name());
    glBindTextureUnit(2, visibility_.name());
    glUseProgram(footprintProgram_.name());
    glUniform1ui(1, lastFrameSoft_ ? 1 : 0);
    glUniform3i(0, std::min(pixel.x, widthPx_ - 1), std::min(pixel.y, heightPx_ - 1), spacing);
    glBindVertexArray(noGeometry_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    std::vector<float> values = readFloats(footprints_, GL_RED, width, height, 1).values;
    if (clock != nullptr) clock->end(Pass::footprint);
    return values;
}

ByteImage Renderer::readLit() {
    ByteImage image(widthPx_, heightPx_, 3);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureSubImage(lit_.name(), 0, 0, 0, 0, widthPx_, heightPx_, 1, GL_RGB, GL_UNSIGNED_BYTE,
                         static_cast<GLsizei>(image.values.size()), image.values.data());
    flipRows(image);
    return image;
}

FloatImage Renderer::readVisibility() {
    FloatImage image = readFloats(visibility_, GL_RED, widthPx_, heightPx_, 1);
    flipRows(image);
    return image;
}

FloatImage Renderer::readShadowMap() {
    const int edge = static_cast<int>(shadow_.map.x);
    return readFloats(map_, GL_DEPTH_COMPONENT, edge, edge, 1);
}

FloatImage Renderer::readPositions() {
    FloatImage image = readFloats(positions_, GL_RGBA, widthPx_, heightPx_, 4);
    flipRows(image);
    return image;
}

FloatImage Renderer::readPlanes() {
    FloatImage image = readFloats(planes_, GL_RGBA, widthPx_, heightPx_, 4);
    flipRows(image);
    return image;
}

}  // namespace renderer

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

}  // namespace

ByteImage readColours(const Texture& texture, int width, int height) {
    ByteImage image(width, height, 3);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureSubImage(texture.name(), 0, 0, 0, 0, width, height, 1, GL_RGB, GL_UNSIGNED_BYTE,
                         static_cast<GLsizei>(image.values.size()), image.values.data());
    flipRows(image);
    return image;
}

ByteImage readWindow(int width, int height) {
    ByteImage image(width, height, 3);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
    glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, image.values.data());
    flipRows(image);
    return image;
}

ByteImage Renderer::readLit() {
    return readColours(lit_, widthPx_, heightPx_);
}

FloatImage Renderer::readVisibility(std::size_t light) {
    FloatImage image = readFloats(visibilities_.at(light), GL_RED, widthPx_, heightPx_, 1);
    flipRows(image);
    return image;
}

FloatImage Renderer::readShadowMap(std::size_t view) {
    const int edge = static_cast<int>(shadows_.at(view).map.x);
    return readFloats(maps_[view].depths, GL_DEPTH_COMPONENT, edge, edge, 1);
}

FilteredTexels Renderer::readFilteredMap(std::size_t view) {
    if (lastTechnique_ == nullptr || lastTechnique_->prefilter == Prefilter::none ||
        served_.at(view).empty())
        return {};
    bindConstants(view);
    filterMap(*lastTechnique_, view, {});
    return mapFilter_.read();
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

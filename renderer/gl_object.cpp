// SPDX-License-Identifier: MIT
#include "renderer/gl_object.h"

#include <initializer_list>
#include <stdexcept>
#include <string>
#include <vector>

namespace renderer {
namespace {

void setLabel(GLenum kind, GLuint name, std::string_view label) {
    glObjectLabel(kind, name, static_cast<GLsizei>(label.size()), label.data());
}

void forgetEarlierErrors() {
    while (glGetError() != GL_NO_ERROR) {
    }
}

void checkComplete(GLuint framebuffer, std::string_view label) {
    const GLenum status = glCheckNamedFramebufferStatus(framebuffer, GL_DRAW_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE)
        throw std::runtime_error("framebuffer \"" + std::string(label) +
                                 "\": the driver calls it incomplete (status " +
                                 std::to_string(status) + ")");
}

void setNearestClamped(GLuint texture, int levels) {
    glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER,
                        levels > 1 ? GL_NEAREST_MIPMAP_NEAREST : GL_NEAREST);
    glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTextureParameteri(texture, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(texture, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

void throwIfRefused(std::string_view label, int width, int height) {
    if (const GLenum error = glGetError(); error != GL_NO_ERROR)
        throw std::runtime_error(
            "texture \"" + std::string(label) + "\" of " + std::to_string(width) + " x " +
            std::to_string(height) + " texels: the driver refuses it (GL error " +
            std::to_string(error) + (error == GL_OUT_OF_MEMORY ? ", out of memory)" : ")"));
}

Texture makeStorage(GLenum target, GLenum internalFormat, int width, int height, int layers,
                    int levels, std::string_view label) {
    GLuint name = 0;
    glCreateTextures(target, 1, &name);
    Texture texture(name);
    forgetEarlierErrors();
    if (target == GL_TEXTURE_2D_ARRAY)
        glTextureStorage3D(name, levels, internalFormat, width, height, layers);
    else
        glTextureStorage2D(name, levels, internalFormat, width, height);
    throwIfRefused(label, width, height);
    setNearestClamped(name, levels);
    setLabel(GL_TEXTURE, name, label);
    return texture;
}

}  // namespace

Texture makeTexture(GLenum internalFormat, int width, int height, std::string_view label) {
    return makeStorage(GL_TEXTURE_2D, internalFormat, width, height, 1, 1, label);
}

Texture makeSampledTexture(GLenum internalFormat, int edge, int samples, std::string_view label) {
    GLuint name = 0;
    glCreateTextures(GL_TEXTURE_2D_MULTISAMPLE, 1, &name);
    Texture texture(name);
    forgetEarlierErrors();
    glTextureStorage2DMultisample(name, samples, internalFormat, edge, edge, GL_TRUE);
    throwIfRefused(std::to_string(samples) + " samples of " + std::string(label), edge, edge);
    setLabel(GL_TEXTURE, name, label);
    return texture;
}

Texture makeTextureArray(GLenum internalFormat, int width, int height, int layers, int levels,
                         std::string_view label) {
    return makeStorage(GL_TEXTURE_2D_ARRAY, internalFormat, width, height, layers, levels, label);
}

Texture makeLayerView(GLenum internalFormat, const Texture& array, int layer,
                      std::string_view label) {
    GLuint name = 0;
    glGenTextures(1, &name);  // a view needs a name that was never bound or created
    Texture texture(name);
    glTextureView(name, GL_TEXTURE_2D, array.name(), internalFormat, 0, 1,
                  static_cast<GLuint>(layer), 1);
    setNearestClamped(name, 1);
    setLabel(GL_TEXTURE, name, label);
    return texture;
}

Framebuffer makeFramebuffer(std::initializer_list<GLuint> colours, GLuint depth,
                            std::string_view label) {
    GLuint name = 0;
    glCreateFramebuffers(1, &name);
    Framebuffer framebuffer(name);
    std::vector<GLenum> drawBuffers;
    for (const GLuint colour : colours) {
        const GLenum attachment = GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(drawBuffers.size());
        glNamedFramebufferTexture(name, attachment, colour, 0);
        drawBuffers.push_back(attachment);
    }
    if (depth != 0) glNamedFramebufferTexture(name, GL_DEPTH_ATTACHMENT, depth, 0);
    if (drawBuffers.empty()) {
        glNamedFramebufferDrawBuffer(name, GL_NONE);
        glNamedFramebufferReadBuffer(name, GL_NONE);
    } else {
        glNamedFramebufferDrawBuffers(name, static_cast<GLsizei>(drawBuffers.size()),
                                      drawBuffers.data());
    }
    checkComplete(name, label);
    setLabel(GL_FRAMEBUFFER, name, label);
    return framebuffer;
}

Framebuffer makeLayerFramebuffer(GLuint array, int layer, std::string_view label) {
    GLuint name = 0;
    glCreateFramebuffers(1, &name);
    Framebuffer framebuffer(name);
    glNamedFramebufferTextureLayer(name, GL_COLOR_ATTACHMENT0, array, 0, layer);
    checkComplete(name, label);
    setLabel(GL_FRAMEBUFFER, name, label);
    return framebuffer;
}

Buffer makeBuffer(const void* data, GLsizeiptr bytes, GLbitfield flags, std::string_view label) {
    GLuint name = 0;
    glCreateBuffers(1, &name);
    Buffer buffer(name);
    forgetEarlierErrors();
    glNamedBufferStorage(name, bytes, data, flags);
    if (const GLenum error = glGetError(); error != GL_NO_ERROR)
        throw std::runtime_error(
            "buffer \"" + std::string(label) + "\" of " + std::to_string(bytes) +
            " bytes: the driver refuses it (GL error " + std::to_string(error) + ")");
    setLabel(GL_BUFFER, name, label);
    return buffer;
}

}  // namespace renderer

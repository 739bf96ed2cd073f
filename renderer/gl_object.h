// SPDX-License-Identifier: MIT
// Ownership of GL objects: a handle that deletes what it names. Needs a current context when it is
// destroyed.
#pragma once

#include <epoxy/gl.h>

#include <string_view>
#include <utility>

namespace renderer {

template <class Deleter>
class GlHandle {
  public:
    GlHandle() = default;
    explicit GlHandle(GLuint name) : name_(name) {}
    GlHandle(GlHandle&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
    GlHandle& operator=(GlHandle&& other) noexcept {
        if (this != &other) {
            release();
            name_ = std::exchange(other.name_, 0);
        }
        return *this;
    }
    ~GlHandle() { release(); }

    GLuint name() const { return name_; }

  private:
    void release() {
        if (name_ != 0) Deleter{}(name_);
        name_ = 0;
    }
    GLuint name_ = 0;
};

struct DeleteTexture {
    void operator()(GLuint name) const { glDeleteTextures(1, &name); }
};
struct DeleteBuffer {
    void operator()(GLuint name) const { glDeleteBuffers(1, &name); }
};
struct DeleteFramebuffer {
    void operator()(GLuint name) const { glDeleteFramebuffers(1, &name); }
};
struct DeleteVertexArray {
    void operator()(GLuint name) const { glDeleteVertexArrays(1, &name); }
};
struct DeleteShader {
    void operator()(GLuint name) const { glDeleteShader(name); }
};
struct DeleteProgram {
    void operator()(GLuint name) const { glDeleteProgram(name); }
};
struct DeleteQuery {
    void operator()(GLuint name) const { glDeleteQueries(1, &name); }
};

using Texture = GlHandle<DeleteTexture>;
using Buffer = GlHandle<DeleteBuffer>;
using Framebuffer = GlHandle<DeleteFramebuffer>;
using VertexArray = GlHandle<DeleteVertexArray>;
using Shader = GlHandle<DeleteShader>;
using Program = GlHandle<DeleteProgram>;
using Query = GlHandle<DeleteQuery>;

/// A two-dimensional texture with one mip level, nearest filtering, clamped to its edge. `label`
/// shows in GL debuggers. Throws std::runtime_error where the driver has no room for it.
Texture makeTexture(GLenum internalFormat, int width, int height, std::string_view label);

/// With several samples of a texel, at least as many as asked for, of a depth format.
Texture makeSampledTexture(GLenum internalFormat, int edge, int samples, std::string_view label);

/// As makeTexture(), as a stack of layers, with mip levels for texelFetch.
Texture makeTextureArray(GLenum internalFormat, int width, int height, int layers, int levels,
                         std::string_view label);

/// One layer of an array without mip levels, seen as a texture of its own.
Texture makeLayerView(GLenum internalFormat, const Texture& array, int layer,
                      std::string_view label);

/// Colour attachments in order; `depth` may be 0. Throws std::runtime_error when GL calls it
/// incomplete.
Framebuffer makeFramebuffer(std::initializer_list<GLuint> colours, GLuint depth,
                            std::string_view label);

/// One layer of an array as the only colour attachment.
Framebuffer makeLayerFramebuffer(GLuint array, int layer, std::string_view label);

Buffer makeBuffer(const void* data, GLsizeiptr bytes, GLbitfield flags, std::string_view label);

}  // namespace renderer

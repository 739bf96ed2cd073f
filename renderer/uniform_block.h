// SPDX-License-Identifier: MIT
// The buffer of a uniform block that C++ fills anew in every frame.
#pragma once

#include <string_view>

#include "renderer/gl_object.h"

namespace renderer {

template <class Block>
Buffer makeUniformBlock(const Block& block, std::string_view label) {
    return makeBuffer(&block, sizeof block, GL_DYNAMIC_STORAGE_BIT, label);
}

template <class Block>
void fillUniformBlock(const Buffer& buffer, const Block& block) {
    glNamedBufferSubData(buffer.name(), 0, sizeof block, &block);
}

}  // namespace renderer

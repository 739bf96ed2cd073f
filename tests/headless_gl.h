// SPDX-License-Identifier: MIT
// The one headless context of a test program, made when first asked for and current ever after. No
// context is a failure, not a skip: this project runs on a software GL.
#pragma once

#include "renderer/gl_context.h"

namespace tests {

inline const renderer::GlInfo& gl() {
    static const renderer::HeadlessContext context;
    return context.info();
}

}  // namespace tests

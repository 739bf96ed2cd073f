// SPDX-License-Identifier: MIT
// Counts the casters' depths of a map on the GPU, for whoever places layers by them
// (layer_placement.h). What is known is that of the last map that the GPU has finished: a moving
// light is followed one frame later, and no frame waits but the first.
#pragma once

#include <optional>

#include "renderer/gl_object.h"
#include "renderer/layer_placement.h"
#include "renderer/shader_library.h"

namespace renderer {

class DepthCounter {
  public:
    DepthCounter() = default;
    ~DepthCounter();
    DepthCounter(const DepthCounter&) = delete;
    DepthCounter& operator=(const DepthCounter&) = delete;

    /// Compiles its shader, if it has not been. Throws std::runtime_error where that fails.
    void prepare(const ShaderLibrary& shaders);

    /// Counts the N x N depths in the corner of `map`; returns the newest count there is. Throws as
    /// prepare() would.
    const DepthHistogram& count(const ShaderLibrary& shaders, const Texture& map, int resolution);

    /// Takes its shader from here, if it has been compiled; throws as count() does, and then it
    /// keeps the one it has.
    void reload(const ShaderLibrary& shaders);

    /// The next map has nothing to do with the last one: wait for it.
    void forget();

  private:
    void submit(const Texture& map, int resolution);
    /// Takes the count under way where it is finished, or waits for it.
    void take(bool wait);

    Program program_;
    Buffer counters_;
    const std::uint32_t* mapped_ = nullptr;
    GLsync underWay_ = nullptr;
    std::optional<DepthHistogram> newest_;
};

}  // namespace renderer

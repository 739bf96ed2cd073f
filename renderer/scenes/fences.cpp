// SPDX-License-Identifier: MIT
#include "renderer/scenes/fences.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace renderer {
namespace {

/// From a fence along x at the origin to its place.
glm::mat4 standing(glm::vec3 from, glm::vec3 span) {
    return glm::rotate(glm::translate(glm::mat4(1), from), std::atan2(-span.z, span.x), {0, 1, 0});
}

/// A straight bar between two points of the plane z = 0.
Mesh bar(glm::vec2 from, glm::vec2 to, float thickness) {
    const glm::vec2 span = to - from;
    const float half = thickness / 2;
    const glm::mat4 place = glm::rotate(glm::translate(glm::mat4(1), {from.x, from.y, 0}),
                                        std::atan2(span.y, span.x), {0, 0, 1});
    return transformed(box({0, -half, -half}, {glm::length(span), half, half}), place);
}

}  // namespace

Mesh picketFence(glm::vec3 from, glm::vec3 to, float height, float spacing) {
    Mesh mesh;
    const glm::vec3 span = to - from;
    const float length = glm::length(span);
    const int pickets = static_cast<int>(length / spacing);
    constexpr float kWidth = 0.075F;
    constexpr float kThickness = 0.022F;
    for (int i = 0; i <= pickets; ++i) {
        const float x = length * static_cast<float>(i) / static_cast<float>(pickets);
        mesh.append(box({x - kWidth / 2, 0.06F, -kThickness / 2},
                        {x + kWidth / 2, height, kThickness / 2}));
        // A pointed top: a square turned by 45 degrees, its upper half over the picket.
        const float half = kWidth / std::sqrt(8.0F);
        Mesh tip = box({-half, -half, -kThickness / 2}, {half, half, kThickness / 2});
        const glm::mat4 place = glm::rotate(glm::translate(glm::mat4(1), {x, height, 0}),
                                            glm::quarter_pi<float>(), {0, 0, 1});
        mesh.append(transformed(std::move(tip), place));
    }
    for (const float rail : {0.28F, 0.78F})
        mesh.append(box({-kWidth, rail * height, -0.05F},
                        {length + kWidth, rail * height + 0.07F, -kThickness / 2}));
    return transformed(std::move(mesh), standing(from, span));
}

Mesh wireFence(glm::vec3 from, glm::vec3 to, float height, float mesh, float thickness) {
    constexpr float kPost = 0.05F;
    constexpr float kClearance = 0.06F;  // under the wires
    const glm::vec3 span = to - from;
    const float length = glm::length(span);
    Mesh fence;
    for (const float x : {0.0F, length / 2, length})
        fence.append(box({x - kPost / 2, 0, -kPost / 2}, {x + kPost / 2, height, kPost / 2}));
    fence.append(box({0, height - kPost, -kPost / 2}, {length, height, kPost / 2}));
    // Lines x - y = k and x + y = k through the rectangle, cut at its edges.
    const float top = height - kPost;
    const float rise = top - kClearance;
    for (float k = -rise; k < length; k += mesh) {
        const float low = std::max(k, 0.0F);
        const float high = std::min(k + rise, length);
        if (high - low < thickness) continue;
        fence.append(bar({low, kClearance + low - k}, {high, kClearance + high - k}, thickness));
        fence.append(bar({low, top - (low - k)}, {high, top - (high - k)}, thickness));
    }
    return transformed(std::move(fence), standing(from, span));
}

}  // namespace renderer

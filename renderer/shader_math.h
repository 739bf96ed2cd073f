// SPDX-License-Identifier: MIT
// The shaders' mathematics, compiled as C++: the files below renderer/shaders/shared and
// renderer/shaders/filters exist once, in a subset of GLSL that is also C++, with a type `real`
// that is float on the GPU and float or double here. So every hard case can be tested on the CPU,
// and the GPU's image is held against the CPU on the same map.
//
//   namespace renderer::f32, renderer::f64: ViewConstants, ShadowConstants, ShadowReceiver,
//   shadowReceiver(), discCoverage4(), ... with the meaning given in the .glsl files.
//
// A file of this subset may use: real, real2..4, real4x4, int2, int3;
// SHARED_FUNCTION before each function; real(x) around every literal that meets
// a real; sampler2D with texelFetch and textureGather, sampler2DArray and
// usampler2DArray with texelFetch; the GLSL functions named below. It may not
// use swizzles of more than one component, out parameters, #include.
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>

namespace renderer {

/// A square map of one float per texel, row 0 at v = 0, as a sampler. Does not own the texels.
struct MapView {
    const float* texels = nullptr;
    int edge =
        0;  ///< texels from one row to the next, and the edge that texture coordinates refer to

    float at(int column, int row) const {
        return texels[static_cast<std::size_t>(row) * static_cast<std::size_t>(edge) +
                      static_cast<std::size_t>(column)];
    }
};

/// A stack of square layers of four values per texel, as a sampler. Does not
/// own the texels. A mip chain has one layer, and its levels lie one after the
/// other.
template <class Value>
struct LayeredMapView {
    const Value* texels = nullptr;
    int edge = 0;
};

template <class Value>
Value texelFetch(LayeredMapView<Value> map, const glm::ivec3& texel, int level) {
    const auto at = [](int i) { return static_cast<std::size_t>(i); };
    for (; level > 0; --level) {
        map.texels += at(map.edge) * at(map.edge);
        map.edge /= 2;
    }
    return map.texels[(at(texel.z) * at(map.edge) + at(texel.y)) * at(map.edge) + at(texel.x)];
}

/// One texel, all components alike.
inline glm::vec4 texelFetch(const MapView& map, const glm::ivec2& texel, int) {
    return glm::vec4(map.at(texel.x, texel.y));
}

/// The 2 x 2 texels around a coordinate in GLSL's order (0,1) (1,1) (1,0) (0,0), clamped to the
/// edge.
template <class Real>
glm::vec4 textureGather(const MapView& map, const glm::vec<2, Real>& coordinate) {
    const auto lower = [&](Real c) {
        return static_cast<int>(
            std::floor(c * static_cast<Real>(map.edge) - static_cast<Real>(0.5)));
    };
    const auto inside = [&](int i) { return i < 0 ? 0 : (i >= map.edge ? map.edge - 1 : i); };
    const int x0 = inside(lower(coordinate.x)), x1 = inside(lower(coordinate.x) + 1);
    const int y0 = inside(lower(coordinate.y)), y1 = inside(lower(coordinate.y) + 1);
    return {map.at(x0, y1), map.at(x1, y1), map.at(x1, y0), map.at(x0, y0)};
}

#define SHARED_FUNCTION inline

#define STAIRWELL_SHADER_LANGUAGE(scalar)                                                       \
    using real = scalar;                                                                        \
    using real2 = glm::vec<2, real>;                                                            \
    using real3 = glm::vec<3, real>;                                                            \
    using real4 = glm::vec<4, real>;                                                            \
    using real4x4 = glm::mat<4, 4, real>;                                                       \
    using int2 = glm::ivec2;                                                                    \
    using int3 = glm::ivec3;                                                                    \
    using uint4 = glm::uvec4;                                                                   \
    using sampler2D = MapView;                                                                  \
    using sampler2DArray = LayeredMapView<real4>;                                               \
    using usampler2DArray = LayeredMapView<uint4>;                                              \
    using glm::abs, glm::ceil, glm::clamp, glm::cos, glm::cross, glm::dot, glm::exp, glm::exp2, \
        glm::floor, glm::length, glm::lessThan;                                                 \
    using glm::log, glm::log2, glm::max, glm::min, glm::mix, glm::normalize, glm::sin, glm::sqrt;

// Each file needs the ones before it.
// clang-format off
namespace f32 {
STAIRWELL_SHADER_LANGUAGE(float)
#include "renderer/shaders/shared/constants.glsl"
#include "renderer/shaders/shared/receiver.glsl"
#include "renderer/shaders/shared/depth_compare.glsl"
#include "renderer/shaders/shared/disc_kernel.glsl"
#include "renderer/shaders/shared/disc_visibility.glsl"
#include "renderer/shaders/shared/taps.glsl"
#include "renderer/shaders/shared/gradient_compare.glsl"
#include "renderer/shaders/shared/filtered_map.glsl"
#include "renderer/shaders/shared/chebyshev.glsl"
#include "renderer/shaders/shared/exponential_warp.glsl"
#include "renderer/shaders/shared/hamburger.glsl"
#include "renderer/shaders/shared/depth_layers.glsl"
#include "renderer/shaders/shared/summed_map.glsl"
#include "renderer/shaders/shared/mip_map.glsl"
#include "renderer/shaders/shared/penumbra_estimate.glsl"
}  // namespace f32

namespace f64 {
STAIRWELL_SHADER_LANGUAGE(double)
#include "renderer/shaders/shared/constants.glsl"
#include "renderer/shaders/shared/receiver.glsl"
#include "renderer/shaders/shared/depth_compare.glsl"
#include "renderer/shaders/shared/disc_kernel.glsl"
#include "renderer/shaders/shared/disc_visibility.glsl"
#include "renderer/shaders/shared/taps.glsl"
#include "renderer/shaders/shared/gradient_compare.glsl"
#include "renderer/shaders/shared/filtered_map.glsl"
#include "renderer/shaders/shared/chebyshev.glsl"
#include "renderer/shaders/shared/exponential_warp.glsl"
#include "renderer/shaders/shared/hamburger.glsl"
#include "renderer/shaders/shared/depth_layers.glsl"
#include "renderer/shaders/shared/summed_map.glsl"
#include "renderer/shaders/shared/mip_map.glsl"
#include "renderer/shaders/shared/penumbra_estimate.glsl"
}  // namespace f64
// clang-format on

#undef STAIRWELL_SHADER_LANGUAGE

// The f32 structs are the uniform blocks, byte for byte (std140).
static_assert(sizeof(f32::ViewConstants) == 144);
static_assert(offsetof(f32::ViewConstants, eye) == 64);
static_assert(offsetof(f32::ViewConstants, pixelRight) == 80);
static_assert(offsetof(f32::ViewConstants, pixelUp) == 96);
static_assert(offsetof(f32::ViewConstants, forward) == 112);
static_assert(offsetof(f32::ViewConstants, viewport) == 128);
static_assert(sizeof(f32::ShadowConstants) == 336);
static_assert(offsetof(f32::ShadowConstants, shadowFromWorld) == 64);
static_assert(offsetof(f32::ShadowConstants, towardsLight) == 128);
static_assert(offsetof(f32::ShadowConstants, map) == 144);
static_assert(offsetof(f32::ShadowConstants, kernel) == 160);
static_assert(offsetof(f32::ShadowConstants, parameters) == 176);
static_assert(offsetof(f32::ShadowConstants, scale) == 208);
static_assert(offsetof(f32::ShadowConstants, part) == 224);
static_assert(offsetof(f32::ShadowConstants, stretch) == 240);
static_assert(offsetof(f32::ShadowConstants, prefilter) == 256);
static_assert(offsetof(f32::ShadowConstants, layerEnds) == 272);
static_assert(sizeof(f32::LookConstants) == 96);
static_assert(offsetof(f32::LookConstants, zenithColour) == 16);
static_assert(offsetof(f32::LookConstants, horizonColour) == 32);
static_assert(offsetof(f32::LookConstants, skyLight) == 48);
static_assert(offsetof(f32::LookConstants, groundLight) == 64);
static_assert(offsetof(f32::LookConstants, tone) == 80);

/// Binding points of the uniform blocks (BINDING_... in the shaders).
inline constexpr unsigned kViewBinding = 0, kShadowBinding = 1, kLookBinding = 2;

/// The same constants for the CPU at double precision.
f64::ViewConstants toDouble(const f32::ViewConstants& constants);
f64::ShadowConstants toDouble(const f32::ShadowConstants& constants);

}  // namespace renderer

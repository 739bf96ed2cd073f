// SPDX-License-Identifier: MIT
// The techniques on the CPU: the same mathematics as on the GPU (shader_math.h), from the same
// depth map, in float or double, with the map stored as its format has it or otherwise. For tests,
// and to say how exact a technique is.
//
//   const f64::ShadowConstants constants = toDouble(frame.shadowConstants());
//   const CpuMap<double> map = cpuMap<double>(technique, depths, constants);
//   const double visibility = cpuVisibility(technique, map, receiver, constants);
#pragma once

#include <type_traits>
#include <vector>

#include "renderer/shader_math.h"
#include "renderer/technique.h"

namespace renderer {

template <class Real>
using ReceiverOf =
    std::conditional_t<std::is_same_v<Real, float>, f32::ShadowReceiver, f64::ShadowReceiver>;
template <class Real>
using ConstantsOf =
    std::conditional_t<std::is_same_v<Real, float>, f32::ShadowConstants, f64::ShadowConstants>;

/// What is kept of a value between the passes.
enum class Storage {
    asFormat,  ///< what the technique's format keeps of it
    half,      ///< 11 significant bits, for any technique
    exact,     ///< all of it
};

/// What a technique looks up: the depths as they are, or what its prefilter makes of them. `depths`
/// is not owned.
template <class Real>
struct CpuMap {
    MapView depths;
    int edge = 0;  ///< of the filtered map, guard band included
    int layers = 1;
    std::vector<glm::vec<4, Real>> texels;  ///< empty without a prefilter; a mip
                                            ///< chain's levels one after the other
    std::vector<glm::uvec4> sums;           ///< of Prefilter::sums, in place of texels

    LayeredMapView<glm::vec<4, Real>> view() const { return {texels.data(), edge}; }
    LayeredMapView<glm::uvec4> summedView() const { return {sums.data(), edge}; }
};

template <class Real>
CpuMap<Real> cpuMap(const Technique& technique, MapView depths, const ConstantsOf<Real>& constants,
                    Storage storage = Storage::asFormat);

/// A number in [0,1] for any receiver.
template <class Real>
Real cpuVisibility(const Technique& technique, const CpuMap<Real>& map,
                   const ReceiverOf<Real>& receiver, const ConstantsOf<Real>& constants);

/// The nearest value that 11 significant bits hold; ties away from zero; infinite beyond 65504.
float roundedToHalf(float value);

}  // namespace renderer

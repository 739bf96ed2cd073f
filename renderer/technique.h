// SPDX-License-Identifier: MIT
// The table of shadow techniques. It exists once: menus, options, benchmark, tests, reports and
// README loop over it. A new technique is one row in technique.cpp and one file
// renderer/shaders/filters/<name>.glsl with the function
//
//   SHARED_FUNCTION real filterVisibility(sampler2D map, ShadowReceiver receiver, ShadowConstants
//   shadow)
//
// which reads its parameters as PARAMETER_<name>. The file is compiled as GLSL and, by the build,
// as C++.
#pragma once

#include <array>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

#include "renderer/shader_math.h"

namespace renderer {

/// What a texel of the map holds.
enum class MapFormat { depth32f };
std::string_view toText(MapFormat format);
int bytesPerTexel(MapFormat format);

/// What is done to the map between depth pass and lookup.
enum class Prefilter { none };
std::string_view toText(Prefilter prefilter);

/// What every technique promises (METHODS section 6); a row names the ones that do not hold for it.
enum class Property {
    finiteInUnitRange,       ///< a number in [0,1] for any input
    softnessIndependentOfN,  ///< the kernel is given in world or uv units
    biasFollowsN,            ///< in the same frame
    planeLit,                ///< a plane in the map does not shadow itself
    monotoneInDepth,         ///< a receiver farther from the light is never lighter
    errorFallsWithN,         ///< in the median over sub-texel phases
};
std::string_view toText(Property property);

struct TechniqueParameter {
    std::string_view name;     ///< the GLSL name after PARAMETER_
    std::string_view meaning;  ///< with its unit
    float low = 0, high = 1;   ///< range, both ends allowed
    float standard = 0;        ///< default
};

inline constexpr std::size_t kMaxTechniqueParameters =
    8;  ///< the size of ShadowConstants::parameters
using ParameterValues = std::array<float, kMaxTechniqueParameters>;

/// The technique's C++ compilations.
struct CpuFilter {
    std::string_view name;
    float (*f32)(MapView, f32::ShadowReceiver, f32::ShadowConstants) = nullptr;
    double (*f64)(MapView, f64::ShadowReceiver, f64::ShadowConstants) = nullptr;
};

struct Technique {
    std::string_view name;   ///< as in options, tables and the shader file
    std::string_view title;  ///< as in menus and figures
    std::string_view paper;
    MapFormat format = MapFormat::depth32f;
    Prefilter prefilter = Prefilter::none;
    bool soft = true;  ///< has a kernel whose radius is the softness
    std::span<const TechniqueParameter> parameters;
    std::span<const Property> doNotHold = {};
    std::string_view doNotHoldBecause = {};
    std::string_view cost;

    bool holds(Property property) const;
    ParameterValues standardParameters() const;
    std::string shaderFile() const;  ///< "filters/<name>.glsl"
};

std::span<const Technique> techniques();

/// Throws std::invalid_argument that lists the known names.
const Technique& findTechnique(std::string_view name);

/// Sets one parameter by name. Throws std::invalid_argument for a name that the technique does not
/// have, and for a value outside the parameter's range or not finite.
void setParameter(const Technique& technique, ParameterValues& values, std::string_view name,
                  float value);

/// The technique on the CPU: same mathematics, same map, same constants.
const CpuFilter& cpuFilter(const Technique& technique);

}  // namespace renderer

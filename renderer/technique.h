// SPDX-License-Identifier: MIT
// The table of shadow techniques. It exists once: menus, options, benchmark, tests, reports and
// README loop over it. A new technique is one row in technique_table.cpp and one file
// renderer/shaders/filters/<name>.glsl with the function
//
//   SHARED_FUNCTION real filterVisibility(sampler2D map, ShadowReceiver receiver, ShadowConstants
//   shadow)
//
// which reads its parameters as PARAMETER_<name>. A technique whose map is filtered before the
// lookup takes a sampler2DArray instead, one on sums a usampler2DArray, and also says what a texel
// stores:
//
//   SHARED_FUNCTION real4 mapTexel(real depth, real2 slope, int layer, ShadowConstants shadow)
//
// Under a separable kernel it looks up the receiver's place, or places within as many kernels side
// by side as its parameter "samples" says (lookupSpreadTexels() in prefilter.h): what lies
// elsewhere may not have been filtered.
//
// A technique whose kernel's radius varies has penumbraRadiusUv() too (cpu_penumbra.h), which is
// negative where nothing is in the way.
//
// The file is compiled as GLSL and, by the build, as C++ (cpu_filter.h).
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace renderer {

/// What a texel of the map holds that the lookup reads. The split stores two values in four halves
/// (shared/filtered_map.glsl).
enum class MapFormat {
    depth32f,
    r32f,
    rg32f,
    rgba32f,
    r16f,
    rg16f,
    rgba16f,
    rg16fSplit,
    rgba16,
    rg32ui
};
std::string_view toText(MapFormat format);
int bytesPerTexel(MapFormat format);
int channelsOf(MapFormat format);  ///< 1, 2 or 4

/// What is done to the map between depth pass and lookup: nothing; a separable kernel over the
/// map's values, over the exponentials of which it stores the logarithm, or one that also finds the
/// least and the greatest (the numbers are those of shared/filtered_map.glsl); each texel is
/// converted by itself and the lookup has the kernel; a mip chain; a summed-area table. The last
/// two have every width at the lookup.
enum class Prefilter { none = 0, mean = 1, logMean = 2, minMaxMean = 3, converted, mips, sums };
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
    bool whole = false;        ///< whole numbers alone
    bool zeroIsAuto = false;   ///< 0 leaves the choice to what the scene needs
};

/// A promise that does not hold for a technique.
struct Exemption {
    Property property;
    std::string_view because;
};

/// As options and tables write it: "auto" where it is that.
std::string valueText(const TechniqueParameter& parameter, float value);
/// "0 to 4", "0 or 1", "auto or 1 to 16 in whole numbers".
std::string rangeText(const TechniqueParameter& parameter);

inline constexpr std::size_t kMaxTechniqueParameters =
    8;  ///< the size of ShadowConstants::parameters
using ParameterValues = std::array<float, kMaxTechniqueParameters>;

struct Technique {
    std::string_view name;   ///< as in options and tables
    std::string_view title;  ///< as in menus and figures
    std::string_view paper;
    std::string_view file = {};  ///< below filters/, without .glsl; empty: the name
    MapFormat format = MapFormat::depth32f;
    Prefilter prefilter = Prefilter::none;
    /// Name of the parameter that says how many terms are stored, and how many of them a texel
    /// holds; a map has as many layers as they take. Empty: one layer.
    std::string_view termsParameter = {};
    int termsPerTexel = 2;
    bool soft = true;  ///< has a kernel whose radius is the softness
    std::span<const TechniqueParameter> parameters;
    std::span<const Exemption> doNotHold = {};
    float planeDarkening = 0;  ///< most that a plane along the map darkens itself, of 1
    /// Likewise for a plane whose depth changes by up to a seventh of the range under the kernel
    /// and the texel around it, as none of a built-in scene does at N = 64 and more.
    float steepDarkening = planeDarkening;
    std::string_view cost;

    bool holds(Property property) const;
    ParameterValues standardParameters() const;
    std::string_view fileName() const { return file.empty() ? name : file; }
    std::string shaderFile() const;  ///< "filters/<file>.glsl"
    /// Position in `parameters`, or absent.
    std::optional<std::size_t> parameterSlot(std::string_view parameter) const;
    int mapLayers(const ParameterValues& values) const;
    /// Samples of depth in a texel, whose stored values are joined as the prefilter joins texels:
    /// its parameter "map_samples"; 1 without.
    int mapSamples(const ParameterValues& values) const;
};

std::span<const Technique> techniques();

/// Throws std::invalid_argument that lists the known names.
const Technique& findTechnique(std::string_view name);

/// Sets one parameter by name. Throws std::invalid_argument for a name that the technique does not
/// have, and for a value outside the parameter's range, not finite, or broken where it must be
/// whole.
void setParameter(const Technique& technique, ParameterValues& values, std::string_view name,
                  float value);

/// Throws as setParameter() for the first of the technique's parameters that it would refuse.
void checkParameters(const Technique& technique, const ParameterValues& values);

}  // namespace renderer

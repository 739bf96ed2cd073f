// SPDX-License-Identifier: MIT
// Where shadow techniques break: distributions of depth under the kernel that are flat, nearly
// flat, concentrated, near the ends of the range or out of it, maps of one texel, kernels of no
// width and wider than the map, receivers that graze the light, each with receivers at, just before
// and behind every depth that matters. And how far a technique is off there from its own formula in
// long double (exact_technique.h).
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/renderer/technique_case.h"

namespace tests {

struct HardReceiver {
    double depth = 0;
    glm::dvec2 gradient = glm::dvec2(0);
};

/// A square map, row by row, and the receivers to hold over its middle texel, between texels
/// and over its edge.
struct HardCase {
    std::string name;
    int edge = 9;
    double radiusUv = 0;
    std::vector<float> depths;
    std::vector<HardReceiver> receivers;
};
std::vector<HardCase> hardCases();

/// The precisions that techniques are tested at.
enum class Precision {
    half,      ///< float, with the map in halves
    asStored,  ///< float, with the map as the technique's format has it
    doubles,   ///< double throughout
};
inline constexpr Precision kPrecisions[] = {Precision::half, Precision::asStored,
                                            Precision::doubles};
std::string toText(Precision precision);

/// Parameters that are not the defaults.
using Variant = std::vector<std::pair<std::string_view, float>>;
/// Every one of a technique that chooses between formulas, and the defaults first.
std::vector<Variant> variantsOf(const renderer::Technique& technique);
std::string toText(const Variant& variant);

struct HardError {
    double worst = 0;
    std::string where;  ///< case and receiver
};
/// Over all cases: the largest difference in visibility from the technique's formula in long
/// double, and in double where it has none there.
HardError worstError(const renderer::Technique& technique, Precision precision,
                     const Variant& variant = {});

}  // namespace tests

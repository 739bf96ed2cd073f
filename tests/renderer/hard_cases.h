// SPDX-License-Identifier: MIT
// Where shadow techniques break: distributions of depth under the kernel that are flat, nearly
// flat, concentrated, near the ends of the range or out of it, each with receivers at, just before
// and behind every depth that matters. And how far a technique is off there from its own
// mathematics at the precision of long double.
#pragma once

#include <string>
#include <vector>

#include "renderer/cpu_filter.h"

namespace tests {

/// A 9 x 9 map, row by row, and the receivers to hold over its middle.
struct HardCase {
    std::string name;
    std::vector<float> depths;
    std::vector<double> receivers;
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

struct HardError {
    double worst = 0;
    std::string where;  ///< case and receiver
};
/// Over all cases: the largest difference in visibility from the technique's own formula, evaluated
/// in long double on exact moments of the same depths, at default parameters (but without the
/// variance of a texel's own slope, which the distribution does not have). Techniques that
/// compare depths one by one are held against themselves in double.
HardError worstError(const renderer::Technique& technique, Precision precision);

}  // namespace tests

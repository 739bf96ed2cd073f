// SPDX-License-Identifier: MIT
// The slope c of r = c a: filter radius = c times the edge of one shadow-map texel, in the same
// unit, with what it was measured as. Without that a c means nothing: at beta 3.5 the radius at
// which one observer in ten still notices is 1.92 times the one at the published criterion.
//
// Source: F. Kreuzer, "Using Perception-Based Filtering to Hide Shadow Artifacts", equation 1.
#pragma once

#include <cstdint>
#include <string>

namespace resolution_controller {

enum class Task : std::uint8_t { twoAfc, yesNo };
/// Filtered in light, or in code values.
enum class Encoding : std::uint8_t { srgb, code, unknown };
/// sampled: a few randomly rotated taps.
enum class Kernel : std::uint8_t { disc, box, gaussian, sampled, unknown };

/// Major version of the slope file that these numbers are understood as.
inline constexpr std::int32_t kSlopeMajor = 1;

/// The defaults are the published slope: what to use where no study of one's own is at hand.
struct Slope {
    double c = 3.47;            ///< > 0, dimensionless; the mean observer's
    double criterion = 0.6465;  ///< F*, detection probability at r = c a, in (0, 1); the published
                                ///< one is 82 % correct in 2AFC
    Task task = Task::twoAfc;
    Encoding encoding = Encoding::code;
    double beta = 3.5;  ///< slope of the psychometric function, > 0: converts criteria

    /// c of the observer whom 90 % of people do not surpass, > 0; 0: not known (audience.h).
    double c90 = 0;
    /// e of c(C) = c max(C, .02)^e, C the contrast of a shadow's edge: in [-4, 4]; 0: the same c
    /// for every contrast.
    double contrastExponent = 0;
    /// The published study does not say; of the kernels, only the disc fits both of its anchors.
    Kernel kernel = Kernel::disc;
    std::int32_t major = kSlopeMajor;  ///< of the file it came from; another one is refused

    bool operator==(const Slope&) const = default;
};

/// Empty when usable; else a sentence that names field, value and rule.
std::string validate(const Slope& slope);

/// The same observer's slope for another criterion: c(F) = c (ln(1-F*)/ln(1-F))^(1/beta); c90
/// likewise. A lower criterion hides more and asks for larger maps. Throws std::invalid_argument
/// for a slope that does not validate and a criterion outside (0, 1).
Slope atCriterion(const Slope& slope, double criterion);

/// Least contrast that the contrast term tells apart.
inline constexpr double kLeastContrast = 0.02;

/// C^e, what c is multiplied with at contrast C in [0, 1], 1 being full light against full shadow.
/// A contrast that is NaN or outside [0, 1] counts as 1, the contrast that the slope stands for.
/// The same on every machine.
double contrastFactor(double contrast, double exponent) noexcept;

/// "c = 3.47 (detected with probability 0.6465 at r = c a; 2AFC, filtered in code values, beta
/// 3.5)": the form in which c is shown.
std::string describe(const Slope& slope);

}  // namespace resolution_controller

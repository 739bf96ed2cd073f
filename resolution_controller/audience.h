// SPDX-License-Identifier: MIT
// From whom, and how well, the stair-steps are to be hidden: in a user's words, and what that makes
// of a slope.
//
//     const AudienceSlope chosen = slopeFor(slope, kHiddenForNineInTen, {.encoding = srgb});
//     for (each bit of chosen.warnings) show(text(bit));
//     ResolutionController controller({.slope = chosen.slope});
//
// How well: the probability F that a person who looks for the artifact detects it. How many people:
// observers differ by a factor that is log-normal, so that the c which suits the share q of them is
// c (c90 / c)^(z(q) / z(.9)), z the quantiles of the normal distribution.
#pragma once

#include <cstdint>
#include <string>

#include "resolution_controller/slope.h"

namespace resolution_controller {

struct Audience {
    /// F, how often the artifact may still be detected by who looks for it: in (0, 1), or 0 for the
    /// criterion that the slope was measured at.
    double detection = 0;
    /// Share of people of whom that holds, in [0.01, 0.99]. 0.5 is the mean observer.
    double people = 0.5;

    bool operator==(const Audience&) const = default;
};

/// As the slope was measured. At the published criterion the mean observer still detects the
/// artifact in two looks of three.
inline constexpr Audience kAsMeasured{};
/// Detected in one look of ten, by the mean observer.
inline constexpr Audience kHidden{.detection = 0.10};
/// "Hidden for 90 % of people".
inline constexpr Audience kHiddenForNineInTen{.detection = 0.10, .people = 0.90};

/// What the renderer does; unknown where it cannot say.
struct RendererTraits {
    Encoding encoding = Encoding::unknown;
    Kernel kernel = Kernel::unknown;
};

/// Bits of AudienceSlope::warnings.
enum class Warning : std::uint32_t {
    encodingDiffers = 1,    ///< filtered in light here and in code values there, or the reverse
    kernelDiffers = 2,      ///< another filter kernel
    encodingUnknown = 4,    ///< the slope does not say
    kernelUnknown = 8,      ///< the slope does not say
    populationUnknown = 16  ///< no c90: c is the mean observer's, whatever share was asked for
};
inline constexpr std::uint32_t kAllWarnings = 31;

/// A sentence for people; "unknown" for anything but a single bit.
const char* text(Warning warning) noexcept;

struct AudienceSlope {
    Slope slope;                 ///< with c and criterion as asked for; task etc. as measured
    std::uint32_t warnings = 0;  ///< Warning bits
};

/// Throws std::invalid_argument for a slope that does not validate, a detection outside [0, 1) and
/// people outside [0.01, 0.99]. The c that comes out is rounded to 21 binary digits, so that C
/// libraries that differ in the last bits of a power give the same decisions.
AudienceSlope slopeFor(const Slope& slope, const Audience& audience,
                       const RendererTraits& renderer = {});

/// "detected in at most 10 % of looks, for 90 % of people".
std::string describe(const Audience& audience);

}  // namespace resolution_controller

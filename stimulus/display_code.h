// SPDX-License-Identifier: MIT
// From filtered visibility V in [0, 1] to the 8-bit code that the display gets.
//
//   srgb  V is light, and the display decodes sRGB: the code is the sRGB encoding of V (what a
//         renderer does; IEC 61966-2-1). The default of new designs.
//   code  V is blended in code values (the published study's presets).
//
// Code = floor(encode(V) W + 1/2), W = 255 x lit level: the level scales codes, after the encoding.
// Codes never fall as V or the lit level rises. What lies within 1e-9 of a tie counts as the tie,
// so that no code hangs on the last bits of V: at lit level 1/2 full light is the tie 127.5, and a
// Gaussian never quite gets there.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace stimulus {

enum class Encoding { srgb, code };

/// Share of full code for V in [0, 1]; exactly 0 at 0 and 1 at 1.
inline double encode(double v, Encoding encoding) {
    if (encoding == Encoding::code || v >= 1) return v;  // 1.055 - 0.055 is not 1 in double
    return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
}

/// The steepest that encode() rises at v and above: its slope falls.
inline double encodeSlope(double v, Encoding encoding) {
    if (encoding == Encoding::code) return 1;
    return v <= 0.0031308 ? 12.92 : 1.055 / 2.4 * std::pow(v, 1 / 2.4 - 1);
}

inline constexpr double kHalfUp = 0.5 + 1e-9;

inline std::uint8_t displayCode(double v, double litLevel, Encoding encoding) {
    return static_cast<std::uint8_t>(encode(v, encoding) * (255 * litLevel) + kHalfUp);
}

/// The same with `added` codes of noise, held within 0..255, and with another rounding. Dither
/// rounds by a random number, uniform in [0, 1), in place of kHalfUp: the mean code is then exact,
/// and no contour shows where a wide ramp changes from one code to the next.
inline std::uint8_t roundedCode(double v, double litLevel, Encoding encoding, double added,
                                double rounding) {
    const double code = std::floor(encode(v, encoding) * (255 * litLevel) + added + rounding);
    return static_cast<std::uint8_t>(std::clamp(code, 0.0, 255.0));
}

/// Throws std::invalid_argument unless the lit level is in [0, 1].
void validateLitLevel(double litLevel);

}  // namespace stimulus

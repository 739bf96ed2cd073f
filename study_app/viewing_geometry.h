// SPDX-License-Identifier: MIT
// What a pixel is to the eye in front of it: px/mm from a bank card held against the screen, and
// with the viewing distance px per degree.
//
// A length s at distance d, seen straight on, subtends 2 atan(s / 2d). "px/deg" is the number of
// pixels in one degree at the middle of the screen, 2 d tan(1/2 deg) px/mm.
#pragma once

#include <optional>
#include <string>

#include "records/screen_luminance.h"

namespace study_app {

/// ISO/IEC 7810 ID-1: every bank card.
inline constexpr double kCardWidthMm = 85.60, kCardHeightMm = 53.98;

/// Of the card as it was matched on screen.
constexpr double pxPerMmFromCard(double cardWidthPx) {
    return cardWidthPx / kCardWidthMm;
}

double pxPerDeg(double pxPerMm, double distanceMm);

/// Visual angle of a length on screen, minutes of arc.
double arcMinutes(double lengthPx, double pxPerMm, double distanceMm);

/// The grey code that looks like lines of full white and black in turn, at a display of this gamma.
int greyCodeOfHalfLight(double gamma);
/// And back: the gamma of a display on which this code matches the lines. Code in 1..254.
double gammaFromGreyCode(int code);

/// Of the display that gives this light at codes 0, records::kMeasuredGreyCode and 255: the
/// exponent of the light above black. Absent where a reading is, or where they do not rise.
std::optional<double> gammaFromLuminance(const records::ScreenLuminance& luminance);

/// A display as an experimenter calibrated it; what is not known is absent.
struct DisplayProfile {
    std::string name;  ///< of the monitor, as the system gives it
    int widthPx = 0, heightPx = 0;
    std::optional<double> pxPerMm = {};
    std::optional<double> distanceMm = {};
    std::optional<double> gamma = {};
    records::ScreenLuminance luminance = {};
    bool operator==(const DisplayProfile&) const = default;
};

/// px/deg where both the size of a pixel and the distance are known.
std::optional<double> pxPerDeg(const DisplayProfile& profile);

/// Empty when usable; else "<field>: <value>: <rule>".
std::string validate(const DisplayProfile& profile);

/// What the window system says about the display, and the sentences that an experimenter should
/// read before trusting a pixel to be a pixel.
struct DisplayState {
    int windowWidth = 0, windowHeight = 0;  ///< in the window system's units
    int framebufferWidthPx = 0, framebufferHeightPx = 0;
    int modeWidthPx = 0, modeHeightPx = 0;      ///< current mode of the monitor
    int nativeWidthPx = 0, nativeHeightPx = 0;  ///< its largest mode
    double contentScale = 1;                    ///< desktop scale
    int bitsPerChannel = 8;
};
/// One sentence per problem, joined by line ends; empty where nothing is wrong.
std::string displayWarnings(const DisplayState& state);

}  // namespace study_app

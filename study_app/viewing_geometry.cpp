// SPDX-License-Identifier: MIT
#include "study_app/viewing_geometry.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "records/number_rule.h"
#include "records/quoted_text.h"

namespace study_app {
namespace {

constexpr double kRadian = std::numbers::pi / 180;

std::string text(const char* format, double a, double b = 0, double c = 0, double d = 0) {
    char line[256];
    std::snprintf(line, sizeof line, format, a, b, c, d);
    return line;
}

}  // namespace

double pxPerDeg(double pxPerMm, double distanceMm) {
    return 2 * distanceMm * std::tan(kRadian / 2) * pxPerMm;
}

double arcMinutes(double lengthPx, double pxPerMm, double distanceMm) {
    return 2 * std::atan(lengthPx / pxPerMm / (2 * distanceMm)) / kRadian * 60;
}

int greyCodeOfHalfLight(double gamma) {
    return static_cast<int>(std::lround(255 * std::pow(0.5, 1 / gamma)));
}

double gammaFromGreyCode(int code) {
    return std::log(0.5) / std::log(code / 255.0);
}

std::optional<double> gammaFromLuminance(const records::ScreenLuminance& l) {
    if (!l.black || !l.grey || !l.white || !validate(l).empty()) return {};
    return std::log((*l.grey - *l.black) / (*l.white - *l.black)) /
           std::log(records::kMeasuredGreyCode / 255.0);
}

std::optional<double> pxPerDeg(const DisplayProfile& profile) {
    if (!profile.pxPerMm || !profile.distanceMm) return {};
    return pxPerDeg(*profile.pxPerMm, *profile.distanceMm);
}

std::string validate(const DisplayProfile& p) {
    const auto broken = [](const char* field, const std::optional<double>& value,
                           const records::NumberRule& rule) -> std::string {
        if (!value || rule.holds(*value)) return {};
        return std::string(field) + ": " + records::exactText(*value) + ": " + rule.text();
    };
    // From a projector's wall to a phone; from a nose's length to a lecture hall.
    for (const std::string& found :
         {broken("px_per_mm", p.pxPerMm, records::between(0.05, 50)),
          broken("distance_mm", p.distanceMm, records::between(50, 50000)),
          broken("gamma", p.gamma, records::between(0.5, 5)), records::validate(p.luminance)}) {
        if (!found.empty()) return found;
    }
    return {};
}

std::string displayWarnings(const DisplayState& s) {
    std::string warnings;
    const auto add = [&](const std::string& sentence) {
        warnings += (warnings.empty() ? "" : "\n") + sentence;
    };
    if (s.framebufferWidthPx != s.windowWidth || s.framebufferHeightPx != s.windowHeight) {
        add(
            text("The window system resamples: the window is %.0f x %.0f units but %.0f x %.0f "
                 "pixels. Sizes in pixels hold only if the display's own pixels are meant.",
                 s.windowWidth, s.windowHeight, s.framebufferWidthPx, s.framebufferHeightPx));
    }
    if (s.modeWidthPx < s.nativeWidthPx || s.modeHeightPx < s.nativeHeightPx) {
        add(
            text("The display runs at %.0f x %.0f, below its native %.0f x %.0f: it blurs what is "
                 "drawn. Set the native resolution.",
                 s.modeWidthPx, s.modeHeightPx, s.nativeWidthPx, s.nativeHeightPx));
    }
    if (s.contentScale != 1) {
        add(
            text("The desktop is scaled by %.3g. Stimuli keep their pixels only where the desktop "
                 "does not enlarge windows afterwards: look at the 1 px lines below.",
                 s.contentScale));
    }
    if (s.bitsPerChannel < 8) {
        add(text("The display shows %.0f bits per channel: codes will be merged.",
                 s.bitsPerChannel));
    }
    return warnings;
}

}  // namespace study_app

// SPDX-License-Identifier: MIT
// The sampled filter of real-time renderers: the mean of n taps of the unfiltered edge, a Poisson
// pattern on the disc of radius r, turned at random in every pixel (the error becomes noise) or
// once per image (it becomes bands). Kreuzer, "Using Perception-Based Filtering to Hide Shadow
// Artifacts", section 6, expects such noise to hide contours and leaves it untested.
//
//   const TapKernel kernel = *tapKernelFromText("poisson16");
//   const double v = tapVisibility(poissonTaps(kernel.taps), {cos, sin}, edge, radiusPx, x, y);
//
// Each tap is exact: light or shadow where it falls, 1/2 on the edge itself. Over all turns the
// mean is a disc filter with n rings in place of the filled disc.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "stimulus/silhouette.h"

namespace stimulus {

enum class TapTurn { perPixel, perImage };

struct TapKernel {
    int taps = 16;  ///< 1..kMostTaps
    TapTurn turn = TapTurn::perPixel;
    bool operator==(const TapKernel&) const = default;
};
inline constexpr int kMostTaps = 256;

/// "poisson16", turned per pixel; "poisson16-still", turned once per image.
std::string toText(const TapKernel& kernel);
/// Nothing for any other text, "poisson016" and "poisson0" among them.
std::optional<TapKernel> tapKernelFromText(std::string_view text);

struct Point {
    double x = 0, y = 0;
};

/// n points of the unit disc, the same on every machine: D. Mitchell's best candidates
/// ("Spectrally optimal sampling for distribution ray tracing", SIGGRAPH 1991), each then moved
/// along its radius so that the i-th from the centre covers the i-th of n rings of equal area.
/// Throws std::invalid_argument unless n is in 1..kMostTaps.
std::vector<Point> poissonTaps(int n);

/// A direction, uniform on the circle, without sine and cosine, which differ between libraries (J.
/// von Neumann 1951, by rejection).
Point randomDirection(std::mt19937_64& rng);

/// Light or shadow of the two edges, unfiltered: 1, 0, or 1/2 on the edge.
class SharpEdges {
  public:
    /// For points with |x| and |y| up to reachPx.
    SharpEdges(const Silhouette& silhouette, double reachPx);
    double artifact(double x, double y) const {
        // Not negative within the reach, so cutting off is rounding down, and no call of floor().
        return lit(y - heights_[static_cast<std::size_t>(x / width_ - firstTexel_)]);
    }
    double straight(double x, double y) const { return lit(silhouette_.distance(x, y)); }

    /// The light or shadow that every point within `radiusPx` of here has; nothing where an edge is
    /// that near. Heights rise from left to right.
    std::optional<double> artifactAround(double x, double y, double radiusPx) const {
        const double reach = withMargin(radiusPx);
        const double lightest = artifact(x - reach, y + reach);
        const double darkest = artifact(x + reach, y - reach);
        return lightest == darkest && lightest != 0.5 ? std::optional(lightest) : std::nullopt;
    }
    std::optional<double> straightAround(double x, double y, double radiusPx) const {
        const double distance = silhouette_.distance(x, y);
        if (std::abs(distance) <= withMargin(radiusPx)) return {};
        return lit(distance);
    }

  private:
    /// Far above what rounding moves a point by.
    static double withMargin(double radiusPx) { return radiusPx * (1 + 1e-9) + 1e-6; }

    static double lit(double above) { return above > 0 ? 1 : above < 0 ? 0 : 0.5; }

    Silhouette silhouette_;
    double width_, firstTexel_;
    std::vector<double> heights_;
};

}  // namespace stimulus

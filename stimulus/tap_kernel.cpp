// SPDX-License-Identifier: MIT
#include "stimulus/tap_kernel.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numeric>

#include "stimulus/sentence.h"

namespace stimulus {
namespace {

constexpr std::string_view kName = "poisson", kStill = "-still";
constexpr std::uint64_t kPatternSeed = 0x506f6973736f6eu;
// Candidates per tap and tap that is there; more of them do not spread the pattern visibly wider.
constexpr std::size_t kCandidates = 8;

double uniform(std::mt19937_64& rng) {
    return static_cast<double>(rng() >> 11) * 0x1p-53;
}

double squaredDistance(const Point& a, const Point& b) {
    return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
}

/// Uniform in the unit disc, but for its centre.
Point inDisc(std::mt19937_64& rng) {
    while (true) {
        const double x = 2 * uniform(rng) - 1, y = 2 * uniform(rng) - 1;
        const double square = x * x + y * y;
        if (square > 1e-6 && square <= 1) return {x, y};
    }
}

double toNearest(const Point& p, const std::vector<Point>& others) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Point& other : others) nearest = std::min(nearest, squaredDistance(p, other));
    return nearest;
}

}  // namespace

std::string toText(const TapKernel& kernel) {
    return std::string(kName) + std::to_string(kernel.taps) +
           (kernel.turn == TapTurn::perImage ? std::string(kStill) : "");
}

std::optional<TapKernel> tapKernelFromText(std::string_view text) {
    if (!text.starts_with(kName)) return {};
    TapKernel kernel;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data() + kName.size(), end, kernel.taps);
    if (error != std::errc() || kernel.taps < 1 || kernel.taps > kMostTaps) return {};
    if (stop != end) kernel.turn = TapTurn::perImage;
    // One text for one kernel: what is read must be what would be written.
    return toText(kernel) == text ? std::optional(kernel) : std::nullopt;
}

std::vector<Point> poissonTaps(int n) {
    require(n >= 1 && n <= kMostTaps, "number of taps", n, "", "must be in 1..256");
    std::mt19937_64 rng(kPatternSeed);
    std::vector<Point> points;
    while (points.size() < static_cast<std::size_t>(n)) {
        Point best = inDisc(rng);
        double farthest = toNearest(best, points);
        for (std::size_t i = 1; i < kCandidates * (points.size() + 1); ++i) {
            const Point candidate = inDisc(rng);
            const double distance = toNearest(candidate, points);
            if (distance <= farthest) continue;
            best = candidate;
            farthest = distance;
        }
        points.push_back(best);
    }
    const auto square = [](const Point& p) { return p.x * p.x + p.y * p.y; };
    std::ranges::sort(points, {}, square);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double ring = (static_cast<double>(i) + 0.5) / n;  // of the area, its middle
        const double scale = std::sqrt(ring / square(points[i]));
        points[i] = {points[i].x * scale, points[i].y * scale};
    }
    return points;
}

Point randomDirection(std::mt19937_64& rng) {
    const Point p = inDisc(rng);
    const double length = std::sqrt(p.x * p.x + p.y * p.y);
    return {p.x / length, p.y / length};
}

SharpEdges::SharpEdges(const Silhouette& silhouette, double reachPx)
    : silhouette_(silhouette), width_(silhouette.texelWidth()) {
    const std::int64_t first = silhouette.texelAt(-reachPx), last = silhouette.texelAt(reachPx);
    firstTexel_ = static_cast<double>(first);
    for (std::int64_t k = first; k <= last; ++k) heights_.push_back(silhouette.height(k));
}

}  // namespace stimulus

// SPDX-License-Identifier: MIT
#include "demo/edge_ripple.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <stdexcept>
#include <string>

#include "demo/map_places.h"

namespace demo {
namespace {

// The tangent is taken over a few pixels: from one crossing to the next it follows the pixels'
// grid.
constexpr std::ptrdiff_t kTangentReach = 4;
// A line that has turned by more than 45 degrees is another edge.
const double kLeastAlignment = std::sqrt(0.5);

/// A contour as a line on the map, in texels, with the error along it.
struct MapLine {
    std::vector<glm::dvec2> texels;
    std::vector<double> errors;
    bool closed = false;

    std::ptrdiff_t size() const { return static_cast<std::ptrdiff_t>(texels.size()); }
    /// Position of the point that is `steps` further; absent beyond an open line's end.
    std::ptrdiff_t from(std::ptrdiff_t i, std::ptrdiff_t steps) const {
        const std::ptrdiff_t at = i + steps;
        if (!closed) return at < 0 || at >= size() ? -1 : at;
        return ((at % size()) + size()) % size();
    }
    const glm::dvec2& texel(std::ptrdiff_t i) const { return texels[static_cast<std::size_t>(i)]; }

    glm::dvec2 tangent(std::ptrdiff_t i) const {
        const auto along = [&](std::ptrdiff_t steps) {
            for (; steps != 0; steps += steps > 0 ? -1 : 1)
                if (const std::ptrdiff_t at = from(i, steps); at >= 0) return texel(at);
            return texel(i);
        };
        const glm::dvec2 chord = along(kTangentReach) - along(-kTangentReach);
        const double length = glm::length(chord);
        return length > 0 ? chord / length : glm::dvec2(1, 0);
    }
};

MapLine mapLine(const renderer::FloatImage& image, const renderer::FloatImage& truth,
                const renderer::FloatImage& places, const Contour& contour, double resolution) {
    MapLine line;
    line.closed = contour.closed;
    for (const ContourPoint& point : contour.points) {
        line.texels.emplace_back(resolution * valueAt(places, point, kPlaceU),
                                 resolution * valueAt(places, point, kPlaceV));
        line.errors.push_back(valueAt(image, point) - valueAt(truth, point));
    }
    return line;
}

double rippleAt(const MapLine& line, const std::vector<glm::dvec2>& tangents, std::ptrdiff_t i) {
    const auto errorAt = [&](std::ptrdiff_t at) {
        return line.errors[static_cast<std::size_t>(at)];
    };
    const glm::dvec2 tangent = tangents[static_cast<std::size_t>(i)];
    // An edge mostly along u goes up a riser wherever it has come half a texel further in v.
    const int across = std::abs(tangent.x) > std::abs(tangent.y) ? 1 : 0;
    double low = errorAt(i);
    double high = low;
    for (const std::ptrdiff_t direction : {-1, 1}) {
        double length = 0;
        std::ptrdiff_t before = i;
        for (std::ptrdiff_t steps = 1; steps < line.size(); ++steps) {
            const std::ptrdiff_t at = line.from(i, direction * steps);
            if (at < 0 || std::abs(glm::dot(tangents[static_cast<std::size_t>(at)], tangent)) <
                              kLeastAlignment)
                break;
            // How much of this piece of the line lies within half a period.
            const double piece = glm::distance(line.texel(at), line.texel(before));
            const double risen = std::abs(line.texel(before)[across] - line.texel(i)[across]);
            const double rises = std::abs(line.texel(at)[across] - line.texel(i)[across]) - risen;
            double share = 1;
            if (risen + rises > 0.5) share = (0.5 - risen) / rises;
            if (length + piece > 0.5 * kLongestRiserPeriodTexels)
                share = std::min(share, (0.5 * kLongestRiserPeriodTexels - length) / piece);
            // The next pixel always counts: where texels are smaller than pixels, steps alias.
            if (steps == 1) share = 1;
            const double error = errorAt(before) + share * (errorAt(at) - errorAt(before));
            if (std::isnan(error)) return std::numeric_limits<double>::quiet_NaN();
            low = std::min(low, error);
            high = std::max(high, error);
            if (risen + rises > 0.5 || length + piece > 0.5 * kLongestRiserPeriodTexels) break;
            length += piece;
            before = at;
        }
    }
    return high - low;
}

}  // namespace

std::vector<float> edgeRipples(const renderer::FloatImage& image, const renderer::FloatImage& truth,
                               const renderer::FloatImage& places,
                               const std::vector<Contour>& contours, double resolution) {
    if (image.width != truth.width || image.height != truth.height || image.width != places.width ||
        image.height != places.height)
        throw std::invalid_argument(
            "edge ripple: image is " + std::to_string(image.width) + " x " +
            std::to_string(image.height) + ", truth " + std::to_string(truth.width) + " x " +
            std::to_string(truth.height) + ", places " + std::to_string(places.width) + " x " +
            std::to_string(places.height) + "; they must be of one size");
    if (!(resolution >= 1))
        throw std::invalid_argument("edge ripple: resolution is " + std::to_string(resolution) +
                                    ", must be at least 1");
    std::vector<float> ripples;
    for (const Contour& contour : contours) {
        const MapLine line = mapLine(image, truth, places, contour, resolution);
        std::vector<glm::dvec2> tangents;
        for (std::ptrdiff_t i = 0; i < line.size(); ++i) tangents.push_back(line.tangent(i));
        for (std::ptrdiff_t i = 0; i < line.size(); ++i)
            ripples.push_back(static_cast<float>(rippleAt(line, tangents, i)));
    }
    return ripples;
}

std::vector<float> edgeRipples(const renderer::FloatImage& image, const renderer::FloatImage& truth,
                               const renderer::FloatImage& places, double resolution) {
    return edgeRipples(image, truth, places, shadowContours(truth, places), resolution);
}

EdgeRipple summarised(std::vector<float> ripples) {
    if (ripples.empty()) return {};
    for (float& ripple : ripples)
        if (std::isnan(ripple)) ripple = std::numeric_limits<float>::infinity();
    const auto place =
        static_cast<std::ptrdiff_t>(std::ceil(0.95 * static_cast<double>(ripples.size()))) - 1;
    std::nth_element(ripples.begin(), ripples.begin() + place, ripples.end());
    return {.contourPixels = ripples.size(),
            .p95 = static_cast<double>(ripples[static_cast<std::size_t>(place)]),
            .most = static_cast<double>(*std::max_element(ripples.begin(), ripples.end()))};
}

}  // namespace demo

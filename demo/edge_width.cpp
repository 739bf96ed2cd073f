// SPDX-License-Identifier: MIT
#include "demo/edge_width.h"

#include <cmath>
#include <glm/glm.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "demo/map_places.h"
#include "demo/shadow_contour.h"
#include "demo/spread.h"

namespace demo {
namespace {

constexpr double kLow = 0.1, kHigh = 0.9;
constexpr double kStepPx = 0.5;
// Wider edges than this are not followed; chosen as half the height of a small viewport.
constexpr double kMostHalfWidthPx = 90;

/// Between the four pixels around a place; absent beyond the rim and where one of them is sky.
std::optional<double> bilinear(const renderer::FloatImage& image,
                               const renderer::FloatImage& places, glm::dvec2 at) {
    const int x = static_cast<int>(std::floor(at.x));
    const int y = static_cast<int>(std::floor(at.y));
    if (x < 0 || y < 0 || x + 1 >= image.width || y + 1 >= image.height) return std::nullopt;
    const double u = at.x - x;
    const double v = at.y - y;
    double sum = 0;
    for (const int dy : {0, 1})
        for (const int dx : {0, 1}) {
            if (places.at(x + dx, y + dy, kPlaceIsSurface) == 0) return std::nullopt;
            sum += (dx == 1 ? u : 1 - u) * (dy == 1 ? v : 1 - v) *
                   static_cast<double>(image.at(x + dx, y + dy));
        }
    return sum;
}

/// Distance from `from` along `direction` to where the image passes `level`.
std::optional<double> distanceTo(const renderer::FloatImage& image,
                                 const renderer::FloatImage& places, glm::dvec2 from,
                                 glm::dvec2 direction, double level) {
    const auto start = bilinear(image, places, from);
    if (!start) return std::nullopt;
    const bool rising = level > 0.5;
    double before = *start;
    if (rising ? before >= level : before <= level) return 0.0;
    for (double way = kStepPx; way <= kMostHalfWidthPx; way += kStepPx) {
        const auto value = bilinear(image, places, from + way * direction);
        if (!value) return std::nullopt;
        if (rising ? *value >= level : *value <= level)
            return way - kStepPx * (*value - level) / (*value - before);
        // A shadow that turns back before it reaches the level has no edge of that height.
        if (rising ? *value < 0.5 && *value < before : *value > 0.5 && *value > before)
            return std::nullopt;
        before = *value;
    }
    return std::nullopt;
}

std::optional<double> widthAcross(const renderer::FloatImage& image,
                                  const renderer::FloatImage& places, glm::dvec2 from,
                                  glm::dvec2 towardsLight) {
    const auto up = distanceTo(image, places, from, towardsLight, kHigh);
    const auto down = distanceTo(image, places, from, -towardsLight, kLow);
    if (!up || !down) return std::nullopt;
    return *up + *down;
}

}  // namespace

EdgeWidth edgeWidth(const renderer::FloatImage& image, const renderer::FloatImage& truth,
                    const renderer::FloatImage& places) {
    if (image.width != truth.width || image.height != truth.height)
        throw std::invalid_argument("edge width: image is " + std::to_string(image.width) + " x " +
                                    std::to_string(image.height) + ", truth " +
                                    std::to_string(truth.width) + " x " +
                                    std::to_string(truth.height) + "; they must be of one size");
    const auto position = [&](std::size_t pixel) {
        return glm::dvec2(static_cast<double>(pixel % static_cast<std::size_t>(truth.width)),
                          static_cast<double>(pixel / static_cast<std::size_t>(truth.width)));
    };
    std::vector<double> widths, truthWidths, ratios;
    for (const Contour& contour : shadowContours(truth, places))
        for (const ContourPoint& point : contour.points) {
            const glm::dvec2 at = glm::mix(position(point.first), position(point.second),
                                           static_cast<double>(point.share));
            glm::dvec2 gradient(0);
            for (const int axis : {0, 1}) {
                glm::dvec2 step(0);
                step[axis] = 1;
                const auto more = bilinear(truth, places, at + step);
                const auto less = bilinear(truth, places, at - step);
                if (more && less) gradient[axis] = *more - *less;
            }
            if (!(glm::length(gradient) > 0)) continue;
            gradient = glm::normalize(gradient);
            const auto own = widthAcross(image, places, at, gradient);
            const auto right = widthAcross(truth, places, at, gradient);
            if (!own || !right || !(*right > 0)) continue;
            widths.push_back(*own);
            truthWidths.push_back(*right);
            ratios.push_back(*own / *right);
        }
    return {.places = widths.size(),
            .widthPx = spreadOf(widths).median,
            .truthWidthPx = spreadOf(truthWidths).median,
            .ratio = spreadOf(ratios).median};
}

}  // namespace demo

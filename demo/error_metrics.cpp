// SPDX-License-Identifier: MIT
#include "demo/error_metrics.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "renderer/shader_math.h"

namespace demo {

VisibilityError compareVisibility(const renderer::FloatImage& image,
                                  const renderer::FloatImage& reference) {
    if (image.width != reference.width || image.height != reference.height ||
        image.channels != reference.channels)
        throw std::invalid_argument(
            "visibility error: image is " + std::to_string(image.width) + " x " +
            std::to_string(image.height) + ", reference " + std::to_string(reference.width) +
            " x " + std::to_string(reference.height) + "; they must be of one size");
    std::vector<double> sizes;
    double sum = 0;
    double squares = 0;
    for (std::size_t i = 0; i < image.values.size(); ++i) {
        const double difference =
            static_cast<double>(image.values[i]) - static_cast<double>(reference.values[i]);
        const bool counts = renderer::f32::inPenumbra(image.values[i]) ||
                            renderer::f32::inPenumbra(reference.values[i]) ||
                            !(std::abs(difference) <= renderer::f64::kVisibleShare);
        if (!counts) continue;
        sum += difference;
        squares += difference * difference;
        // A NaN must show in every figure, and has no place in an order.
        sizes.push_back(std::isnan(difference) ? INFINITY : std::abs(difference));
    }
    if (sizes.empty()) return {};
    std::sort(sizes.begin(), sizes.end());
    const auto count = static_cast<double>(sizes.size());
    const auto shareBeyond = [&](double limit) {
        return static_cast<double>(sizes.end() -
                                   std::upper_bound(sizes.begin(), sizes.end(), limit)) /
               count;
    };
    return {.penumbraPixels = sizes.size(),
            .rmse = std::sqrt(squares / count),
            .most = sizes.back(),
            .p95 = sizes[static_cast<std::size_t>(std::ceil(0.95 * count)) - 1],
            .bias = sum / count,
            .shareBeyondLevel = shareBeyond(1.0 / 255),
            .shareBeyond2Percent = shareBeyond(0.02),
            .shareBeyond5Percent = shareBeyond(0.05)};
}

}  // namespace demo

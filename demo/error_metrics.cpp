// SPDX-License-Identifier: MIT
#include "demo/error_metrics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/quality/qualityssim.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "renderer/shader_math.h"

namespace demo {
namespace {

void throwUnlessAlike(const renderer::FloatImage& image, const renderer::FloatImage& reference) {
    if (image.width != reference.width || image.height != reference.height ||
        image.channels != reference.channels)
        throw std::invalid_argument(
            "visibility error: image is " + std::to_string(image.width) + " x " +
            std::to_string(image.height) + ", reference " + std::to_string(reference.width) +
            " x " + std::to_string(reference.height) + "; they must be of one size");
}

/// As 8-bit codes without their rounding: the metric's constants are those of codes.
cv::Mat codes(const renderer::FloatImage& image) {
    cv::Mat all(image.height, image.width, CV_32F);
    std::transform(image.values.begin(), image.values.end(), all.begin<float>(),
                   [](float value) { return 255 * value; });
    return all;
}

}  // namespace

VisibilityError compareVisibility(const renderer::FloatImage& image,
                                  const renderer::FloatImage& reference) {
    throwUnlessAlike(image, reference);
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

double temporalError(const FramePair& frames) {
    throwUnlessAlike(frames.before, frames.now);
    throwUnlessAlike(frames.truthBefore, frames.before);
    throwUnlessAlike(frames.truthNow, frames.now);
    double squares = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < frames.now.values.size(); ++i) {
        const std::array<float, 4> values = {frames.before.values[i], frames.now.values[i],
                                             frames.truthBefore.values[i],
                                             frames.truthNow.values[i]};
        const double change = (static_cast<double>(values[1]) - static_cast<double>(values[0])) -
                              (static_cast<double>(values[3]) - static_cast<double>(values[2]));
        if (std::none_of(values.begin(), values.end(), renderer::f32::inPenumbra) &&
            std::abs(change) <= renderer::f64::kVisibleShare)
            continue;
        squares += change * change;
        ++count;
    }
    return count == 0 ? 0 : std::sqrt(squares / static_cast<double>(count));
}

double structuralSimilarity(const renderer::FloatImage& image,
                            const renderer::FloatImage& reference) {
    throwUnlessAlike(image, reference);
    return cv::quality::QualitySSIM::compute(codes(image), codes(reference), cv::noArray())[0];
}

}  // namespace demo

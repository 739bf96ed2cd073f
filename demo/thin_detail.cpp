// SPDX-License-Identifier: MIT
#include "demo/thin_detail.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>

#include "demo/map_places.h"

namespace demo {
namespace {

// Finer maps are taken to half their size, nearest caster of four, until they have no more texels
// along an edge: the width that counts is the kernel's.
constexpr int kMostEdge = 1024;
// Casters are told from what is behind them by this share of the depth range; chosen by eye, above
// the depth steps of curved surfaces under a kernel.
constexpr float kLeastStep = 0.01F;

cv::Mat nearestOfFour(const cv::Mat& depths) {
    cv::Mat half(depths.rows / 2, depths.cols / 2, CV_32F);
    for (int y = 0; y < half.rows; ++y)
        for (int x = 0; x < half.cols; ++x)
            half.at<float>(y, x) = std::min(
                std::min(depths.at<float>(2 * y, 2 * x), depths.at<float>(2 * y, 2 * x + 1)),
                std::min(depths.at<float>(2 * y + 1, 2 * x),
                         depths.at<float>(2 * y + 1, 2 * x + 1)));
    return half;
}

cv::Mat discOf(double radiusTexels) {
    const int reach = std::max(1, static_cast<int>(std::ceil(radiusTexels)));
    return cv::getStructuringElement(cv::MORPH_RECT, {2 * reach + 1, 2 * reach + 1});
}

}  // namespace

std::vector<bool> behindThinCasters(const renderer::FloatImage& depths,
                                    const renderer::FloatImage& places, double radiusUv) {
    // OpenCV does not write to it.
    cv::Mat map(depths.height, depths.width, CV_32F, const_cast<float*>(depths.values.data()));
    while (map.rows > kMostEdge && map.rows % 2 == 0) map = nearestOfFour(map);
    const double radius = radiusUv * map.rows;

    // Closing fills what is nearer to the light than its surroundings and narrower than the kernel.
    cv::Mat closed;
    cv::morphologyEx(map, closed, cv::MORPH_CLOSE, discOf(radius), {-1, -1}, 1,
                     cv::BORDER_REPLICATE);
    cv::Mat thin = cv::Mat::ones(map.size(), CV_32F);
    map.copyTo(thin, closed - map > kLeastStep);
    cv::erode(thin, thin, discOf(radius));  // the nearest thin caster under the kernel

    const std::size_t pixels =
        static_cast<std::size_t>(places.width) * static_cast<std::size_t>(places.height);
    std::vector<bool> behind(pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
        const float* const place = &places.values[4 * i];
        if (place[kPlaceIsSurface] == 0) continue;
        const float edge = static_cast<float>(map.rows);
        const float u = place[kPlaceU] * edge;
        const float v = place[kPlaceV] * edge;
        if (!(u >= 0 && v >= 0 && u < edge && v < edge)) continue;
        behind[i] = thin.at<float>(static_cast<int>(v), static_cast<int>(u)) <
                    place[kPlaceDepth] - kLeastStep;
    }
    return behind;
}

ThinDetail thinDetail(const renderer::FloatImage& image, const renderer::FloatImage& truth,
                      const std::vector<bool>& thin) {
    if (image.values.size() != truth.values.size() || image.values.size() != thin.size())
        throw std::invalid_argument("thin detail: image has " +
                                    std::to_string(image.values.size()) + " pixels, truth " +
                                    std::to_string(truth.values.size()) + ", the mask " +
                                    std::to_string(thin.size()) + "; they must be of one size");
    ThinDetail detail;
    double squares = 0;
    double light = 0;
    double shadow = 0;
    for (std::size_t i = 0; i < thin.size(); ++i) {
        if (!thin[i]) continue;
        const double error =
            static_cast<double>(image.values[i]) - static_cast<double>(truth.values[i]);
        ++detail.pixels;
        squares += error * error;
        light += error;
        shadow += 1 - static_cast<double>(truth.values[i]);
    }
    if (detail.pixels > 0) detail.rmse = std::sqrt(squares / static_cast<double>(detail.pixels));
    if (shadow > 0) detail.lost = light / shadow;
    return detail;
}

}  // namespace demo

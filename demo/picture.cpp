// SPDX-License-Identifier: MIT
#include "demo/picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "records/whole_file.h"

namespace demo {
namespace {

double linearOf(std::uint8_t code) {
    static const auto table = [] {
        std::array<double, 256> values{};
        for (std::size_t i = 0; i < values.size(); ++i) {
            const double c = static_cast<double>(i) / 255;
            values[i] = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
        }
        return values;
    }();
    return table[code];
}

std::uint8_t codeOf(double linear) {
    const double c =
        linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(c, 0.0, 1.0)));
}

}  // namespace

renderer::ByteImage averagedInLight(const renderer::ByteImage& image, int block) {
    if (block < 1 || image.width % block != 0 || image.height % block != 0)
        throw std::invalid_argument("averaging: " + std::to_string(image.width) + " x " +
                                    std::to_string(image.height) + " px do not divide by " +
                                    std::to_string(block));
    if (block == 1) return image;
    renderer::ByteImage result(image.width / block, image.height / block, image.channels);
    for (int y = 0; y < result.height; ++y)
        for (int x = 0; x < result.width; ++x)
            for (int channel = 0; channel < image.channels; ++channel) {
                double sum = 0;
                for (int j = 0; j < block; ++j)
                    for (int i = 0; i < block; ++i)
                        sum += linearOf(image.at(x * block + i, y * block + j, channel));
                result.at(x, y, channel) = codeOf(sum / (block * block));
            }
    return result;
}

void writePng(const std::filesystem::path& file, const renderer::ByteImage& image) {
    renderer::ByteImage copy = image;
    cv::Mat codes(copy.height, copy.width, CV_8UC(copy.channels), copy.values.data());
    if (copy.channels == 3) cv::cvtColor(codes, codes, cv::COLOR_RGB2BGR);
    std::vector<unsigned char> bytes;
    if (!cv::imencode(".png", codes, bytes))
        throw std::runtime_error(file.string() + ": picture cannot be encoded");
    records::writeWholeFile(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

renderer::ByteImage enlarged(const renderer::ByteImage& image, Part part, int scale) {
    part.width = std::min(part.width, image.width);
    part.height = std::min(part.height, image.height);
    part.x = std::clamp(part.x, 0, image.width - part.width);
    part.y = std::clamp(part.y, 0, image.height - part.height);
    renderer::ByteImage result(part.width * scale, part.height * scale, image.channels);
    for (int y = 0; y < result.height; ++y)
        for (int x = 0; x < result.width; ++x)
            for (int channel = 0; channel < image.channels; ++channel)
                result.at(x, y, channel) =
                    image.at(part.x + x / scale, part.y + y / scale, channel);
    return result;
}

Part worstPart(const renderer::FloatImage& image, const renderer::FloatImage& reference, int width,
               int height) {
    width = std::min(width, image.width);
    height = std::min(height, image.height);
    std::vector<double> squares(image.values.size());
    for (std::size_t i = 0; i < squares.size(); ++i) {
        const double d =
            static_cast<double>(image.values[i]) - static_cast<double>(reference.values[i]);
        squares[i] = d * d;
    }
    Part worst{0, 0, width, height};
    double most = -1;
    constexpr int kStep = 4;
    for (int y = 0; y + height <= image.height; y += kStep)
        for (int x = 0; x + width <= image.width; x += kStep) {
            double sum = 0;
            for (int j = 0; j < height; j += 2)
                for (int i = 0; i < width; i += 2) sum += squares[image.index(x + i, y + j)];
            if (sum <= most) continue;
            most = sum;
            worst = {x, y, width, height};
        }
    return worst;
}

renderer::ByteImage differencePicture(const renderer::FloatImage& image,
                                      const renderer::FloatImage& reference, double full) {
    constexpr std::array<double, 3> kLeak = {230, 97, 1};  // orange
    constexpr std::array<double, 3> kDark = {30, 80,
                                             160};  // blue; the two differ in brightness and in hue
    renderer::ByteImage result(image.width, image.height, 3);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const double d =
                static_cast<double>(image.at(x, y)) - static_cast<double>(reference.at(x, y));
            const double t = std::min(std::abs(d) / full, 1.0);
            const auto& colour = d > 0 ? kLeak : kDark;
            for (int channel = 0; channel < 3; ++channel)
                result.at(x, y, channel) = static_cast<std::uint8_t>(
                    std::lround(255 + t * (colour[static_cast<std::size_t>(channel)] - 255)));
        }
    return result;
}

renderer::ByteImage differenceLegend(double full) {
    constexpr int kWidth = 400, kBar = 20, kHeight = 44, kMargin = 4;
    renderer::FloatImage ramp(kWidth, kBar);
    for (int y = 0; y < kBar; ++y)
        for (int x = 0; x < kWidth; ++x)
            ramp.at(x, y) = static_cast<float>(full * (2.0 * x / (kWidth - 1) - 1));
    const renderer::ByteImage bar =
        differencePicture(ramp, renderer::FloatImage(kWidth, kBar), full);
    renderer::ByteImage legend(kWidth, kHeight, 3);
    std::fill(legend.values.begin(), legend.values.end(), std::uint8_t{255});
    std::copy(bar.values.begin(), bar.values.end(), legend.values.begin());
    cv::Mat canvas(kHeight, kWidth, CV_8UC3, legend.values.data());
    for (const double share : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
        char text[24];
        std::snprintf(text, sizeof text, share == 0 ? "%.3g" : "%+.3g", share * full);
        const cv::Size size = cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, 0.45, 1, nullptr);
        const int middle = static_cast<int>(0.5 * (1 + share) * (kWidth - 1));
        const int left =
            std::clamp(middle - size.width / 2, kMargin, kWidth - kMargin - size.width);
        cv::putText(canvas, text, {left, kHeight - 2 * kMargin}, cv::FONT_HERSHEY_SIMPLEX, 0.45,
                    {0, 0, 0}, 1, cv::LINE_AA);
    }
    return legend;
}

}  // namespace demo

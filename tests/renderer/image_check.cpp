// SPDX-License-Identifier: MIT
#include "tests/renderer/image_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/project_folders.h"

namespace tests {
namespace {

void save(const std::filesystem::path& file, renderer::FloatImage image, double scale,
          double offset) {
    cv::Mat bytes;
    cv::Mat(image.height, image.width, CV_32F, image.values.data())
        .convertTo(bytes, CV_8U, 255 * scale, 255 * offset);
    cv::imwrite(file.string(), bytes);
}

}  // namespace

void expectImagesAgree(const std::string& name, const renderer::FloatImage& rendered,
                       const renderer::FloatImage& expected, const ImageLimits& limits) {
    ASSERT_EQ(rendered.values.size(), expected.values.size()) << name;
    renderer::FloatImage difference = rendered;
    double most = 0;
    std::size_t beyond = 0;
    for (std::size_t i = 0; i < difference.values.size(); ++i) {
        difference.values[i] -= expected.values[i];
        const double size = std::abs(static_cast<double>(difference.values[i]));
        most = std::isfinite(size) ? std::max(most, size) : INFINITY;
        if (!(size <= limits.often)) ++beyond;
    }
    const double share =
        static_cast<double>(beyond) / static_cast<double>(difference.values.size());
    if (most <= limits.most && share <= limits.shareBeyondOften) return;
    const std::filesystem::path folder = programFolder().parent_path() / "failed_images";
    std::filesystem::create_directories(folder);
    save(folder / (name + "_rendered.png"), rendered, 1, 0);
    save(folder / (name + "_expected.png"), expected, 1, 0);
    save(folder / (name + "_difference.png"), difference, 10, 0.5);
    ADD_FAILURE() << name << ": largest difference " << most << " (may be " << limits.most
                  << "), share beyond " << limits.often << " " << share << " (may be "
                  << limits.shareBeyondOften << "); see " << (folder / (name + "_*.png")).string();
}

}  // namespace tests

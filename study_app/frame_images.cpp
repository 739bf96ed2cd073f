// SPDX-License-Identifier: MIT
#include "study_app/frame_images.h"

#include <stb_image.h>

#include <memory>
#include <stdexcept>
#include <string>

#include "stimulus/silhouette.h"

namespace study_app {
namespace {

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& sentence) {
    throw std::runtime_error(file.string() + ": " + sentence);
}

}  // namespace

int frameEdgePx(const std::filesystem::path& file) {
    if (!std::filesystem::is_regular_file(file)) fail(file, "no such file");
    int width = 0, height = 0, channels = 0;
    if (stbi_info(file.c_str(), &width, &height, &channels) == 0) {
        fail(file, "cannot be read as a picture: must be an 8-bit grey PNG");
    }
    if (channels != 1 || stbi_is_16_bit(file.c_str()) != 0) {
        fail(file, (channels != 1 ? std::to_string(channels) + " channels" : "16 bits") +
                       ": must be 8-bit grey: its codes go to the screen as they are");
    }
    if (width != height) {
        fail(file, std::to_string(width) + " x " + std::to_string(height) +
                       " px: must be square, as two of them stand side by side");
    }
    if (width < 16 || width > stimulus::kMaxWindowPx) {
        fail(file, std::to_string(width) + " px: must be 16 to " +
                       std::to_string(stimulus::kMaxWindowPx) + " px wide");
    }
    return width;
}

cv::Mat readFrame(const std::filesystem::path& file, int edgePx) {
    if (const int edge = frameEdgePx(file); edge != edgePx) {
        fail(file, std::to_string(edge) + " px: must be " + std::to_string(edgePx) +
                       " px wide, as the design's first frame");
    }
    int width = 0, height = 0, channels = 0;
    const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> codes(
        stbi_load(file.c_str(), &width, &height, &channels, 1), &stbi_image_free);
    if (!codes) fail(file, std::string("cannot be decoded: ") + stbi_failure_reason());
    return cv::Mat(height, width, CV_8UC1, codes.get()).clone();
}

}  // namespace study_app

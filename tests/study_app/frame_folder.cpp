// SPDX-License-Identifier: MIT
#include "tests/study_app/frame_folder.h"

#include <stb_image_write.h>

#include <stdexcept>

namespace tests {

std::vector<records::FramePair> writeFrameFolder(const std::filesystem::path& folder,
                                                 const std::vector<double>& ratios) {
    std::filesystem::create_directories(folder);
    writePicture(folder / "converged.png", kFrameEdgePx, kFrameEdgePx, 1, 200);
    std::vector<records::FramePair> pairs;
    for (const double ratio : ratios) {
        const std::string name = "map" + std::to_string(pairs.size()) + ".png";
        writePicture(folder / name, kFrameEdgePx, kFrameEdgePx, 1, static_cast<int>(pairs.size()));
        pairs.push_back({.artifact = name,
                         .converged = "converged.png",
                         .artifactPx = kFrameRadiusPx / ratio,
                         .radiusPx = kFrameRadiusPx,
                         .scene = "yard",
                         .technique = "pcf_disc"});
    }
    records::writeFrameManifest(folder, {.context = {}, .pairs = pairs});
    return pairs;
}

void writePicture(const std::filesystem::path& file, int width, int height, int channels,
                  int first) {
    std::vector<unsigned char> codes;
    for (int i = 0; i < width * height * channels; ++i) {
        codes.push_back(static_cast<unsigned char>((first + i) % 251));
    }
    if (stbi_write_png(file.c_str(), width, height, channels, codes.data(), width * channels) == 0)
        throw std::runtime_error(file.string() + ": cannot be written");
}

}  // namespace tests

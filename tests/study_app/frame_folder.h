// SPDX-License-Identifier: MIT
// A folder of frames as shadow_demo writes it, small and with made-up pictures.
#pragma once

#include <filesystem>
#include <vector>

#include "records/frame_manifest.h"

namespace tests {

inline constexpr int kFrameEdgePx = 48;
inline constexpr double kFrameRadiusPx = 24;

/// One pair for each r / a; every picture has codes of its own. Returns the list.
std::vector<records::FramePair> writeFrameFolder(const std::filesystem::path& folder,
                                                 const std::vector<double>& ratios);

/// A PNG with `channels` of ramps that begin at `first`.
void writePicture(const std::filesystem::path& file, int width, int height, int channels,
                  int first);

}  // namespace tests

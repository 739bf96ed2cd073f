// SPDX-License-Identifier: MIT
// The pictures of a frames design (records/frame_manifest.h): found and measured when the design is
// read, decoded when a trial shows them.
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>

namespace study_app {

/// Edge of a square 8-bit grey PNG, from its header alone. Throws std::runtime_error with the file,
/// what it is and what it must be.
int frameEdgePx(const std::filesystem::path& file);

/// Its codes, CV_8UC1. Throws as above, and where the edge is another one.
cv::Mat readFrame(const std::filesystem::path& file, int edgePx);

}  // namespace study_app

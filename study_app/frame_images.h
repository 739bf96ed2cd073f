// SPDX-License-Identifier: MIT
// The pictures of a frames design (records/frame_manifest.h): found and measured when the design is
// read, decoded when a trial shows them. A session stores what they were: another picture of the
// same name is not shown in its place.
#pragma once

#include <filesystem>
#include <map>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "study_app/design.h"

namespace study_app {

/// Edge of the square 8-bit grey PNGs of a list. Throws std::runtime_error with the file, what it
/// is and what it must be, where one is something else or not as wide as the first.
int frameEdgePx(const std::filesystem::path& folder, const std::vector<records::FramePair>& pairs);

/// Of every picture of a list, by name.
std::map<std::string, std::string> frameChecksums(const std::filesystem::path& folder,
                                                  const std::vector<records::FramePair>& pairs);

/// The codes of a picture, CV_8UC1. Throws as above, and where it is not the one of the set.
cv::Mat readFrame(const FrameSet& frames, const std::string& name, int edgePx);

/// Throws where any of the set's pictures is missing or another one.
void requireFrames(const FrameSet& frames);

}  // namespace study_app

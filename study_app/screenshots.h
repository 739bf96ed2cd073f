// SPDX-License-Identifier: MIT
// A picture of every screen, once each, in a folder: for looking at what people will see.
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <set>
#include <string>

#include "study_app/app_state.h"

namespace study_app {

class Screenshots {
  public:
    /// An empty folder: no pictures.
    explicit Screenshots(std::filesystem::path folder) : folder_(std::move(folder)) {}

    /// Whether this screen has no picture yet.
    bool wanted(const std::string& name) const {
        return !folder_.empty() && !taken_.contains(name);
    }
    /// Writes <name>.png of a frame (CV_8UC3, BGR). Throws std::runtime_error.
    void take(const std::string& name, const cv::Mat& frame);

  private:
    std::filesystem::path folder_;
    std::set<std::string> taken_;
};

/// "trials-fixation": the screen with what tells its states apart.
std::string pictureName(const AppState& state, double now);

}  // namespace study_app

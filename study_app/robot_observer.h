// SPDX-License-Identifier: MIT
// An observer that knows nothing but the pixels of the frame on screen: it checks the whole path
// from a design to a threshold, drawing and reading back included.
//
// It finds the panels as what is not background, follows the contours of equal code through each of
// them and measures how far they are from straight: the largest second difference of a contour over
// kBaselinePx, px. That is the wavering that Kreuzer's Fig. 2 shows in false colour. A pair is
// answered for the less straight panel where the difference exceeds kNoticeablePx, else by a coin.
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <random>
#include <vector>

#include "study_app/session_runner.h"

namespace study_app {

inline constexpr int kBaselinePx = 12;
/// Above the noise of 8-bit codes on ramps of up to 200 px; chosen by eye.
inline constexpr double kNoticeablePx = 0.5;

/// The panels of a frame (CV_8UC3) from left to right: what is not the colour of its corner, apart
/// from narrow things such as text.
std::vector<cv::Mat> findPanels(const cv::Mat& frame);

/// Largest bend of the contours of a panel (CV_8UC1), px; 0 where it has none to follow.
double contourBend(const cv::Mat& codes);

/// The answer to a frame: two panels are a pair, one is a yes/no question.
Side robotAnswer(const cv::Mat& frame, std::mt19937_64& rng);

/// The robot in front of the window: looks at a frame, and presses a while later.
class RobotObserver {
  public:
    /// It answers that long after it saw the stimulus, s.
    explicit RobotObserver(double answerS) : answerS_(answerS) {}

    void look(const cv::Mat& frame, double now);
    /// What it decided on, once its time has come.
    std::optional<Side> press(double now);
    /// Until then; nothing where it has not seen anything to answer.
    std::optional<double> secondsUntilPress(double now) const;

  private:
    double answerS_;
    std::mt19937_64 coin_{1};
    std::optional<Side> decided_;
    double due_ = 0;
};

}  // namespace study_app

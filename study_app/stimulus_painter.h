// SPDX-License-Identifier: MIT
// Puts 8-bit codes on the screen, pixel for pixel: each framebuffer pixel fetches its own texel,
// without sampling or scaling, at an integer position. Needs a current OpenGL 3.3 context.
#pragma once

#include <opencv2/core.hpp>

namespace study_app {

class StimulusPainter {
  public:
    /// Throws std::runtime_error with the driver's log where the shader does not compile.
    StimulusPainter();
    ~StimulusPainter();
    StimulusPainter(const StimulusPainter&) = delete;
    StimulusPainter& operator=(const StimulusPainter&) = delete;

    /// Draws a CV_8UC1 image with its top left pixel at (x, y); what lies outside the framebuffer
    /// is cut.
    void draw(const cv::Mat& codes, int x, int y, int framebufferHeightPx);

  private:
    unsigned program_ = 0, texture_ = 0, vertexArray_ = 0;
    int originLocation_ = -1;
};

/// Throws std::runtime_error where a frame that was read back (CV_8UC3) holds another colour than
/// these codes at (x, y), naming pixel, code and colour. What lies outside the frame is not looked
/// at.
void requireShown(const cv::Mat& frame, const cv::Mat& codes, int x, int y);

}  // namespace study_app

// SPDX-License-Identifier: MIT
// The images that observers see: an edge with the artifact, and the same edge without it, as 8-bit
// codes that go to the screen pixel for pixel.
//
//   const StimulusOptions stimulus{.silhouette = {.pattern = Pattern::step, .artifactPx = 10},
//                                  .kernel = {KernelShape::disc, 35}};
//   cv::Mat artifact = artifactImage(stimulus), straight = straightImage(stimulus);
//
// Pixels are the closed form at the pixel's centre (filtered_edge.h), to the last bit: one period
// is evaluated and copied where the pattern repeats, and roving moves, turns and mirrors the same
// values. What is random (turned taps, noise, dither) follows from the seed, pixel by pixel, and
// turns with the image. The origin of the silhouette lies at the corner below and left of the
// middle pixel (even windows: in the middle). Row 0 is on top.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>

#include "stimulus/display_code.h"
#include "stimulus/filtered_edge.h"
#include "stimulus/kernel.h"
#include "stimulus/silhouette.h"
#include "stimulus/tap_kernel.h"

namespace stimulus {

/// What varies from trial to trial so that tilt or offset cannot give the answer away, applied in
/// this order. The caller draws it: whole-pixel shifts within +-a/2, quarter turns, mirror, and for
/// the step in 2AFC the straight panel's tilt uniform in +-atan(a/L).
struct Roving {
    std::optional<double> straightTiltDeg{};  ///< straight image: the edge's angle, in (-45, 45)
    int shiftPx = 0;                          ///< upwards, within +-windowPx
    bool mirror = false;                      ///< left and right exchanged
    int quarterTurns = 0;                     ///< counter-clockwise, 0..3
};

struct StimulusOptions {
    SilhouetteOptions silhouette{};
    Kernel kernel{};
    int windowPx = 600;   ///< edge of the square image, 1..kMaxWindowPx
    double litLevel = 1;  ///< share of full white on the lit side, in [0, 1]
    Encoding encoding = Encoding::srgb;
    Roving roving{};
    /// In place of the kernel, which must then be a disc and gives the radius: turned taps.
    std::optional<TapKernel> taps{};
    double noiseLevels = 0;  ///< sd of normal noise added to each code before rounding, [0, 255]
    bool dither = false;     ///< random instead of half-up rounding of codes
    std::uint64_t seed = 0;  ///< of taps, noise and dither; each image has its own for each of them
};

/// 8-bit codes, CV_8UC1. Throws std::invalid_argument that names the value and the rule; a kernel
/// that spans more than 20,000 texels is refused. Codes with noise are held within 0..255, as on
/// any display: on full black and white half of the noise is lost.
cv::Mat artifactImage(const StimulusOptions& options);
cv::Mat straightImage(const StimulusOptions& options);

/// V itself, CV_64FC1, before encoding, lit level, noise and dither; roved likewise.
cv::Mat artifactVisibilityImage(const StimulusOptions& options);
cv::Mat straightVisibilityImage(const StimulusOptions& options);

}  // namespace stimulus

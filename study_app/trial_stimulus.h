// SPDX-License-Identifier: MIT
// From a row of the trial table to the codes on the screen: everything that a row says about its
// stimulus, drawn as stimulus/ computes it. The same row gives the same bits on any day.
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "records/trial_table.h"
#include "study_app/design.h"

namespace study_app {

struct TrialImages {
    cv::Mat left;   ///< CV_8UC1, row 0 on top; the only one in yes/no
    cv::Mat right;  ///< empty in yes/no
    bool operator==(const TrialImages& other) const;
};

/// Throws std::invalid_argument for a row that describes no stimulus of ours (a frame, an unknown
/// kernel, a radius beyond the limits of stimulus/). A straight panel whose tilt is absent or 0
/// stands at the true silhouette's angle.
TrialImages trialImages(const records::Trial& trial, const Design& design);

/// Distance of a click on the image that a row shows from the nearest riser of its artifact, px: a
/// small one tells seeing from guessing where risers are few (step, flat lines). Nothing where no
/// riser of ours is shown: a reference, a rendered frame.
std::optional<double> clickDistancePx(const records::Trial& trial, int windowPx, double clickXPx,
                                      double clickYPx);

}  // namespace study_app

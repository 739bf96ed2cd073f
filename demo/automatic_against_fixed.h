// SPDX-License-Identifier: MIT
// What the automatic size is worth beside a fixed one at the same softness: the speed of what
// `--resolution auto` drew (direct_run.h) over that of the sweep's cells at the fixed size, and how
// wrong the automatic size was there.
#pragma once

#include <string>
#include <vector>

#include "demo/direct_run.h"
#include "demo/sweep_table.h"

namespace demo {

struct AutomaticAgainstFixed {
    std::string technique;
    int fixed = 0;  ///< texels along an edge

    /// Time at the fixed size over that at the automatic one, summed over the frames of a path, by
    /// scene; above 1 the automatic size is faster, NaN where a frame has not both.
    std::vector<double> times;
    double geometricMean = 0;  ///< over the scenes; NaN where one was not measured

    // Of the automatic size, over the frames of all scenes that have a time and whose map is no
    // finer than the reference, against which a finer one is not wrong.
    double worstRmse = 0;
    double rippleP95 = 0;   ///< of the scene in which it is largest; in steps of 1/255
    double rippleMost = 0;  ///< of the worst pixel
    int finerFrames = 0;    ///< that took a map finer than the reference
};

/// One for each technique and fixed size, techniques in the order of the table.
std::vector<AutomaticAgainstFixed> automaticAgainstFixed(const std::vector<DirectRow>& direct,
                                                         const SweepTable& table,
                                                         const std::vector<int>& fixedSizes);

}  // namespace demo

// SPDX-License-Identifier: MIT
// How the automatic size behaves while camera or light move along a scene's path: which sizes, how
// often they change, and how far a change shows in the picture.
#pragma once

#include <vector>

#include "demo/shadow_run.h"
#include "demo/viewer_state.h"

namespace demo {

struct PathSettings {
    ShadowRun::Settings run;  ///< automatic; its radius is replaced by the scene's softness
    Path path = Path::camera;
    int frames = 240;      ///< of which the path is walked
    double share = 1;      ///< of the path, (0, 1]: the speed is share / frames
    int comparedN = 2048;  ///< of the map that shows what the motion itself changes
};

struct SizeOverPath {
    std::vector<int> sizes;               ///< of the sun's map, one for each frame
    int raises = 0, lowerings = 0;        ///< of all maps
    int leastFramesBetweenLowerings = 0;  ///< of one map; 0 for fewer than two of them
    /// All below of the sun's visibility, RMS of its change from one frame to the next, as the
    /// largest ratio to what the motion alone changes in the same two frames; 0 for no such frames.
    /// Where a change of size shows, against the map with comparedN ...
    double worstJump = 0;
    /// ... and against the maps before and after the change, each kept for both frames: a coarser
    /// map's stair-steps move with light and camera, too. The larger of the two.
    double worstJumpOverOwn = 0;
    /// Over all other frames, against the map with comparedN: what the sizes between changes leave.
    double worstBetween = 0;
    double largestArtifactRatio = 0;
};

/// Walks the path after settling at its start. Leaves the frame at the path's end.
SizeOverPath sizeOverPath(renderer::Renderer& frame, const renderer::GlInfo& info,
                          const PathSettings& settings);

}  // namespace demo

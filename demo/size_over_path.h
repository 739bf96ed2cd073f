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
    std::vector<int> sizes;  ///< one for each frame
    int raises = 0, lowerings = 0;
    int leastFramesBetweenLowerings = 0;  ///< 0 for fewer than two of them
    /// Largest, over the frames in which a change of size shows, of RMS change of visibility from
    /// frame to frame over that of the map with comparedN in the same two frames. 0 where nothing
    /// changed.
    double worstJump = 0;
    /// The same over all other frames: what the sizes between changes leave.
    double worstBetween = 0;
    double largestArtifactRatio = 0;
};

/// Walks the path after settling at its start. Leaves the frame at the path's end.
SizeOverPath sizeOverPath(renderer::Renderer& frame, const renderer::GlInfo& info,
                          const PathSettings& settings);

}  // namespace demo

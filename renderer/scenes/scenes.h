// SPDX-License-Identifier: MIT
// The makers behind the table of built-in scenes (scene.h): one file each, or one for scenes that
// share their shapes. Name and source are filled in by the table.
#pragma once

#include "renderer/scene.h"

namespace renderer {

Scene planarOccluder();
Scene yard();
Scene overlappingSpheres();
Scene contactPosts();
Scene foliage();
Scene city();
Scene terrain();
Scene knob();
Scene lamps();

/// Paved ground around the origin that throws no shadow.
SceneObject paving(float halfExtent = 64, int cells = 64);

/// Bounds of everything that casts, down to the ground.
Bounds casterBounds(const std::vector<SceneObject>& objects);

}  // namespace renderer

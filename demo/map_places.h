// SPDX-License-Identifier: MIT
// Where on the light's map every pixel of a frame lies: what connects an image of visibilities with
// the texels that it came from.
#pragma once

#include "renderer/image.h"
#include "renderer/renderer.h"

namespace demo {

/// Channels of the image that mapPlaces() returns.
enum MapPlace { kPlaceU = 0, kPlaceV = 1, kPlaceDepth = 2, kPlaceIsSurface = 3 };

/// Of the last frame: u and v on the map (0..1 inside it), linear light depth, and 1 for a surface,
/// 0 for sky. Waits for the GPU.
renderer::FloatImage mapPlaces(renderer::Renderer& frame);

}  // namespace demo

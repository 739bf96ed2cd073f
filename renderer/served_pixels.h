// SPDX-License-Identifier: MIT
// The part of the screen that a map can matter to: bounds of where the surfaces lie that it serves
// (ViewPart: a cascade's stretch of the view, the quarter of a cube's face, a spot's square). A
// frame draws nothing of a map for the other pixels, and none of a map that serves no pixel: with
// six maps to a point lamp most of each picture is of another map.
#pragma once

#include "renderer/light_views.h"
#include "renderer/scene.h"

namespace renderer {

/// From the lower left corner, as GL counts.
struct PixelRect {
    int x = 0, y = 0, width = 0, height = 0;

    bool empty() const { return width <= 0 || height <= 0; }
    bool operator==(const PixelRect&) const = default;
};

/// Bounds of all pixels that show a point within `surfaces` which the view's map serves; larger by
/// up to two pixels on every side, never smaller. Empty where there is none.
PixelRect servedPixels(const LightView& view, const OrbitCamera& camera, const Bounds& surfaces,
                       int widthPx, int heightPx);

}  // namespace renderer

// SPDX-License-Identifier: MIT
// The map places of a plane that is seen straight along the light: pixels in even steps.
#pragma once

#include "demo/map_places.h"

namespace tests {

/// `pixelUv`: edge of a pixel on the map. The first pixel's centre has uv half a pixel.
inline renderer::FloatImage flatPlaces(int width, int height, double pixelUv) {
    renderer::FloatImage places(width, height, 4);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            places.at(x, y, demo::kPlaceU) = static_cast<float>((x + 0.5) * pixelUv);
            places.at(x, y, demo::kPlaceV) = static_cast<float>((y + 0.5) * pixelUv);
            places.at(x, y, demo::kPlaceDepth) = 0.5F;
            places.at(x, y, demo::kPlaceIsSurface) = 1;
        }
    return places;
}

template <class Value>
renderer::FloatImage imageOf(int width, int height, const Value& value) {
    renderer::FloatImage image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) image.at(x, y) = static_cast<float>(value(x, y));
    return image;
}

}  // namespace tests

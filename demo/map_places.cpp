// SPDX-License-Identifier: MIT
#include "demo/map_places.h"

namespace demo {

renderer::FloatImage mapPlaces(renderer::Renderer& frame) {
    renderer::FloatImage places = frame.readPositions();
    const renderer::f64::real4x4 toMap =
        renderer::toDouble(frame.shadowConstants()).shadowFromEyeRelative;
    for (std::size_t i = 0; i < places.values.size(); i += 4) {
        float* const texel = &places.values[i];
        if (texel[kPlaceIsSurface] == 0) continue;
        const glm::dvec4 place = toMap * glm::dvec4(texel[0], texel[1], texel[2], 1);
        texel[kPlaceU] = static_cast<float>(place.x / place.w);
        texel[kPlaceV] = static_cast<float>(place.y / place.w);
        texel[kPlaceDepth] = static_cast<float>(place.z);
        texel[kPlaceIsSurface] = 1;
    }
    return places;
}

}  // namespace demo

// SPDX-License-Identifier: MIT
// What a renderer sets in the frame in which a shadow map has a certain size: where to draw in its
// texture, and every constant that counts in texels. They change together with the size or the
// first frame after a change is wrong.
#pragma once

#include <cstdint>

namespace resolution_controller {

struct MapConstants {
    /// Draw into texels [0, viewport) of both axes; equal to the size.
    std::int32_t viewport = 0;
    /// Clear texels [0, cleared) of both axes to the far depth, with a scissor (an unscissored
    /// clear of the whole texture costs more than the map): the viewport and a guard band of the
    /// largest filter radius and one texel, which a filter at the map's edge reads as lit. The band
    /// ends at the texture's edge; beyond it, and below 0, a sampler that clamps to a lit border
    /// answers.
    std::int32_t cleared = 0;
    /// Coordinate in the texture = uv on the map x this: viewport over the texture's edge.
    double textureScale = 1;
    double texelUv = 0;  ///< edge of a texel, as a fraction of the map's extent: 1 / size

    /// Kernel, for a filter with one radius (0 for the others): the given radius or minRadiusUv,
    /// whichever is larger, and how many texels on each side of the one at its centre it can touch.
    double radiusUv = 0;
    double radiusTexels = 0;
    std::int32_t kernelReachTexels = 0;

    /// Bias that holds a receiver clear of its own texels: a depth is stored at a texel's centre,
    /// up to half a texel away on each axis, so add planeBiasUv x (|dz/du| + |dz/dv|), z being the
    /// receiver's depth and u, v its place on the map, to the bias of the storage format, ...
    double planeBiasUv = 0;
    /// ... or move it along its normal by this share of the map's extent: half a texel's diagonal.
    double normalOffsetUv = 0;

    bool operator==(const MapConstants&) const = default;
};

/// Constants for a map of `size` texels in a texture with an edge of `textureSize` (0: exactly the
/// map's own). `radiusUv` is the one radius of a filter and 0 where it varies, `largestRadiusUv`
/// the largest that is used. Sizes below 1 give all zeros, radii that are not positive and finite
/// count as 0.
MapConstants constantsFor(std::int32_t size, std::int32_t textureSize, double radiusUv,
                          double largestRadiusUv) noexcept;

}  // namespace resolution_controller

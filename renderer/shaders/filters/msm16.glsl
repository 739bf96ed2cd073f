// SPDX-License-Identifier: MIT
// Moment shadow maps in 16-bit fixed point. Even and odd moments are transformed so that the possible ones fill the
// unit cube better; the transform is affine, so the map is filtered as it is stored.
//
// Source: C. Peters, R. Klein, "Moment shadow mapping", I3D 2015, section 3.3; shared/hamburger.glsl.
// Map: the transformed means of z, z^2, z^3, z^4 under the kernel, z = 2 x linear light depth - 1.
// Parameters: as for msm; bias_depth answers the rounding to 16 bits.

const real kOddFirst = real(0.86602540378443865);    // sqrt(3) / 2
const real kOddThird = real(0.38490017945975051);    // 2 sqrt(3) / 9

SHARED_FUNCTION real4 mapTexel(real depth, real2 slope, int layer, ShadowConstants shadow) {
    real4 b = momentsOfDepth(depth);
    return real4(real(1.5) * b.x - real(2.0) * b.z + real(0.5), real(4.0) * (b.y - b.w),
                 kOddFirst * b.x - kOddThird * b.z + real(0.5), real(0.5) * (b.y + b.w));
}

SHARED_FUNCTION real4 momentsFromStored(real4 stored) {
    real first = stored.x - real(0.5);
    real third = stored.z - real(0.5);
    real determinant = real(2.0) * kOddFirst - real(1.5) * kOddThird;
    return real4((real(2.0) * third - kOddThird * first) / determinant, stored.w + stored.y * real(0.125),
                 (real(1.5) * third - kOddFirst * first) / determinant, stored.w - stored.y * real(0.125));
}

SHARED_FUNCTION real filterVisibility(sampler2DArray map, ShadowReceiver receiver, ShadowConstants shadow) {
    if (!reachesFilteredMap(receiver.uv, shadow)) return real(1.0);
    real depth = biasedDepth(receiver, shadow, PARAMETER_bias_texels, PARAMETER_bias_reaches, PARAMETER_bias_depth);
    real4 moments = momentsFromStored(filteredTexel(map, receiver.uv, 0, shadow));
    return hamburgerVisibility(moments, depth, PARAMETER_moment_bias);
}

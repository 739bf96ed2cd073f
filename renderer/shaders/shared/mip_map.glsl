// SPDX-License-Identifier: MIT
// Mip chains: a texel of a level is the mean of four of the one below, and a lookup goes between levels. L. Williams,
// "Pyramidal parametrics", 1983; for shadows W. Donnelly, A. Lauritzen, "Variance shadow maps", I3D 2006, section 4.
// Needs filtered_map.glsl. In the arithmetic of the shader, since the weights of texture units have 8 bits.

SHARED_FUNCTION int mipLevels(ShadowConstants shadow) { return int(-shadow.prefilter.w); }

// A texel of a level from the one below it.
SHARED_FUNCTION real4 mipTexel(sampler2DArray map, int2 texel, int below) {
    int2 at = texel * 2;
    return (texelFetch(map, int3(at.x, at.y, 0), below) + texelFetch(map, int3(at.x + 1, at.y, 0), below) +
            texelFetch(map, int3(at.x, at.y + 1, 0), below) + texelFetch(map, int3(at.x + 1, at.y + 1, 0), below)) *
           real(0.25);
}

SHARED_FUNCTION real4 bilinearLevel(sampler2DArray map, real2 uv, int level, ShadowConstants shadow) {
    int edge = filteredEdge(shadow);
    real size = real(1.0);
    for (int i = 0; i < level; ++i) {
        edge /= 2;
        size *= real(2.0);
    }
    real last = real(edge - 1);
    real2 place = (uv * shadow.map.x + real2(shadow.prefilter.z)) / size - real2(0.5);
    place = clamp(place, real2(0.0), real2(last));
    int2 low = int2(int(place.x), int(place.y));
    int2 high = int2(min(low.x + 1, int(last)), min(low.y + 1, int(last)));
    real2 part = place - real2(real(low.x), real(low.y));
    return mix(mix(texelFetch(map, int3(low.x, low.y, 0), level), texelFetch(map, int3(high.x, low.y, 0), level), part.x),
               mix(texelFetch(map, int3(low.x, high.y, 0), level), texelFetch(map, int3(high.x, high.y, 0), level), part.x),
               part.y);
}

// Trilinear: a level's texel with its bilinear tent has half the texel's edge as standard deviation, as a disc has half
// its radius. So the level for a disc of `radiusUv` is that of texels of the radius.
SHARED_FUNCTION real4 mipMean(sampler2DArray map, real2 uv, real radiusUv, ShadowConstants shadow) {
    real texels = radiusUv * shadow.map.x;
    real most = real(mipLevels(shadow));
    real level = texels > real(1.0) ? min(log2(texels), most) : real(0.0);
    int lower = int(level);
    return mix(bilinearLevel(map, uv, lower, shadow), bilinearLevel(map, uv, int(min(real(lower + 1), most)), shadow),
               level - real(lower));
}

// How far mipMean reaches from uv: one and a half texels of the coarser of two levels.
SHARED_FUNCTION real mipReachUv(real radiusUv, ShadowConstants shadow) {
    return real(3.0) * radiusUv + real(1.5) * shadow.map.y;
}

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

// Of a level that ends at `last`; beyond it there is nothing in the way, as in the guard band, which the first texel of
// the first level lies in.
SHARED_FUNCTION real4 levelTexel(sampler2DArray map, int column, int row, int last, int level) {
    int2 texel = int2(column, row);
    int2 at = clamp(texel, int2(0, 0), int2(last, last));
    return at == texel ? texelFetch(map, int3(at.x, at.y, 0), level) : texelFetch(map, int3(0, 0, 0), 0);
}

// A level's texels are as large as the kernel or as a pixel, and a pixel may be larger than the guard band is wide: its
// lookups go on beyond the level's edge, or they would find the shadows on the map's edge there.
SHARED_FUNCTION real4 bilinearLevel(sampler2DArray map, real2 uv, int level, ShadowConstants shadow) {
    int edge = filteredEdge(shadow);
    real size = real(1.0);
    for (int i = 0; i < level; ++i) {
        edge /= 2;
        size *= real(2.0);
    }
    int last = edge - 1;
    real2 place = (uv * shadow.map.x + real2(shadow.prefilter.z)) / size - real2(0.5);
    place = clamp(place, real2(-1.0), real2(real(edge)));
    real2 low = floor(place);
    real2 part = place - low;
    int x = int(low.x);
    int y = int(low.y);
    return mix(mix(levelTexel(map, x, y, last, level), levelTexel(map, x + 1, y, last, level), part.x),
               mix(levelTexel(map, x, y + 1, last, level), levelTexel(map, x + 1, y + 1, last, level), part.x), part.y);
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

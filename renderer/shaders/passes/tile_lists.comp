// SPDX-License-Identifier: MIT
// From marked tiles to what each pass of a prefilter has to do. Of the lines the last pass does the tiles that are seen
// and may hold a penumbra; the one before it, whose kernel runs along columns, also those above and below them. The
// texels are needed of the tiles that are seen and of those around them.
layout(local_size_x = 32) in;

layout(std430, binding = 0) readonly buffer Seen { uint seen[]; };
layout(std430, binding = 1) buffer TileLists {
    uvec4 commands[5];  // of an indirect dispatch, in rows of TILES_ACROSS; w tiles in the list
    uint tiles[];       // a list for each of three passes, tilesEdge^2 long
};
layout(std430, binding = 2) readonly buffer Gaps { uint gaps[]; };

layout(location = 0) uniform ivec2 grid;    // tilesEdge, tiles that the kernel reaches to either side
layout(location = 1) uniform ivec2 passes;  // first and last: 0 texels, 1 rows, 2 columns

bool isMarked(int tile, bool line) { return seen[tile] != 0u && (!line || gaps[tile] != 0u); }

bool markedAround(ivec2 tile, ivec2 reach, bool line) {
    ivec2 low = max(tile - reach, ivec2(0)), high = min(tile + reach, ivec2(grid.x - 1));
    for (int y = low.y; y <= high.y; ++y)
        for (int x = low.x; x <= high.x; ++x)
            if (isMarked(y * grid.x + x, line)) return true;
    return false;
}

void main() {
    int id = int(gl_GlobalInvocationID.x);
    if (id >= grid.x * grid.x) return;
    ivec2 tile = ivec2(id % grid.x, id / grid.x);
    for (int pass = passes.x; pass <= passes.y; ++pass) {
        ivec2 reach = ivec2(pass == 0 ? grid.y : 0, pass == 2 ? 0 : grid.y);
        if (!markedAround(tile, reach, pass != 0)) continue;
        uint place = atomicAdd(commands[pass].w, 1u);
        if (place % TILES_ACROSS == 0u) atomicAdd(commands[pass].y, 1u);
        tiles[uint(pass * grid.x * grid.x) + place] = uint(tile.x) | uint(tile.y) << 16;
    }
}

// SPDX-License-Identifier: MIT
// From marked tiles to what each pass of a prefilter has to do: the last one the tiles that are marked; the one before
// it, whose kernel runs along columns, also those above and below them; the first one those around them.
layout(local_size_x = 32) in;

layout(std430, binding = 0) readonly buffer Marks { uint marks[]; };
layout(std430, binding = 1) buffer TileLists {
    uvec4 commands[3];  // of an indirect dispatch, in rows of TILES_ACROSS; w tiles in the list
    uint tiles[];       // a list for each pass, tilesEdge^2 long
};

layout(location = 0) uniform ivec2 grid;  // tilesEdge, tiles that the kernel reaches to either side

bool markedAround(ivec2 tile, ivec2 reach) {
    ivec2 low = max(tile - reach, ivec2(0)), high = min(tile + reach, ivec2(grid.x - 1));
    for (int y = low.y; y <= high.y; ++y)
        for (int x = low.x; x <= high.x; ++x)
            if (marks[y * grid.x + x] != 0u) return true;
    return false;
}

void main() {
    int id = int(gl_GlobalInvocationID.x);
    if (id >= grid.x * grid.x) return;
    ivec2 tile = ivec2(id % grid.x, id / grid.x);
    for (int pass = 0; pass < 3; ++pass) {
        ivec2 reach = ivec2(pass == 0 ? grid.y : 0, pass == 2 ? 0 : grid.y);
        if (!markedAround(tile, reach)) continue;
        uint place = atomicAdd(commands[pass].w, 1u);
        if (place % TILES_ACROSS == 0u) atomicAdd(commands[pass].y, 1u);
        tiles[uint(pass * grid.x * grid.x) + place] = uint(tile.x) | uint(tile.y) << 16;
    }
}

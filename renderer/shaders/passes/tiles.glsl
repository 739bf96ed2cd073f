// SPDX-License-Identifier: MIT
// Which TILE x TILE texels of the map a group of a prefilter's pass does where not all of them are done: one of a list
// (filter_tiles.h).

layout(std430, binding = 1) readonly buffer TileLists {
    uvec4 commands[5];  // of an indirect dispatch; w tiles in the list
    uint tiles[];       // x, y in 16 bits each
};

layout(location = 1) uniform ivec2 list;  // which command, and where its list begins

ivec2 tileCorner() {
    uint place = gl_WorkGroupID.y * TILES_ACROSS + gl_WorkGroupID.x;
    if (place >= commands[list.x].w) return ivec2(1 << 20);  // the last row is not full: outside the map
    uint tile = tiles[uint(list.y) + place];
    return ivec2(tile & 0xffffu, tile >> 16) * TILE;
}

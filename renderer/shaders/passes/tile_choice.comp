// SPDX-License-Identifier: MIT
// Whether a pass along lines does its list of tiles or the whole map, which takes less time for a texel.
layout(local_size_x = 2) in;

layout(std430, binding = 1) buffer TileLists {
    uvec4 commands[5];  // of indirect dispatches: the lists of texels, rows and columns, then whole rows and columns
    uint tiles[];
};

layout(location = 0) uniform uint most;  // tiles from which on the whole map is the faster

void main() {
    uint listed = 1u + gl_LocalInvocationID.x;
    if (commands[listed].w < most)
        commands[listed + 2u].y = 0u;
    else
        commands[listed].y = 0u;
}

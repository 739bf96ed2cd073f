// SPDX-License-Identifier: MIT
// The depth range cut into layers, each a range of its own from 0 to 1: what lies before a layer is 0 in it, what lies
// behind it 1. A. Lauritzen, M. McCool, "Layered variance shadow maps", GI 2008. The cuts lie where layer_placement.h
// puts them. Needs constants.glsl.

SHARED_FUNCTION real layerEnd(int layer, ShadowConstants shadow) { return shadow.layerEnds[layer / 4][layer % 4]; }

SHARED_FUNCTION real depthInLayer(real depth, int layer, ShadowConstants shadow) {
    real begin = layer == 0 ? real(0.0) : layerEnd(layer - 1, shadow);
    return clamp((depth - begin) / (layerEnd(layer, shadow) - begin), real(0.0), real(1.0));
}

// Of so many layers the one that holds a depth. On a boundary it is the one nearer to the light, where the depth is 1:
// in the other one it would be 0, before everything.
SHARED_FUNCTION int layerOf(real depth, int layers, ShadowConstants shadow) {
    int layer = 0;
    while (layer < layers - 1 && depth > layerEnd(layer, shadow)) ++layer;
    return layer;
}

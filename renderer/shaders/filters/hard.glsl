// SPDX-License-Identifier: MIT
// Hard shadows: one compare with the nearest texel.
//
// Source: L. Williams, "Casting curved shadows on curved surfaces", SIGGRAPH 1978.
// Map: linear light depth, 0 near. Reads one texel. The kernel radius is ignored.
// Parameter: bias_texels (shared/depth_compare.glsl).

SHARED_FUNCTION real filterVisibility(sampler2D map, ShadowReceiver receiver, ShadowConstants shadow) {
    return texelVisibility(map, receiver.uv, shadow, planeCompare(receiver, shadow, PARAMETER_bias_texels));
}

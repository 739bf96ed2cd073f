// SPDX-License-Identifier: MIT
// Layered variance shadow maps: the depth range is cut into layers, each with the moments of the depths clamped to it,
// so that occluders outside the receiver's layer bleed no light into it. The result is the least of the bounds of the
// receiver's layer and of those before it.
//
// Source: A. Lauritzen, M. McCool, "Layered variance shadow maps", GI 2008; where the layers lie:
// shared/depth_layers.glsl.
// Map: for each layer the mean and mean square of the depth in it under the kernel; two layers of depth to a layer of
// the texture.
// Parameters: bias_texels, bias_reaches (shared/filtered_map.glsl: a sloped plane that crosses a boundary would darken
// before it); gaussian (prefilter.h); layers, layer_deviation (layer_placement.h); least_variance, bleeding as for vsm,
// in the depth of a layer.

SHARED_FUNCTION real4 mapTexel(real depth, real2 slope, int layer, ShadowConstants shadow) {
    int layers = int(PARAMETER_layers);
    real first = depthInLayer(depth, 2 * layer, shadow);
    real second = 2 * layer + 1 < layers ? depthInLayer(depth, 2 * layer + 1, shadow) : real(1.0);
    return real4(first, first * first, second, second * second);
}

SHARED_FUNCTION real filterVisibility(sampler2DArray map, ShadowReceiver receiver, ShadowConstants shadow) {
    if (!reachesFilteredMap(receiver.uv, shadow)) return real(1.0);
    real depth = biasedDepth(receiver, shadow, PARAMETER_bias_texels, PARAMETER_bias_reaches, real(0.0));
    if (!(depth > real(0.0))) return real(1.0);
    int last = layerOf(depth, int(PARAMETER_layers), shadow);
    // The layers before the receiver's bound the light too. Its own alone lets light through just behind a boundary.
    real bound = real(1.0);
    for (int layer = 0; layer <= last; layer += 2) {
        real4 moments = filteredTexel(map, receiver.uv, layer / 2, shadow);
        bound = min(bound, chebyshevBound(moments.x, moments.y, depthInLayer(depth, layer, shadow),
                                          PARAMETER_least_variance));
        if (layer < last)
            bound = min(bound, chebyshevBound(moments.z, moments.w, depthInLayer(depth, layer + 1, shadow),
                                              PARAMETER_least_variance));
    }
    return withoutBleeding(bound, PARAMETER_bleeding);
}

// SPDX-License-Identifier: MIT
// Layered variance shadow maps: the depth range is cut into layers, each with the moments of the depths clamped to it,
// so that occluders outside the receiver's layer bleed no light into it. The result is the least of the bounds of the
// receiver's layer and of those before it.
//
// Source: A. Lauritzen, M. McCool, "Layered variance shadow maps", GI 2008. The layers here are equal shares of the
// range.
// Map: for each layer the mean and mean square of clamp((z - p_i) / (p_i+1 - p_i)) under the kernel, z linear light
// depth, 0 near; two layers of depth to a layer of the texture.
// Parameters: bias_texels, bias_reaches (shared/filtered_map.glsl: a sloped plane that crosses a boundary would darken
// before it); gaussian (prefilter.h); layers; least_variance, bleeding as for vsm, in the warped depth of a layer.

SHARED_FUNCTION real layerDepth(real depth, int layer, int layers) {
    return clamp(depth * real(layers) - real(layer), real(0.0), real(1.0));
}

SHARED_FUNCTION real4 mapTexel(real depth, real2 slope, int layer, ShadowConstants shadow) {
    int layers = int(PARAMETER_layers);
    real first = layerDepth(depth, 2 * layer, layers);
    real second = layerDepth(depth, 2 * layer + 1, layers);
    return real4(first, first * first, second, second * second);
}

SHARED_FUNCTION real filterVisibility(sampler2DArray map, ShadowReceiver receiver, ShadowConstants shadow) {
    if (!reachesFilteredMap(receiver.uv, shadow)) return real(1.0);
    real depth = biasedDepth(receiver, shadow, PARAMETER_bias_texels, PARAMETER_bias_reaches, real(0.0));
    if (!(depth > real(0.0))) return real(1.0);
    int layers = int(PARAMETER_layers);
    // A depth on a boundary belongs to the layer nearer to the light, where it is 1: in the other one it would be 0,
    // before everything.
    int last = int(clamp(ceil(depth * real(layers)) - real(1.0), real(0.0), real(layers - 1)));
    // The layers before the receiver's bound the light too. Its own alone lets light through just behind a boundary.
    real bound = real(1.0);
    for (int layer = 0; layer <= last; layer += 2) {
        real4 moments = filteredTexel(map, receiver.uv, layer / 2, shadow);
        bound = min(bound, chebyshevBound(moments.x, moments.y, layerDepth(depth, layer, layers),
                                          PARAMETER_least_variance));
        if (layer < last)
            bound = min(bound, chebyshevBound(moments.z, moments.w, layerDepth(depth, layer + 1, layers),
                                              PARAMETER_least_variance));
    }
    return withoutBleeding(bound, PARAMETER_bleeding);
}

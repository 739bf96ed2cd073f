// SPDX-License-Identifier: MIT
// What one pixel of a finished frame asks of the shadow map. "demand" is the controller's formula, handed in by who
// joins the two. No stair-step of the map can show in the sky, on surfaces turned from the light, outside the map and,
// where the kernel is wider than a pixel, outside penumbrae. A penumbra narrower than a pixel falls between the pixels'
// samples, so there a pixel counts beside which the same surface has another visibility, as it does without a kernel.
// Needs filters.glsl, shading.glsl and "technique", which says how wide the kernel is here. WITH_CONTRAST: the rule's
// contrast exponent is not 0. A program of its own, since a GPU that masks branches shades every pixel twice for it.
#include "demand"

layout(binding = 0) uniform sampler2D positions;
layout(binding = 1) uniform sampler2D planes;
layout(binding = 2) uniform sampler2D visibilities;
layout(binding = 3) uniform sampler2D normals;
layout(binding = 4) uniform sampler2D albedos;
layout(binding = 5) uniform sampler2D depths;  // the shadow map

layout(location = 0) uniform vec4 rule;  // in the order of StairwellDemandRule
layout(location = 1) uniform uint hasKernel;

bool onMap(vec2 uv) { return all(greaterThanEqual(uv, vec2(0.0))) && all(lessThanEqual(uv, vec2(1.0))); }

// Left, right, below, above.
ivec2 pixelBeside(ivec2 pixel, int i) { return pixel + (i < 2 ? ivec2(2 * i - 1, 0) : ivec2(0, 2 * i - 5)); }

// Another visibility on the surface of the pixel: at a silhouette, and at the border of what faces the light, it
// changes without a stair-step of the map. The tangent of 30 degrees between the plane and the way to the neighbour
// lets curved surfaces pass (chosen by eye).
bool changesBeside(ivec2 pixel, vec3 position, vec3 plane, float visibility) {
    for (int i = 0; i < 4; ++i) {
        ivec2 beside = pixelBeside(pixel, i);
        if (any(lessThan(beside, ivec2(0))) || any(greaterThanEqual(beside, ivec2(view.viewport.xy)))) continue;
        if (abs(texelFetch(visibilities, beside, 0).x - visibility) <= kVisibleShare) continue;
        vec4 other = texelFetch(positions, beside, 0);
        if (other.w == 0.0 || dot(texelFetch(planes, beside, 0).xyz, towardsLight(other.xyz, shadow)) <= 0.0) continue;
        vec3 way = other.xyz - position;
        if (abs(dot(way, plane)) <= 0.5 * length(way)) return true;
    }
    return false;
}

#ifdef WITH_CONTRAST
// Of the edge of a shadow of the sun: how far apart full light and full shadow are on the display, black to white being
// 1. Without lamps, which could only lessen it. A lamp's shadows count as black on white.
float shadowContrast(ivec2 pixel, vec3 position, float gloss) {
    SurfaceLook surface =
        SurfaceLook(position, texelFetch(normals, pixel, 0).xyz, texelFetch(albedos, pixel, 0).rgb, gloss);
    vec3 ray = pixelRay(vec2(pixel) + 0.5);
    vec3 range = displayCode(surfaceColour(surface, ray, 1.0, vec3(0.0))) -
                 displayCode(surfaceColour(surface, ray, 0.0, vec3(0.0)));
    return dot(range, vec3(0.2126, 0.7152, 0.0722));
}
#endif

struct PixelDemand {
    float texels;  // 0 where the formula rejects the radius, -1 where the pixel asks for nothing
    uint weight;   // of shadow edge, stairwellDemandWeight()
};
const PixelDemand kAsksForNothing = PixelDemand(-1.0, 0u);

// Whether pixelDemand() may ask for anything, by the visibilities alone.
bool mayAsk(ivec2 pixel) {
    ivec2 last = ivec2(view.viewport.xy) - 1;
    if (any(greaterThan(pixel, last))) return false;
    float visibility = texelFetch(visibilities, pixel, 0).x;
    if (inPenumbra(visibility)) return true;
    for (int i = 0; i < 4; ++i) {
        ivec2 beside = pixelBeside(pixel, i);
        float other = texelFetch(visibilities, clamp(beside, ivec2(0), last), 0).x;
        if (abs(other - visibility) > kVisibleShare) return true;
    }
    return false;
}

PixelDemand pixelDemand(ivec2 pixel) {
    vec4 position = texelFetch(positions, pixel, 0);
    if (position.w == 0.0) return kAsksForNothing;
    vec4 plane = texelFetch(planes, pixel, 0);
    ShadowReceiver receiver = shadowReceiver(position.xyz, plane.xyz, view, shadow);
    if (!receiver.facesLight || !onMap(receiver.uv)) return kAsksForNothing;
    if (!serves(receiver, dot(position.xyz, view.forward.xyz), shadow)) return kAsksForNothing;
    float visibility = texelFetch(visibilities, pixel, 0).x;
    bool between = inPenumbra(visibility);
    if (!between && !changesBeside(pixel, position.xyz, plane.xyz, visibility)) return kAsksForNothing;
    float radius = penumbraRadiusUv(depths, receiver, shadow);
    if (radius < 0.0) return kAsksForNothing;
    // The penumbra on screen is that of the filter as it is shown, enlarged where the map is limited.
    float shown = shownRadiusUv(radius, receiver, shadow);
    bool wide = hasKernel != 0u && shown >= receiver.footprintUv;
    if (wide && !between) return kAsksForNothing;
    StairwellDemandRule asked = StairwellDemandRule(rule.x, rule.y, rule.z, rule.w);
    float contrast = 1.0;
#ifdef WITH_CONTRAST
    if (shadow.towardsLight.w == 0.0) contrast = shadowContrast(pixel, position.xyz, plane.w);
#endif
    float texels = stairwellDemand(asked, radius, receiver.footprintUv, contrast, 0.0);
    // Where the penumbra is narrower than a pixel, or there is none, the pixel is one of the edge.
    return PixelDemand(texels, stairwellDemandWeight(wide ? shown : 0.0, receiver.footprintUv));
}

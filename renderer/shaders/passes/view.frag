// SPDX-License-Identifier: MIT
// View pass: a finished frame as the viewer shows it, beside another frame of the same view or with what the map's
// size follows from painted over it. VIEW_... is the row of renderer::View.
#include "shared/filters.glsl"
#include "shared/shading.glsl"
#include "technique"
#include "shared/pixel_demand.glsl"

layout(binding = 6) uniform sampler2D lit;
layout(binding = 7) uniform sampler2D otherVisibilities;
layout(binding = 8) uniform sampler2D otherLit;

layout(location = 2) uniform uint chosen;
layout(location = 3) uniform vec2 splitAndGain;  // x of the line in px, gain of the difference
layout(location = 4) uniform vec2 demandRange;   // log2 of the texels at the ends of the colour scale

layout(location = 0) out vec4 outColour;

// Grey, so that what is painted over it stands out.
vec3 background(vec3 colour) { return vec3(0.15 + 0.55 * dot(colour, vec3(0.2126, 0.7152, 0.0722))); }

// Dark blue, green, yellow: monotone in lightness (after the map "viridis" of S. van der Walt and N. Smith, 2015; a
// quadratic through three of its colours).
vec3 scaleColour(float t) {
    vec3 low = vec3(0.267, 0.005, 0.329), middle = vec3(0.128, 0.567, 0.551), high = vec3(0.993, 0.906, 0.144);
    return mix(mix(low, middle, clamp(2.0 * t, 0.0, 1.0)), high, clamp(2.0 * t - 1.0, 0.0, 1.0));
}

// Orange: this frame is lighter than the other; blue: darker.
vec3 signedColour(vec3 under, float difference) {
    vec3 over = difference > 0.0 ? vec3(1.0, 0.45, 0.0) : vec3(0.1, 0.45, 1.0);
    return mix(under, over, clamp(abs(difference), 0.0, 1.0));
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 own = texelFetch(lit, pixel, 0).rgb;
    float visibility = texelFetch(visibilities, pixel, 0).x;
    outColour = vec4(own, 1.0);
    if (chosen == VIEW_SPLIT) {
        float fromLine = gl_FragCoord.x - splitAndGain.x;
        if (fromLine > 0.0) outColour.rgb = texelFetch(otherLit, pixel, 0).rgb;
        if (abs(fromLine) < 1.0) outColour.rgb = vec3(1.0);
        return;
    }
    if (chosen == VIEW_DIFFERENCE) {
        float difference = visibility - texelFetch(otherVisibilities, pixel, 0).x;
        outColour.rgb = signedColour(background(own), splitAndGain.y * difference);
        return;
    }
    if (chosen == VIEW_PENUMBRA || chosen == VIEW_DEMAND) outColour.rgb = background(own);
    if (chosen == VIEW_PENUMBRA) {
        if (inPenumbra(visibility)) outColour.rgb = scaleColour(visibility);
        return;
    }
    if (chosen == VIEW_DEMAND) {
        float texels = pixelDemand(pixel).texels;
        float place = (log2(max(texels, 1.0)) - demandRange.x) / (demandRange.y - demandRange.x);
        if (texels > 0.0) outColour.rgb = scaleColour(clamp(place, 0.0, 1.0));
        return;
    }
    vec4 position = texelFetch(positions, pixel, 0);
    if (position.w == 0.0 || chosen != VIEW_TEXELS) return;
    ShadowReceiver receiver = shadowReceiver(position.xyz, texelFetch(planes, pixel, 0).xyz, view, shadow);
    // Borders one pixel wide; where a texel is smaller than two pixels they would cover everything.
    vec2 texel = receiver.uv * shadow.map.x;
    float pixelInTexels = receiver.footprintUv * shadow.map.x;
    vec2 toBorder = abs(texel - round(texel));
    bool border = min(toBorder.x, toBorder.y) < 0.5 * pixelInTexels;
    float fade = clamp(2.0 - 4.0 * pixelInTexels, 0.0, 1.0);
    if (border && receiver.facesLight) outColour.rgb = mix(own, vec3(1.0, 0.85, 0.2), 0.7 * fade);
}

// SPDX-License-Identifier: MIT
// How a pixel looks for a given share of the sun and the light of lamps: sky and ground light, haze and tone, as sRGB codes in [0,1]. Needs
// blocks.glsl.

struct SurfaceLook {
    vec3 eyeRelative;
    vec3 normal;  // the shading normal
    vec3 albedo;
    float gloss;
};

vec3 pixelRay(vec2 place) {
    vec2 fromCentre = place - 0.5 * view.viewport.xy;
    return normalize(view.forward.xyz + view.pixelRight.xyz * fromCentre.x + view.pixelUp.xyz * fromCentre.y);
}

vec3 skyColour(vec3 direction) {
    float height = max(direction.y, 0.0);
    vec3 sky = mix(look.horizonColour.rgb, look.zenithColour.rgb, 1.0 - exp(-3.2 * height));
    float towardsSun = max(dot(direction, shadow.towardsLight.xyz), 0.0);
    return sky + look.sunColour.rgb * (0.03 * pow(towardsSun, 8.0) + 0.12 * pow(towardsSun, 64.0));
}

vec3 surfaceColour(SurfaceLook surface, vec3 ray, float visibility, vec3 fromLamps) {
    vec3 light = shadow.towardsLight.xyz;
    vec3 surround = mix(look.groundLight.rgb, look.skyLight.rgb, 0.5 + 0.5 * surface.normal.y);
    vec3 sun = look.sunColour.rgb * visibility;
    float diffuse = max(dot(surface.normal, light), 0.0);
    float sheen = pow(max(dot(surface.normal, normalize(light - ray)), 0.0), 4.0 + 120.0 * surface.gloss) *
                  surface.gloss;
    vec3 lit = surface.albedo * (sun * diffuse + surround + fromLamps) + sun * (sheen * 0.5 * diffuse);

    float distance = length(surface.eyeRelative);
    float haze = 1.0 - exp2(-(distance * distance) / (look.tone.y * look.tone.y));
    return mix(lit, skyColour(normalize(vec3(ray.x, max(ray.y, 0.0), ray.z))), haze);
}

// Filmic curve (K. Narkowicz, "ACES filmic tone mapping curve", 2016).
vec3 filmic(vec3 x) { return clamp((x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0); }

vec3 srgb(vec3 linear) {
    vec3 low = 12.92 * linear;
    vec3 high = 1.055 * pow(max(linear, vec3(0.0)), vec3(1.0 / 2.4)) - 0.055;
    return mix(high, low, lessThanEqual(linear, vec3(0.0031308)));
}

vec3 displayCode(vec3 colour) { return srgb(filmic(colour * look.tone.x)); }

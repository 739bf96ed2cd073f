// SPDX-License-Identifier: MIT
// Lit pass: sun times visibility, sky and ground light, haze and tone. The target holds sRGB codes.
#include "shared/blocks.glsl"

layout(binding = 0) uniform sampler2D positions;
layout(binding = 1) uniform sampler2D planes;
layout(binding = 2) uniform sampler2D normals;
layout(binding = 3) uniform sampler2D albedos;
layout(binding = 4) uniform sampler2D visibilities;

layout(location = 0) out vec4 outColour;

vec3 skyColour(vec3 direction) {
    float height = max(direction.y, 0.0);
    vec3 sky = mix(look.horizonColour.rgb, look.zenithColour.rgb, 1.0 - exp(-3.2 * height));
    float towardsSun = max(dot(direction, shadow.towardsLight.xyz), 0.0);
    return sky + look.sunColour.rgb * (0.03 * pow(towardsSun, 8.0) + 0.12 * pow(towardsSun, 64.0));
}

// Filmic curve (K. Narkowicz, "ACES filmic tone mapping curve", 2016).
vec3 filmic(vec3 x) { return clamp((x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0); }

vec3 srgb(vec3 linear) {
    vec3 low = 12.92 * linear;
    vec3 high = 1.055 * pow(max(linear, vec3(0.0)), vec3(1.0 / 2.4)) - 0.055;
    return mix(high, low, lessThanEqual(linear, vec3(0.0031308)));
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 position = texelFetch(positions, pixel, 0);
    vec2 fromCentre = gl_FragCoord.xy - 0.5 * view.viewport.xy;
    vec3 ray = normalize(view.forward.xyz + view.pixelRight.xyz * fromCentre.x + view.pixelUp.xyz * fromCentre.y);
    vec3 colour = skyColour(ray);
    if (position.w != 0.0) {
        vec4 plane = texelFetch(planes, pixel, 0);
        vec3 normal = texelFetch(normals, pixel, 0).xyz;
        vec3 albedo = texelFetch(albedos, pixel, 0).rgb;
        float visibility = texelFetch(visibilities, pixel, 0).x;
        vec3 light = shadow.towardsLight.xyz;

        vec3 surround = mix(look.groundLight.rgb, look.skyLight.rgb, 0.5 + 0.5 * normal.y);
        vec3 sun = look.sunColour.rgb * visibility;
        float diffuse = max(dot(normal, light), 0.0);
        float sheen = pow(max(dot(normal, normalize(light - ray)), 0.0), 4.0 + 120.0 * plane.w) * plane.w;
        vec3 lit = albedo * (sun * diffuse + surround) + sun * (sheen * 0.5 * diffuse);

        float distance = length(position.xyz);
        float haze = 1.0 - exp2(-(distance * distance) / (look.tone.y * look.tone.y));
        colour = mix(lit, skyColour(normalize(vec3(ray.x, max(ray.y, 0.0), ray.z))), haze);
    }
    outColour = vec4(srgb(filmic(colour * look.tone.x)), 1.0);
}

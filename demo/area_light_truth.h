// SPDX-License-Identifier: MIT
// Truth for model errors: how much of an area light each pixel sees, by ray casting against the
// scene's triangles (Embree). The light is the scene's sun as a disc of a given angular radius, or
// a lamp: a disc or a ball somewhere. How wrong a technique is against it does not fall with N.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>

#include "renderer/image.h"
#include "renderer/renderer.h"

namespace demo {

/// A light in the scene, which every receiver sees from its own side.
struct Lamp {
    glm::vec3 position{0};
    double radiusM = 0.1;  ///< >= 0
    /// A disc that shines along this direction, as a spot's does; absent: a ball.
    std::optional<glm::vec3> facing = {};
};

struct AreaLight {
    double angularRadiusDeg = 0.27;  ///< of the sun's disc, [0, 20]; not looked at with a lamp
    std::optional<Lamp> lamp = {};   ///< in place of the sun
    /// Two sets of so many squared rays a pixel, each stratified over the disc; 1 .. 256.
    int raysEdge = 12;
    std::uint64_t seed = 1;  ///< of the places in the strata
};

/// The sun for which a technique with the kernel's radius at the share `distance` of the map's
/// depth range before a receiver is right: how the table's PCSS is given its softness.
double angularRadiusDeg(double radiusM, double distance, double depthRangeM);

struct AreaLightTruth {
    renderer::FloatImage visibility;  ///< 1 for the sky
    /// RMS over penumbra pixels of a pixel's standard error, from the difference of the two sets.
    double standardError = 0;
};

/// Of the surfaces that the last frame shows. With a folder the image is kept there under the
/// SHA-256 of all that it depends on (geometry, receivers, light), and read where it is there.
/// Throws std::invalid_argument for a light out of range and std::runtime_error for a broken file.
AreaLightTruth areaLightTruth(renderer::Renderer& frame, const AreaLight& light,
                              const std::optional<std::filesystem::path>& cache = {});

}  // namespace demo

// SPDX-License-Identifier: MIT
// Scenes: geometry with materials, and the camera, light and softness that show it well. The
// built-in ones are a table; lengths in metres, y up, the light is the sun.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/mesh.h"

namespace renderer {

/// Drawn over a material's colour, from the world position.
enum class Pattern : unsigned { plain = 0, tiles = 1, bands = 2 };

struct Material {
    glm::vec3 albedo{0.5F};  ///< linear light, [0,1]
    float gloss = 0;         ///< [0,1]
    Pattern pattern = Pattern::plain;
    glm::vec3 second{0};  ///< the pattern's other colour
    float periodM = 1;    ///< of the pattern
};

struct SceneObject {
    std::string name;
    Mesh mesh;
    Material material;
};

/// Looks at `target` from a distance. Angles in degrees.
struct OrbitCamera {
    glm::vec3 target{0};
    float yawDeg = 0;             ///< 0 looks along -z, growing to the right around the target
    float pitchDeg = 20;          ///< height of the eye over the target, (-90, 90)
    float distanceM = 10;         ///< > 0
    float verticalFieldDeg = 40;  ///< (0, 180)

    glm::vec3 eye() const;
};

/// A directional light.
struct Sun {
    float azimuthDeg = 0;                  ///< where it stands: 0 is +z, 90 is +x
    float elevationDeg = 45;               ///< over the horizon, (0, 90]
    glm::vec3 colour{3.2F, 2.85F, 2.35F};  ///< linear light on a surface that faces it
    /// Turn of the map about the light's direction. 0 has the map's v axis along the vertical, so
    /// that the shadows of all posts and walls run along the texel grid, where a map shows no
    /// stair-steps.
    float mapTurnDeg = 20;

    glm::vec3 towards() const;  ///< unit vector to the sun
};

struct Scene {
    std::string name;
    std::vector<SceneObject> objects;
    OrbitCamera camera;
    Sun sun;
    Bounds casters;  ///< what throws shadows; the light's window is fitted to it
    double softnessM =
        0.05;  ///< radius of the shadow's blur, in metres across the light's direction
};

struct SceneEntry {
    std::string_view name;
    std::string_view description;
    Scene (*make)();
};

std::span<const SceneEntry> builtInScenes();

/// Throws std::invalid_argument that lists the known names; so does makeScene().
const SceneEntry& findScene(std::string_view name);
Scene makeScene(std::string_view name);

}  // namespace renderer

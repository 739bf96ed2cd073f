// SPDX-License-Identifier: MIT
// Scenes: geometry with materials, and the camera, light and softness that show it well, with a way
// on which each of the two can move. The built-in ones are a table; lengths in metres, y up, the
// light is the sun.
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
    bool casts = true;  ///< false: the map's window is not fitted to it (endless grounds)
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

/// A light among the things: a spot that shines into a cone, or a point that shines to all sides.
struct Lamp {
    enum class Kind { spot, point };
    Kind kind = Kind::spot;
    glm::vec3 position{0, 3, 0};
    glm::vec3 target{0};     ///< of a spot: a point on its axis, not the position
    float coneDeg = 60;      ///< of a spot: from side to side, (0, 150]
    glm::vec3 colour{8.0F};  ///< linear light on a surface that faces it, 1 m away
    float nearM = 0.05F;     ///< casters nearer than this throw no shadow, > 0
    float farM = 20;         ///< nor do farther ones, > nearM
    float softness = 0.01F;  ///< radius of the blur, as the tangent of an angle at the lamp, >= 0
};

/// Closed ways: the end is the beginning. `place` is how far along, [0,1), 0 where camera or sun
/// stand without the path. A turn of 360 goes once round, a smaller one from side to side; swings
/// go up and down once.
struct CameraPath {
    float turnDeg = 360;
    float pitchSwingDeg = 0;  ///< to either side
    float distanceSwing = 0;  ///< to either side, as a share of the distance, [0,1)
};
struct SunPath {
    float turnDeg = 360;
    float elevationSwingDeg = 0;  ///< to either side
};
/// Pitch and elevation stay within 2 and 88 degrees where a path takes them beyond.
OrbitCamera along(const CameraPath& path, const OrbitCamera& start, double place);
Sun along(const SunPath& path, const Sun& start, double place);

/// Spots in a ring over the casters, all of them towards their middle.
std::vector<Lamp> ringOfSpots(std::size_t count, const Bounds& casters);

struct Scene {
    std::string name;    ///< fit for a file's name
    std::string source;  ///< what was asked for, with its options
    /// What a model file held that is left out, or holds wrongly, a sentence each.
    std::vector<std::string> notes;
    std::vector<SceneObject> objects;
    OrbitCamera camera;
    CameraPath cameraPath;
    Sun sun;
    SunPath sunPath;
    int cascades = 1;  ///< maps of the sun, each for a stretch of the view, 1 .. kMostCascades
    std::vector<Lamp> lamps;  ///< at most kMostLamps
    Bounds casters;           ///< what throws shadows; the light's window is fitted to it
    double softnessM =
        0.05;          ///< radius of the shadow's blur, in metres across the light's direction
    float hazeM = 60;  ///< distance at which haze takes half of the light
};

inline constexpr std::size_t kMostLamps = 63;
inline constexpr int kMostCascades = 8;

/// Triangles of the objects that cast.
std::size_t casterTriangles(const Scene& scene);

struct SceneEntry {
    std::string_view name;
    std::string_view description;
    std::string_view purpose;  ///< what it shows, finds out or goes wrong in
    Scene (*make)();           ///< without name and source: call makeScene()
};

std::span<const SceneEntry> builtInScenes();

/// The row of a scene, by its name or a source as makeScene() takes them; the option is not looked
/// at. Throws std::invalid_argument that lists the known names.
const SceneEntry& findScene(std::string_view source);

/// Options of a scene, each after a colon: ":triangles=COUNT" is the same picture with its casters
/// split into about as many triangles, from their own number to 4,000,000; ":cascades=COUNT" has as
/// many maps of the sun; ":lamps=COUNT" has as many spots more, in a ring over the casters. Throws
/// std::invalid_argument for an unknown option and a count out of range.
void applyOptions(Scene& scene, std::string_view options);

/// A built-in scene by its name, with options behind it. Throws std::invalid_argument for an
/// unknown name, and what applyOptions() throws.
Scene makeScene(std::string_view source);

}  // namespace renderer

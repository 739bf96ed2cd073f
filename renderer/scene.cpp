// SPDX-License-Identifier: MIT
#include "renderer/scene.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <stdexcept>

#include "renderer/scenes/scenes.h"

namespace renderer {
namespace {

constexpr Material kPaving{.albedo = {0.34F, 0.30F, 0.25F},
                           .pattern = Pattern::tiles,
                           .second = {0.16F, 0.14F, 0.12F},
                           .periodM = 0.8F};

constexpr SceneEntry kScenes[] = {
    {"planar_occluder", "a flat plate with a round hole and a star, over a plane",
     "one occluder depth, where variance maps are exact; edges of every direction", planarOccluder},
    {"yard", "posts, spheres and a picket fence on a ground",
     "thin, round and tall casters, shadows across objects", yard},
    {"overlapping_spheres", "spheres at several heights whose shadows lie on top of each other",
     "light bleeding of moment maps", overlappingSpheres},
    {"contact_posts", "posts, a leaning board, a bench and a beam high over them",
     "penumbrae that open from contact to wide", contactPosts},
    {"foliage", "a wire fence, a tree and a hedge of single leaves",
     "casters thinner than a texel, which small maps lose", foliage},
    {"city", "towers, open decks and bridges", "many depths along each ray of the light", city},
    {"terrain", "hills with stones and poles in the last sun",
     "grazing light on receivers that are casters, over a large extent", terrain},
    {"knob", "a turned knob with a hollow neck, and a bowl",
     "rings where a kernel cuts into hollow surfaces", knob},
    {"lamps", "posts around a point lamp, a sphere under a spot, and little sun",
     "several lights with perspective maps, and the edges of a cube's faces", lamps},
};

constexpr std::size_t kMostTriangles = 4'000'000;
constexpr float kLeastAngleDeg = 2, kMostAngleDeg = 88;

float turned(float turnDeg, double place) {
    return turnDeg * static_cast<float>(
                         turnDeg == 360 ? place : 0.5 * std::sin(glm::two_pi<double>() * place));
}

float swung(float swing, double place) {
    return swing * static_cast<float>(std::sin(glm::two_pi<double>() * place));
}

/// `at` where a path without a swing must leave it alone.
float withinHeight(float at, float swing, double place) {
    return swing == 0 ? at : std::clamp(at + swung(swing, place), kLeastAngleDeg, kMostAngleDeg);
}

/// The value of an option of a source. `range` is how a sentence calls it.
std::size_t optionValue(std::string_view source, std::string_view option, std::size_t least,
                        std::size_t most, const std::string& range) {
    const std::size_t equals = option.find('=');
    const std::string_view number = option.substr(equals + 1);
    std::size_t count = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), count);
    if (error != std::errc() || end != number.data() + number.size() || count < least ||
        count > most)
        throw std::invalid_argument(
            "scene \"" + std::string(source) + "\": " + std::string(option.substr(0, equals)) +
            " is \"" + std::string(number) + "\", must be a whole number from " + range);
    return count;
}

void splitCasters(Scene& scene, std::string_view option) {
    const std::size_t own = casterTriangles(scene);
    const std::size_t asked = optionValue(
        scene.source, option, own, kMostTriangles,
        std::to_string(own) + ", the scene's own, to " + std::to_string(kMostTriangles));
    const double ratio = static_cast<double>(asked) / static_cast<double>(own);
    const int parts = static_cast<int>(std::lround(std::sqrt(ratio)));
    for (SceneObject& object : scene.objects)
        if (object.casts) object.mesh = split(object.mesh, parts);
    scene.name += "_" + std::to_string(casterTriangles(scene)) + "_triangles";
}

void setCascades(Scene& scene, std::string_view option) {
    scene.cascades = static_cast<int>(optionValue(scene.source, option, 1, kMostCascades,
                                                  "1 to " + std::to_string(kMostCascades)));
    scene.name += "_" + std::to_string(scene.cascades) + "_cascades";
}

void addLamps(Scene& scene, std::string_view option) {
    const std::size_t most = kMostLamps - scene.lamps.size();
    const std::size_t count =
        optionValue(scene.source, option, 1, most, "1 to " + std::to_string(most));
    const std::vector<Lamp> lamps = ringOfSpots(count, scene.casters);
    scene.lamps.insert(scene.lamps.end(), lamps.begin(), lamps.end());
    scene.name += "_" + std::to_string(count) + "_lamps";
}

}  // namespace

SceneObject paving(float halfExtent, int cells) {
    return {"ground", groundPlane(halfExtent, cells), kPaving, false};
}

Bounds casterBounds(const std::vector<SceneObject>& objects) {
    Bounds all{glm::vec3(1e9F), glm::vec3(-1e9F)};
    for (const SceneObject& object : objects) {
        if (!object.casts) continue;
        const Bounds bounds = boundsOf(object.mesh);
        all.low = glm::min(all.low, bounds.low);
        all.high = glm::max(all.high, bounds.high);
    }
    all.low.y = std::min(all.low.y, 0.0F);
    return all;
}

glm::vec3 OrbitCamera::eye() const {
    const float yaw = glm::radians(yawDeg);
    const float pitch = glm::radians(pitchDeg);
    return target + distanceM * glm::vec3(std::sin(yaw) * std::cos(pitch), std::sin(pitch),
                                          std::cos(yaw) * std::cos(pitch));
}

glm::vec3 Sun::towards() const {
    const float azimuth = glm::radians(azimuthDeg);
    const float elevation = glm::radians(elevationDeg);
    return {std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
            std::cos(azimuth) * std::cos(elevation)};
}

OrbitCamera along(const CameraPath& path, const OrbitCamera& start, double place) {
    OrbitCamera camera = start;
    camera.yawDeg = std::remainder(camera.yawDeg + turned(path.turnDeg, place), 360.0F);
    camera.pitchDeg = withinHeight(camera.pitchDeg, path.pitchSwingDeg, place);
    camera.distanceM *= 1 + swung(path.distanceSwing, place);
    return camera;
}

Sun along(const SunPath& path, const Sun& start, double place) {
    Sun sun = start;
    sun.azimuthDeg = std::remainder(sun.azimuthDeg + turned(path.turnDeg, place), 360.0F);
    sun.elevationDeg = withinHeight(sun.elevationDeg, path.elevationSwingDeg, place);
    return sun;
}

std::vector<Lamp> ringOfSpots(std::size_t count, const Bounds& casters) {
    // Together somewhat less bright than the sun (chosen by eye).
    constexpr float kLightOfAll = 1.2F;
    const glm::vec3 middle = 0.5F * (casters.low + casters.high);
    const float radius = glm::distance(casters.low, casters.high);
    std::vector<Lamp> lamps(count);
    for (std::size_t i = 0; i < count; ++i) {
        const float angle =
            glm::two_pi<float>() * static_cast<float>(i) / static_cast<float>(count);
        lamps[i].position = middle + radius * glm::vec3(std::sin(angle), 1, std::cos(angle));
        lamps[i].target = middle;
        lamps[i].colour = glm::vec3(kLightOfAll * 2 * radius * radius / static_cast<float>(count));
        lamps[i].nearM = 0.1F * radius;
        lamps[i].farM = 5 * radius;
    }
    return lamps;
}

std::size_t casterTriangles(const Scene& scene) {
    std::size_t count = 0;
    for (const SceneObject& object : scene.objects)
        if (object.casts) count += object.mesh.indices.size() / 3;
    return count;
}

std::span<const SceneEntry> builtInScenes() {
    return kScenes;
}

const SceneEntry& findScene(std::string_view source) {
    const std::string_view name = source.substr(0, source.find(':'));
    std::string known;
    for (const SceneEntry& entry : builtInScenes()) {
        if (entry.name == name) return entry;
        known += (known.empty() ? "" : ", ") + std::string(entry.name);
    }
    throw std::invalid_argument("scene \"" + std::string(name) +
                                "\" is not known; known are: " + known);
}

void applyOptions(Scene& scene, std::string_view options) {
    for (std::size_t colon = options.find(':'); colon != std::string_view::npos;) {
        const std::size_t next = options.find(':', colon + 1);
        const std::string_view option = options.substr(colon + 1, next - colon - 1);
        if (option.starts_with("triangles="))
            splitCasters(scene, option);
        else if (option.starts_with("cascades="))
            setCascades(scene, option);
        else if (option.starts_with("lamps="))
            addLamps(scene, option);
        else
            throw std::invalid_argument("scene \"" + scene.source + "\": option \"" +
                                        std::string(option) +
                                        "\" is not known; known are triangles=COUNT, "
                                        "cascades=COUNT and lamps=COUNT");
        colon = next;
    }
}

Scene makeScene(std::string_view source) {
    const SceneEntry& entry = findScene(source);
    Scene scene = entry.make();
    scene.name = entry.name;
    scene.source = source;
    applyOptions(scene, source.substr(entry.name.size()));
    return scene;
}

}  // namespace renderer

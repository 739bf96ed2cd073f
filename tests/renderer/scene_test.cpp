// SPDX-License-Identifier: MIT
#include "renderer/scene.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

TEST(Scene, BuiltInScenesAreWholeAndDescribed) {
    for (const renderer::SceneEntry& entry : renderer::builtInScenes()) {
        EXPECT_FALSE(entry.description.empty());
        EXPECT_FALSE(entry.purpose.empty());
        const renderer::Scene scene = renderer::makeScene(entry.name);
        EXPECT_EQ(scene.name, entry.name);
        EXPECT_EQ(scene.source, entry.name);
        EXPECT_GT(scene.softnessM, 0);
        for (const renderer::SceneObject& object : scene.objects) {
            ASSERT_FALSE(object.mesh.indices.empty()) << object.name;
            EXPECT_EQ(object.mesh.indices.size() % 3, 0U);
            for (const auto index : object.mesh.indices)
                ASSERT_LT(index, object.mesh.vertices.size()) << object.name;
            for (const renderer::Vertex& vertex : object.mesh.vertices) {
                ASSERT_TRUE(std::isfinite(glm::length(vertex.position)));
                ASSERT_NEAR(glm::length(vertex.normal), 1, 1e-4) << object.name;
            }
            if (!object.casts) continue;
            const renderer::Bounds bounds = boundsOf(object.mesh);
            EXPECT_GE(bounds.low.y, -1e-4) << object.name << " sinks into the ground";
            EXPECT_TRUE(glm::all(glm::lessThanEqual(scene.casters.low, bounds.low)) &&
                        glm::all(glm::greaterThanEqual(scene.casters.high, bounds.high)))
                << object.name;
        }
    }
    EXPECT_THROW(renderer::makeScene("garden"), std::invalid_argument);
}

/// Summed over triangles: what splitting must leave as it is.
double areaOf(const renderer::Scene& scene) {
    double area = 0;
    for (const renderer::SceneObject& object : scene.objects) {
        const auto at = [&](std::size_t i) {
            return glm::dvec3(object.mesh.vertices[object.mesh.indices[i]].position);
        };
        for (std::size_t i = 0; object.casts && i < object.mesh.indices.size(); i += 3)
            area += glm::length(glm::cross(at(i + 1) - at(i), at(i + 2) - at(i))) / 2;
    }
    return area;
}

// Whole splits of every triangle: the count may miss what was asked for by half a step.
TEST(Scene, CastersAreSplitIntoAboutAsManyTrianglesOfTheSameSurface) {
    const renderer::Scene city = renderer::makeScene("city");
    const auto own = static_cast<double>(casterTriangles(city));
    EXPECT_LT(own, 4000) << "the benchmark begins there";
    for (const std::string_view name : {"city", "knob"}) {
        const renderer::Scene plain = renderer::makeScene(name);
        for (const int asked : {64'000, 1'000'000}) {
            const std::string source = std::string(name) + ":triangles=" + std::to_string(asked);
            const renderer::Scene scene = renderer::makeScene(source);
            const auto count = static_cast<double>(casterTriangles(scene));
            const double parts = std::sqrt(count / static_cast<double>(casterTriangles(plain)));
            EXPECT_NEAR(parts, std::round(parts), 1e-9);
            EXPECT_NEAR(count / asked, 1, 1.1 / parts) << source;
            EXPECT_EQ(scene.source, source);
            EXPECT_EQ(scene.name.find_first_of("/:= "), std::string::npos) << scene.name;
            EXPECT_NEAR(areaOf(scene) / areaOf(plain), 1, 1e-4);  // float32 corners
            EXPECT_EQ(scene.casters.low, plain.casters.low);
            EXPECT_EQ(scene.casters.high, plain.casters.high);
        }
    }
}

std::string refusal(const std::string& source) {
    try {
        renderer::makeScene(source);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "accepted";
}

TEST(Scene, RefusesUnknownOptionsAndCountsInOneSentence) {
    EXPECT_EQ(refusal("yard:colour=red"),
              "scene \"yard:colour=red\": option \"colour=red\" is not known; known are "
              "triangles=COUNT, cascades=COUNT and lamps=COUNT");
    for (const char* count : {"", "0", "9", "2.5"})
        EXPECT_EQ(refusal("yard:cascades=" + std::string(count)),
                  "scene \"yard:cascades=" + std::string(count) + "\": cascades is \"" + count +
                      "\", must be a whole number from 1 to 8");
    for (const char* count : {"", "0", "64", "-1"})
        EXPECT_EQ(refusal("yard:lamps=" + std::string(count)),
                  "scene \"yard:lamps=" + std::string(count) + "\": lamps is \"" + count +
                      "\", must be a whole number from 1 to 63");
    EXPECT_NE(refusal("lamps:lamps=62").find("from 1 to 61"), std::string::npos) << "two are there";
    EXPECT_EQ(renderer::makeScene("lamps:lamps=61").lamps.size(), renderer::kMostLamps);
    const renderer::Scene both = renderer::makeScene("city:cascades=3:triangles=64000");
    EXPECT_EQ(both.cascades, 3);
    EXPECT_GT(casterTriangles(both), 50000U);
    for (const char* count : {"", "x", "-5", "10", "1e6", "5000000", "99999999999999999999999"})
        EXPECT_NE(
            refusal("city:triangles=" + std::string(count))
                .find("triangles is \"" + std::string(count) + "\", must be a whole number from "),
            std::string::npos)
            << refusal("city:triangles=" + std::string(count));
    EXPECT_NE(refusal(":triangles=5000").find("scene \"\" is not known"), std::string::npos);
}

TEST(ScenePaths, BeginWhereTheSceneStandsAndComeBackThere) {
    for (const renderer::SceneEntry& entry : renderer::builtInScenes()) {
        const renderer::Scene scene = renderer::makeScene(entry.name);
        glm::vec3 lastEye = along(scene.cameraPath, scene.camera, 0).eye();
        glm::vec3 lastSun = along(scene.sunPath, scene.sun, 0).towards();
        EXPECT_NEAR(glm::distance(lastEye, scene.camera.eye()), 0, 1e-5 * scene.camera.distanceM);
        EXPECT_NEAR(glm::distance(lastSun, scene.sun.towards()), 0, 1e-6);
        float eyeMoved = 0;
        float sunMoved = 0;
        constexpr int kSteps = 200;
        for (int i = 1; i <= kSteps; ++i) {
            const double place = static_cast<double>(i) / kSteps;
            const renderer::OrbitCamera camera = along(scene.cameraPath, scene.camera, place);
            const renderer::Sun sun = along(scene.sunPath, scene.sun, place);
            EXPECT_TRUE(camera.pitchDeg > 0 && camera.pitchDeg < 90 && camera.distanceM > 0);
            EXPECT_TRUE(sun.elevationDeg > 0 && sun.elevationDeg <= 90) << entry.name;
            const float eyeStep = glm::distance(camera.eye(), lastEye) / scene.camera.distanceM;
            const float sunStep = glm::distance(sun.towards(), lastSun);
            EXPECT_LT(eyeStep, 0.06F) << entry.name << " jumps at " << place;
            EXPECT_LT(sunStep, 0.06F) << entry.name << " jumps at " << place;
            eyeMoved += eyeStep;
            sunMoved += sunStep;
            lastEye = camera.eye();
            lastSun = sun.towards();
        }
        EXPECT_NEAR(glm::distance(lastEye, scene.camera.eye()), 0, 1e-4 * scene.camera.distanceM);
        EXPECT_NEAR(glm::distance(lastSun, scene.sun.towards()), 0, 1e-4);
        EXPECT_GT(eyeMoved, 0.5F) << entry.name;
        EXPECT_GT(sunMoved, 0.2F) << entry.name;
    }
}

TEST(ScenePaths, ATurnBelowOnceRoundGoesFromSideToSide) {
    const renderer::Sun start{.azimuthDeg = 170, .elevationDeg = 80};
    const renderer::SunPath path{.turnDeg = 40, .elevationSwingDeg = 30};
    EXPECT_NEAR(along(path, start, 0.25).azimuthDeg, -170, 1e-3);
    EXPECT_NEAR(along(path, start, 0.75).azimuthDeg, 150, 1e-3);
    EXPECT_NEAR(along(path, start, 0.25).elevationDeg, 88, 1e-3) << "not beyond the zenith";
    EXPECT_NEAR(along(path, start, 0.75).elevationDeg, 50, 1e-3);
}

}  // namespace

// SPDX-License-Identifier: MIT
#include "demo/area_light_truth.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/glm.hpp>
#include <limits>
#include <memory>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>

#include "records/file_checksum.h"
#include "records/whole_file.h"

namespace demo {
namespace {

// Rays begin off the surface by this share of the distance to the eye: float32 positions are no
// better.
constexpr float kOffset = 1e-5F;

constexpr double kMostLampM = 1000;

struct Release {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<RTCDeviceTy, Release>;
using Triangles = std::unique_ptr<RTCSceneTy, Release>;

void add(RTCDevice device, RTCScene triangles, const renderer::Mesh& mesh) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* const corners = static_cast<glm::vec3*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                sizeof(glm::vec3), mesh.vertices.size()));
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) corners[i] = mesh.vertices[i].position;
    auto* const indices = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(std::uint32_t), mesh.indices.size() / 3));
    std::copy(mesh.indices.begin(), mesh.indices.end(), indices);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(triangles, geometry);
    rtcReleaseGeometry(geometry);
}

Triangles trianglesOf(RTCDevice device, const renderer::Scene& scene) {
    Triangles triangles(rtcNewScene(device));
    rtcSetSceneFlags(triangles.get(), RTC_SCENE_FLAG_ROBUST);
    for (const renderer::SceneObject& object : scene.objects)
        if (!object.mesh.indices.empty()) add(device, triangles.get(), object.mesh);
    rtcCommitScene(triangles.get());
    return triangles;
}

/// A point of the unit disc, areas kept (Shirley and Chiu 1997).
glm::dvec2 onDisc(double u, double v) {
    const double a = 2 * u - 1;
    const double b = 2 * v - 1;
    if (a == 0 && b == 0) return {0, 0};
    const bool wide = std::abs(a) > std::abs(b);
    const double radius = wide ? a : b;
    const double angle = wide ? std::numbers::pi / 4 * (b / a)
                              : std::numbers::pi / 2 - std::numbers::pi / 4 * (a / b);
    return radius * glm::dvec2(std::cos(angle), std::sin(angle));
}

/// Towards is a direction, and the light as far as its length, or without end.
bool reachesLight(RTCScene triangles, glm::vec3 from, glm::vec3 towards, bool endless) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay ray{};
    ray.org_x = from.x;
    ray.org_y = from.y;
    ray.org_z = from.z;
    ray.dir_x = towards.x;
    ray.dir_y = towards.y;
    ray.dir_z = towards.z;
    ray.tfar = endless ? std::numeric_limits<float>::infinity() : 1;
    ray.mask = ~0U;
    rtcOccluded1(triangles, &context, &ray);
    return ray.tfar > 0;  // -infinity where something is in the way
}

std::string hashOf(const renderer::Scene& scene, const renderer::FloatImage& positions,
                   const glm::vec3& eye, const AreaLight& light) {
    std::string bytes;
    const auto append = [&](const void* data, std::size_t size) {
        bytes.append(static_cast<const char*>(data), size);
    };
    for (const renderer::SceneObject& object : scene.objects) {
        for (const renderer::Vertex& vertex : object.mesh.vertices)
            append(&vertex.position, sizeof vertex.position);
        append(object.mesh.indices.data(), object.mesh.indices.size() * sizeof(std::uint32_t));
    }
    append(positions.values.data(), positions.values.size() * sizeof(float));
    const glm::vec3 sun = scene.sun.towards();
    append(&sun, sizeof sun);
    append(&eye, sizeof eye);
    append(&light.angularRadiusDeg, sizeof light.angularRadiusDeg);
    if (light.lamp) {
        append(&light.lamp->position, sizeof light.lamp->position);
        append(&light.lamp->radiusM, sizeof light.lamp->radiusM);
        const glm::vec3 facing = light.lamp->facing.value_or(glm::vec3(0));
        append(&facing, sizeof facing);
    }
    append(&light.raysEdge, sizeof light.raysEdge);
    append(&light.seed, sizeof light.seed);
    return records::sha256(bytes);
}

/// The file in the cache: width, height, standard error, then the values.
struct Head {
    std::int32_t width = 0, height = 0;
    double standardError = 0;
};

std::string packed(const AreaLightTruth& truth) {
    const Head head{truth.visibility.width, truth.visibility.height, truth.standardError};
    const auto& values = truth.visibility.values;
    std::string bytes(reinterpret_cast<const char*>(&head), sizeof head);
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
    return bytes;
}

AreaLightTruth unpacked(const std::filesystem::path& file, int width, int height) {
    const std::string bytes = records::readWholeFile(file);
    AreaLightTruth truth;
    truth.visibility = renderer::FloatImage(width, height);
    auto& values = truth.visibility.values;
    Head head;
    if (bytes.size() == sizeof head + values.size() * sizeof(float))
        std::memcpy(&head, bytes.data(), sizeof head);
    if (head.width != width || head.height != height)
        throw std::runtime_error(file.string() + ": is no truth of " + std::to_string(width) +
                                 " x " + std::to_string(height) + " pixels; delete it");
    truth.standardError = head.standardError;
    std::memcpy(values.data(), bytes.data() + sizeof head, values.size() * sizeof(float));
    return truth;
}

class Caster {
  public:
    Caster(const renderer::Scene& scene, const AreaLight& light)
        : light_(light),
          device_(rtcNewDevice("threads=1")),
          sun_(scene.sun.towards()),
          random_(light.seed) {
        if (!device_) throw std::runtime_error("area light: Embree could not be started");
        triangles_ = trianglesOf(device_.get(), scene);
        const double radius = std::tan(light.angularRadiusDeg * std::numbers::pi / 180);
        sunDisc_ = discAcross(sun_, radius);
    }

    /// Share of one stratified set that reaches the light.
    double share(glm::vec3 from, glm::vec3 normal) {
        const int edge = light_.raysEdge;
        const std::optional<Disc> disc = discFrom(from);
        if (!disc) return 1;
        int lit = 0;
        for (int i = 0; i < edge; ++i)
            for (int j = 0; j < edge; ++j) {
                const glm::dvec2 place =
                    onDisc((i + uniform_(random_)) / edge, (j + uniform_(random_)) / edge);
                const glm::vec3 towards =
                    disc->middle + place.x * disc->across + place.y * disc->other;
                lit += glm::dot(towards, normal) > 0 &&
                       reachesLight(triangles_.get(), from, towards, !light_.lamp);
            }
        return static_cast<double>(lit) / (edge * edge);
    }

  private:
    /// The light as a receiver sees it: from there, with the disc's half-axes.
    struct Disc {
        glm::dvec3 middle{}, across{}, other{};
    };

    static Disc discAcross(glm::dvec3 axis, double radius) {
        const glm::dvec3 unit = glm::normalize(axis);
        const glm::dvec3 across = glm::normalize(
            glm::cross(unit, std::abs(unit.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0)));
        return {axis, radius * across, radius * glm::cross(unit, across)};
    }

    /// Absent within a ball.
    std::optional<Disc> discFrom(glm::vec3 from) const {
        if (!light_.lamp) return sunDisc_;
        const Lamp& lamp = *light_.lamp;
        const glm::dvec3 middle = glm::dvec3(lamp.position) - glm::dvec3(from);
        if (lamp.facing) {
            Disc disc = discAcross(glm::dvec3(*lamp.facing), lamp.radiusM);
            disc.middle = middle;
            return disc;
        }
        // Of a ball the cone is seen that touches it.
        const double sine = lamp.radiusM / glm::length(middle);
        if (!(sine < 1)) return std::nullopt;
        return discAcross(middle, lamp.radiusM / std::sqrt(1 - sine * sine));
    }

    const AreaLight& light_;
    Device device_;
    Triangles triangles_;
    glm::dvec3 sun_;
    Disc sunDisc_;
    std::mt19937_64 random_;
    std::uniform_real_distribution<double> uniform_{0, 1};
};

AreaLightTruth cast(renderer::Renderer& frame, const renderer::FloatImage& positions,
                    const AreaLight& light) {
    const renderer::FloatImage planes = frame.readPlanes();
    const glm::vec3 eye = frame.scene().camera.eye();
    Caster caster(frame.scene(), light);
    AreaLightTruth truth;
    truth.visibility = renderer::FloatImage(positions.width, positions.height);
    double squares = 0;
    std::size_t penumbra = 0;
    for (int y = 0; y < positions.height; ++y)
        for (int x = 0; x < positions.width; ++x) {
            float& visibility = truth.visibility.at(x, y);
            visibility = 1;
            if (positions.at(x, y, 3) == 0) continue;
            const glm::vec3 relative(positions.at(x, y, 0), positions.at(x, y, 1),
                                     positions.at(x, y, 2));
            const glm::vec3 normal(planes.at(x, y, 0), planes.at(x, y, 1), planes.at(x, y, 2));
            const glm::vec3 from = eye + relative + kOffset * glm::length(relative) * normal;
            const double one = caster.share(from, normal);
            const double two = caster.share(from, normal);
            visibility = static_cast<float>(0.5 * (one + two));
            if (!(visibility > 0 && visibility < 1)) continue;
            squares += 0.25 * (one - two) * (one - two);
            ++penumbra;
        }
    if (penumbra > 0) truth.standardError = std::sqrt(squares / static_cast<double>(penumbra));
    return truth;
}

}  // namespace

double angularRadiusDeg(double radiusM, double distance, double depthRangeM) {
    return std::atan(radiusM / (distance * depthRangeM)) * 180 / std::numbers::pi;
}

AreaLightTruth areaLightTruth(renderer::Renderer& frame, const AreaLight& light,
                              const std::optional<std::filesystem::path>& cache) {
    if (!(light.angularRadiusDeg >= 0 && light.angularRadiusDeg <= 20))
        throw std::invalid_argument("area light: angular radius is " +
                                    std::to_string(light.angularRadiusDeg) +
                                    " degrees, must be in [0, 20]");
    if (light.raysEdge < 1 || light.raysEdge > 256)
        throw std::invalid_argument("area light: rays along an edge are " +
                                    std::to_string(light.raysEdge) + ", must be in [1, 256]");
    if (light.lamp && !(light.lamp->radiusM >= 0 && light.lamp->radiusM < kMostLampM))
        throw std::invalid_argument("area light: lamp's radius is " +
                                    std::to_string(light.lamp->radiusM) + " m, must be in [0, " +
                                    std::to_string(kMostLampM) + ")");
    if (light.lamp && light.lamp->facing && !(glm::length(*light.lamp->facing) > 0))
        throw std::invalid_argument("area light: lamp faces no direction");
    const renderer::FloatImage positions = frame.readPositions();
    if (!cache) return cast(frame, positions, light);
    const std::filesystem::path file =
        *cache / (hashOf(frame.scene(), positions, frame.scene().camera.eye(), light) + ".truth");
    if (std::filesystem::exists(file)) return unpacked(file, positions.width, positions.height);
    AreaLightTruth truth = cast(frame, positions, light);
    records::writeWholeFile(file, packed(truth));
    return truth;
}

}  // namespace demo

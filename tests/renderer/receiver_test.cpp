// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <random>

#include "renderer/shader_math.h"

namespace {

using namespace renderer::f64;

struct Projection {
    ViewConstants view{};
    ShadowConstants shadow{};
};

/// A camera at the origin that looks along -z over a map with an arbitrary affine projection.
Projection projection() {
    Projection s;
    s.view.pixelRight = {0.002, 0, 0, 0};
    s.view.pixelUp = {0, 0.002, 0, 0};
    s.view.forward = {0, 0, -1, 0};
    const glm::dvec4 rows[4] = {
        {0.10, 0.01, 0.03, 0.5}, {-0.02, 0.09, 0.05, 0.4}, {0.04, -0.06, 0.08, 0.6}, {0, 0, 0, 1}};
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column)
            s.shadow.shadowFromEyeRelative[column][row] = rows[row][column];
    s.shadow.towardsLight = {0, 1, 0, 0};
    s.shadow.map = {1000, 0.001, 0.001, 0};
    return s;
}

/// Where the ray of a pixel meets the plane through `point`.
glm::dvec3 hit(const Projection& s, glm::dvec3 point, glm::dvec3 normal, double dx, double dy) {
    const double depth = dot(point, glm::dvec3(s.view.forward));
    const glm::dvec3 ray =
        point + depth * (dx * glm::dvec3(s.view.pixelRight) + dy * glm::dvec3(s.view.pixelUp));
    return ray * (dot(point, normal) / dot(ray, normal));
}

TEST(Receiver, PlaneGradientAndFootprintMatchFiniteDifferences) {
    const Projection s = projection();
    std::mt19937_64 random(3);
    const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-52 - 1; };
    for (int trial = 0; trial < 1000; ++trial) {
        const glm::dvec3 point(2 * uniform(), 2 * uniform(), -4 + uniform());
        const glm::dvec3 normal =
            glm::normalize(glm::dvec3(uniform(), uniform(), 1 + 0.5 * uniform()));
        // Only planes that neither camera nor light sees edge-on: differences are useless there.
        const glm::dvec3 mapNormal =
            glm::normalize(glm::cross(glm::dvec3(0.10, 0.01, 0.03), {-0.02, 0.09, 0.05}));
        if (std::abs(dot(normal, glm::normalize(point))) < 0.2 ||
            std::abs(dot(normal, mapNormal)) < 0.2)
            continue;
        const ShadowReceiver receiver = shadowReceiver(point, normal, s.view, s.shadow);

        const double h = 1e-4;
        const auto at = [&](double dx, double dy) {
            return shadowReceiver(hit(s, point, normal, dx, dy), normal, s.view, s.shadow);
        };
        const glm::dvec2 alongX = (at(h, 0).uv - at(-h, 0).uv) / (2 * h);
        const glm::dvec2 alongY = (at(0, h).uv - at(0, -h).uv) / (2 * h);
        const double depthX = (at(h, 0).depth - at(-h, 0).depth) / (2 * h);
        const double depthY = (at(0, h).depth - at(0, -h).depth) / (2 * h);
        EXPECT_NEAR(dot(receiver.depthGradient, alongX), depthX, 1e-9 + 1e-6 * std::abs(depthX));
        EXPECT_NEAR(dot(receiver.depthGradient, alongY), depthY, 1e-9 + 1e-6 * std::abs(depthY));

        const double squares = dot(alongX, alongX) + dot(alongY, alongY);
        const double area = std::abs(alongX.x * alongY.y - alongX.y * alongY.x);
        const double larger =
            std::sqrt(0.5 * (squares + std::sqrt(squares * squares - 4 * area * area)));
        EXPECT_NEAR(receiver.footprintUv, std::max(area / larger, larger / 4), 1e-5 * larger);
    }
}

TEST(Receiver, DegeneratePlanesHaveNoGradient) {
    const glm::dvec3 u(1, 0, 0);
    const glm::dvec3 v(0, 1, 0);
    const glm::dvec3 d(0, 0, 1);
    EXPECT_EQ(receiverPlaneGradient(u, v, d, {1, 0, 0}),
              glm::dvec2(0));  // seen edge-on by the light
    EXPECT_EQ(receiverPlaneGradient(u, v, d, {1, 0, 1e-4}), glm::dvec2(0));  // nearly so
    EXPECT_EQ(receiverPlaneGradient(u, v, d, {0, 0, 0}), glm::dvec2(0));     // no plane
    EXPECT_EQ(receiverPlaneGradient(u, u, d, {0, 0, 1}), glm::dvec2(0));     // no map
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(receiverPlaneGradient(u, v, d, {nan, 0, 1}), glm::dvec2(0));
    EXPECT_EQ(receiverPlaneGradient(u, v, d, {-1, 0, 1}),
              glm::dvec2(1, 0));  // and a plain one: z = x
}

TEST(Receiver, FootprintIsFiniteWhereTheCameraSeesThePlaneEdgeOn) {
    const Projection s = projection();
    const ShadowReceiver receiver = shadowReceiver({0, 0, -3}, {1, 0, 0}, s.view, s.shadow);
    EXPECT_TRUE(std::isfinite(receiver.footprintUv));
    EXPECT_GT(receiver.footprintUv, 0);
}

// The least radius holds where a texel is larger than two pixels and not where it is smaller than
// one.
TEST(Receiver, LeastRadiusHoldsOnlyWhereTexelsShow) {
    Projection s = projection();
    s.shadow.kernel = {0.002, 0.00347, 1, 0};
    ShadowReceiver receiver{};
    receiver.footprintUv = 0.0011;  // a texel is 0.9 px
    EXPECT_DOUBLE_EQ(kernelRadiusUv(receiver, s.shadow), 0.002);
    receiver.footprintUv = 0.0004;  // 2.5 px
    EXPECT_DOUBLE_EQ(kernelRadiusUv(receiver, s.shadow), 0.00347);
    receiver.footprintUv = 0.001 / 1.5;
    EXPECT_NEAR(kernelRadiusUv(receiver, s.shadow), 0.5 * (0.002 + 0.00347), 1e-12);
    receiver.footprintUv = 0;
    EXPECT_DOUBLE_EQ(kernelRadiusUv(receiver, s.shadow), 0.00347);
    s.shadow.kernel.y = 0.001;  // less than the softness: no effect
    EXPECT_DOUBLE_EQ(kernelRadiusUv(receiver, s.shadow), 0.002);
    s.shadow.kernel.x = 7;  // wider than the map
    EXPECT_DOUBLE_EQ(kernelRadiusUv(receiver, s.shadow), 1);
}

}  // namespace

// SPDX-License-Identifier: MIT
// Pieces of a mesh: all of it, in its order, and none left out that a view could show.
#include "renderer/mesh_pieces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "tests/renderer/technique_case.h"

namespace {

using renderer::Bounds;
using renderer::ConvexBody;
using renderer::IndexRun;
using renderer::Mesh;
using renderer::MeshPiece;
using tests::Random;

constexpr Bounds kPlaces{{-9, -1, -9}, {9, 3, 9}};

/// Spheres here and there.
Mesh spheres(Random& random, int count) {
    Mesh mesh;
    for (int i = 0; i < count; ++i)
        mesh.append(renderer::sphere({random(-8, 8), random(0, 2), random(-8, 8)},
                                     static_cast<float>(random(0.1, 0.9)), 24, 12));
    return mesh;
}

/// From a random place in a random direction, as the shader has it.
glm::mat4 randomClip(Random& random) {
    const glm::vec3 eye(random(-8, 8), random(0.1, 3), random(-8, 8));
    const glm::vec3 target(random(-8, 8), random(-1, 3), random(-8, 8));
    return glm::perspectiveRH_ZO(static_cast<float>(random(0.05, 2)),
                                 static_cast<float>(random(0.5, 2)), 0.1F, 30.0F) *
           glm::lookAtRH(eye, target, glm::vec3(0.1F, 1, 0));
}

/// Where GL clips nothing.
bool clips(const glm::vec4& p, bool nearClamped) {
    return !(p.x >= -p.w && p.x <= p.w && p.y >= -p.w && p.y <= p.w && p.z <= p.w &&
             (nearClamped || p.z >= 0));
}

TEST(MeshPieces, AreAllTrianglesInTheirOrder) {
    Random random(3);
    const Mesh mesh = spheres(random, 3);
    const IndexRun all{3, mesh.indices.size() - 3};
    std::size_t next = all.first;
    for (const MeshPiece& piece : piecesOf(mesh, all)) {
        EXPECT_EQ(piece.run.first, next);
        EXPECT_LE(piece.run.count, 3 * renderer::kTrianglesOfAPiece);
        next += piece.run.count;
        for (std::size_t i = piece.run.first; i < next; ++i)
            for (int axis = 0; axis < 3; ++axis) {
                const float at = mesh.vertices[mesh.indices[i]].position[axis];
                ASSERT_TRUE(at >= piece.bounds.low[axis] && at <= piece.bounds.high[axis]);
            }
    }
    EXPECT_EQ(next, mesh.indices.size());
    const std::vector<MeshPiece> pieces = piecesOf(mesh, all);
    EXPECT_EQ(runsWithin(pieces, {}), std::vector<IndexRun>{all}) << "neighbours are joined";
    EXPECT_TRUE(piecesOf(mesh, {12, 0}).empty());
}

// A triangle of which a corner is not clipped, in the shader's own arithmetic, is drawn.
TEST(MeshPieces, LeaveNothingOutThatAViewHolds) {
    Random random(5);
    std::size_t left = 0, held = 0;
    const Mesh mesh = spheres(random, 20);
    const std::vector<MeshPiece> pieces = piecesOf(mesh, {0, mesh.indices.size()});
    for (int round = 0; round < 60; ++round) {
        const glm::mat4 clip = randomClip(random);
        const bool nearClamped = round % 2 == 1;
        std::vector<bool> drawn(mesh.indices.size(), false);
        for (const IndexRun& run :
             runsWithin(pieces, clipVolume(glm::dmat4(clip), nearClamped, kPlaces)))
            for (std::size_t i = run.first; i < run.first + run.count; ++i) drawn[i] = true;
        for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
            left += drawn[i] ? 0U : 1U;
            if (clips(clip * glm::vec4(mesh.vertices[mesh.indices[i]].position, 1), nearClamped))
                continue;
            ++held;
            ASSERT_TRUE(drawn[i]) << "index " << i << " in round " << round;
        }
    }
    EXPECT_GT(held, 10'000U);
    EXPECT_GT(left, mesh.indices.size() * 30) << "half of it, from within";
}

// On the plane itself, as the ground under an orthographic view from the side is.
TEST(MeshPieces, HoldWhatLiesOnAPlaneOfTheView) {
    const Mesh ground = renderer::groundPlane(4, 8, 0);
    const std::vector<MeshPiece> pieces = piecesOf(ground, {0, ground.indices.size()});
    glm::dmat4 clip(1);
    clip[3][1] = -1;  // y = 0 comes to -1
    EXPECT_EQ(runsWithin(pieces, clipVolume(clip, true, kPlaces)).size(), 1U);
    clip[3][1] = -1.001;
    EXPECT_TRUE(runsWithin(pieces, clipVolume(clip, true, kPlaces)).empty());
}

// Nothing is known of where it lies.
TEST(MeshPieces, HoldABoxThatIsNoNumber) {
    MeshPiece piece{.run = {0, 3}, .bounds = {{-9, 0, 0}, {-8, 1, 1}}};
    const ConvexBody body = clipVolume(glm::dmat4(1), false, kPlaces);
    EXPECT_TRUE(runsWithin(std::vector{piece}, body).empty());
    piece.bounds.high.x = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(runsWithin(std::vector{piece}, body).size(), 1U);
}

}  // namespace

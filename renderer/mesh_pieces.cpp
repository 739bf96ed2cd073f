// SPDX-License-Identifier: MIT
#include "renderer/mesh_pieces.h"

#include <algorithm>

namespace renderer {
namespace {

// Of the terms' size: products, sums and a difference, each rounded to 24 bits, are off by at most
// some twenty times 2^-24.
constexpr double kRounding = 2e-6;

glm::dvec4 rowOf(const glm::dmat4& m, int row) {
    return {m[0][row], m[1][row], m[2][row], m[3][row]};
}

/// Whether all of a box is on the wrong side of a plane; not of a box or plane that is no number.
bool outside(const Bounds& box, const glm::dvec4& plane) {
    double most = plane.w;
    for (int axis = 0; axis < 3; ++axis)
        most += plane[axis] * static_cast<double>(plane[axis] > 0 ? box.high[axis] : box.low[axis]);
    return most < 0;
}

}  // namespace

std::vector<MeshPiece> piecesOf(const Mesh& mesh, const IndexRun& run) {
    std::vector<MeshPiece> pieces;
    const std::size_t end = run.first + run.count;
    for (std::size_t first = run.first; first < end; first += 3 * kTrianglesOfAPiece) {
        const auto at = [&](std::size_t i) { return mesh.vertices[mesh.indices[i]].position; };
        MeshPiece piece{.run = {first, std::min(3 * kTrianglesOfAPiece, end - first)},
                        .bounds = {at(first), at(first)}};
        for (std::size_t i = first; i < first + piece.run.count; ++i) {
            piece.bounds.low = glm::min(piece.bounds.low, at(i));
            piece.bounds.high = glm::max(piece.bounds.high, at(i));
        }
        pieces.push_back(piece);
    }
    return pieces;
}

ConvexBody clipVolume(const glm::dmat4& clipFromWorld, bool nearClamped, const Bounds& places) {
    const glm::dvec4 x = rowOf(clipFromWorld, 0);
    const glm::dvec4 y = rowOf(clipFromWorld, 1);
    const glm::dvec4 z = rowOf(clipFromWorld, 2);
    const glm::dvec4 w = rowOf(clipFromWorld, 3);
    ConvexBody body{w + x, w - x, w + y, w - y, w - z};
    if (!nearClamped) body.push_back(z);
    const glm::dvec4 farthest(
        glm::max(glm::abs(glm::dvec3(places.low)), glm::abs(glm::dvec3(places.high))), 1);
    double terms = 0;
    for (int row = 0; row < 4; ++row)
        terms = std::max(terms, glm::dot(glm::abs(rowOf(clipFromWorld, row)), farthest));
    for (glm::dvec4& plane : body) plane.w += kRounding * terms;
    return body;
}

std::vector<IndexRun> runsWithin(std::span<const MeshPiece> pieces, const ConvexBody& body) {
    std::vector<IndexRun> runs;
    for (const MeshPiece& piece : pieces) {
        if (std::any_of(body.begin(), body.end(),
                        [&](const glm::dvec4& plane) { return outside(piece.bounds, plane); }))
            continue;
        if (!runs.empty() && runs.back().first + runs.back().count == piece.run.first)
            runs.back().count += piece.run.count;
        else
            runs.push_back(piece.run);
    }
    return runs;
}

}  // namespace renderer

// SPDX-License-Identifier: MIT
// Short runs of a mesh's triangles with the box that each lies in, so that a map of a part of the
// scene, or a view of one, is spared the triangles elsewhere. The order of the triangles stays, and
// with it what is drawn over what.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "renderer/mesh.h"
#include "renderer/view_volume.h"

namespace renderer {

/// Indices of a mesh, three to a triangle.
struct IndexRun {
    std::size_t first = 0, count = 0;

    bool operator==(const IndexRun&) const = default;
};

struct MeshPiece {
    IndexRun run;
    Bounds bounds;
};

/// A box around more triangles leaves fewer of them out; around fewer it takes longer to find out
/// than to draw them (chosen by eye).
inline constexpr std::size_t kTrianglesOfAPiece = 128;

/// Of a run of the mesh, in its order.
std::vector<MeshPiece> piecesOf(const Mesh& mesh, const IndexRun& run);

/// Where a vertex must lie to be clipped by no plane of the volume that a matrix takes to clip
/// space, under a depth from zero to one; looser by what a shader may round in single precision
/// anywhere in `places`. With `nearClamped` nothing is too near.
ConvexBody clipVolume(const glm::dmat4& clipFromWorld, bool nearClamped, const Bounds& places);

/// Those that may reach into a body, neighbours joined; of a triangle within the body none is left
/// out.
std::vector<IndexRun> runsWithin(std::span<const MeshPiece> pieces, const ConvexBody& body);

}  // namespace renderer

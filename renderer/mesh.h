// SPDX-License-Identifier: MIT
// Triangle meshes and the shapes that the built-in scenes are made of. Lengths in metres, y up.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

namespace renderer {

struct Vertex {
    glm::vec3 position;
    glm::vec3 normal;  ///< for shading; which side a triangle shows does not depend on it
};

struct Mesh {
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> indices;  ///< three to a triangle

    void append(const Mesh& other);
};

struct Bounds {
    glm::vec3 low{0}, high{0};
};
/// All zero for a mesh without vertices.
Bounds boundsOf(const Mesh& mesh);

/// Moves and turns a mesh; the matrix must not shear or scale unevenly (normals go along with it).
Mesh transformed(Mesh mesh, const glm::mat4& matrix);

/// Every triangle as parts * parts flat ones: the same picture at the cost of more triangles.
Mesh split(const Mesh& mesh, int parts);

/// A square of side 2 * halfExtent in the plane y = height, in cells * cells quads (a single huge
/// quad would lose bits in the rasteriser's interpolation).
Mesh groundPlane(float halfExtent, int cells, float height = 0);
/// The same with a height for every place. Normals are those of the heights, not of the triangles.
Mesh heightField(float halfExtent, int cells, const std::function<float(float x, float z)>& height);
Mesh box(glm::vec3 low, glm::vec3 high);
Mesh sphere(glm::vec3 centre, float radius, int slices = 96, int stacks = 48);
/// Around the vertical axis, closed by discs.
Mesh cylinder(glm::vec3 bottomCentre, float radius, float height, int slices = 64);

/// A closed ring of triangles along a profile of (radius, height), from top to bottom or back, that
/// is turned around the vertical. Corners of the profile are rounded by the shading alone.
Mesh lathe(glm::vec3 foot, const std::vector<glm::vec2>& profile, int slices = 96);

/// The flat ring between two outlines in the plane y = 0, both star-shaped about the origin and
/// given as radius over angle. An inner outline of radius 0 gives a full plate.
Mesh flatRing(const std::function<float(float)>& outer, const std::function<float(float)>& inner,
              const std::vector<float>& angles);

}  // namespace renderer

// SPDX-License-Identifier: MIT
#include "renderer/mesh.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace renderer {
namespace {

void addQuad(Mesh& mesh, const glm::vec3 (&corners)[4], glm::vec3 normal) {
    const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const glm::vec3& corner : corners) mesh.vertices.push_back({corner, normal});
    for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) mesh.indices.push_back(base + i);
}

/// Two triangles between four vertices of a grid.
void addCell(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    for (const std::uint32_t i : {a, b, c, a, c, d}) mesh.indices.push_back(i);
}

glm::vec3 onCircle(float radius, float angle, float height) {
    return {radius * std::cos(angle), height, radius * std::sin(angle)};
}

}  // namespace

void Mesh::append(const Mesh& other) {
    const auto base = static_cast<std::uint32_t>(vertices.size());
    vertices.insert(vertices.end(), other.vertices.begin(), other.vertices.end());
    for (const std::uint32_t index : other.indices) indices.push_back(base + index);
}

Bounds boundsOf(const Mesh& mesh) {
    if (mesh.vertices.empty()) return {};
    Bounds bounds{mesh.vertices.front().position, mesh.vertices.front().position};
    for (const Vertex& vertex : mesh.vertices) {
        bounds.low = glm::min(bounds.low, vertex.position);
        bounds.high = glm::max(bounds.high, vertex.position);
    }
    return bounds;
}

Mesh transformed(Mesh mesh, const glm::mat4& matrix) {
    for (Vertex& vertex : mesh.vertices) {
        vertex.position = glm::vec3(matrix * glm::vec4(vertex.position, 1));
        vertex.normal = glm::normalize(glm::mat3(matrix) * vertex.normal);
    }
    return mesh;
}

Mesh split(const Mesh& mesh, int parts) {
    Mesh fine;
    const auto n = static_cast<std::uint32_t>(parts);
    fine.vertices.reserve(mesh.indices.size() / 3 * (n + 1) * (n + 2) / 2);
    fine.indices.reserve(mesh.indices.size() * n * n);
    for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
        const Vertex& a = mesh.vertices[mesh.indices[t]];
        const Vertex& b = mesh.vertices[mesh.indices[t + 1]];
        const Vertex& c = mesh.vertices[mesh.indices[t + 2]];
        const auto base = static_cast<std::uint32_t>(fine.vertices.size());
        // Row i runs across the triangle, i + 1 vertices from side ab to side ac.
        const auto at = [&](std::uint32_t i, std::uint32_t j) {
            return base + i * (i + 1) / 2 + j;
        };
        for (std::uint32_t i = 0; i <= n; ++i)
            for (std::uint32_t j = 0; j <= i; ++j) {
                const float u = static_cast<float>(i - j) / static_cast<float>(n);
                const float v = static_cast<float>(j) / static_cast<float>(n);
                fine.vertices.push_back(
                    {a.position + u * (b.position - a.position) + v * (c.position - a.position),
                     glm::normalize((1 - u - v) * a.normal + u * b.normal + v * c.normal)});
            }
        for (std::uint32_t i = 0; i < n; ++i)
            for (std::uint32_t j = 0; j <= i; ++j) {
                for (const std::uint32_t index : {at(i, j), at(i + 1, j), at(i + 1, j + 1)})
                    fine.indices.push_back(index);
                if (j == i) continue;
                for (const std::uint32_t index : {at(i, j), at(i + 1, j + 1), at(i, j + 1)})
                    fine.indices.push_back(index);
            }
    }
    return fine;
}

Mesh groundPlane(float halfExtent, int cells, float height) {
    return heightField(halfExtent, cells, [height](float, float) { return height; });
}

Mesh heightField(float halfExtent, int cells,
                 const std::function<float(float x, float z)>& height) {
    Mesh mesh;
    const auto edge = static_cast<std::uint32_t>(cells) + 1;
    for (std::uint32_t z = 0; z < edge; ++z)
        for (std::uint32_t x = 0; x < edge; ++x) {
            const auto along = [&](std::uint32_t i) {
                return halfExtent * (2 * static_cast<float>(i) / static_cast<float>(cells) - 1);
            };
            const float px = along(x);
            const float pz = along(z);
            const float step = halfExtent / static_cast<float>(cells);
            const glm::vec3 normal(height(px - step, pz) - height(px + step, pz), 2 * step,
                                   height(px, pz - step) - height(px, pz + step));
            mesh.vertices.push_back({{px, height(px, pz), pz}, glm::normalize(normal)});
        }
    for (std::uint32_t z = 0; z + 1 < edge; ++z)
        for (std::uint32_t x = 0; x + 1 < edge; ++x) {
            const std::uint32_t corner = z * edge + x;
            addCell(mesh, corner, corner + edge, corner + edge + 1, corner + 1);
        }
    return mesh;
}

Mesh box(glm::vec3 low, glm::vec3 high) {
    Mesh mesh;
    const auto corner = [&](int x, int y, int z) {
        return glm::vec3(x != 0 ? high.x : low.x, y != 0 ? high.y : low.y, z != 0 ? high.z : low.z);
    };
    addQuad(mesh, {corner(0, 0, 0), corner(0, 0, 1), corner(0, 1, 1), corner(0, 1, 0)}, {-1, 0, 0});
    addQuad(mesh, {corner(1, 0, 0), corner(1, 1, 0), corner(1, 1, 1), corner(1, 0, 1)}, {1, 0, 0});
    addQuad(mesh, {corner(0, 0, 0), corner(1, 0, 0), corner(1, 0, 1), corner(0, 0, 1)}, {0, -1, 0});
    addQuad(mesh, {corner(0, 1, 0), corner(0, 1, 1), corner(1, 1, 1), corner(1, 1, 0)}, {0, 1, 0});
    addQuad(mesh, {corner(0, 0, 0), corner(0, 1, 0), corner(1, 1, 0), corner(1, 0, 0)}, {0, 0, -1});
    addQuad(mesh, {corner(0, 0, 1), corner(1, 0, 1), corner(1, 1, 1), corner(0, 1, 1)}, {0, 0, 1});
    return mesh;
}

Mesh sphere(glm::vec3 centre, float radius, int slices, int stacks) {
    Mesh mesh;
    const auto row = static_cast<std::uint32_t>(slices) + 1;
    for (int stack = 0; stack <= stacks; ++stack)
        for (int slice = 0; slice <= slices; ++slice) {
            const float polar =
                glm::pi<float>() * static_cast<float>(stack) / static_cast<float>(stacks);
            const float angle =
                glm::two_pi<float>() * static_cast<float>(slice) / static_cast<float>(slices);
            const glm::vec3 normal = onCircle(std::sin(polar), angle, std::cos(polar));
            mesh.vertices.push_back({centre + radius * normal, normal});
        }
    for (std::uint32_t stack = 0; stack < static_cast<std::uint32_t>(stacks); ++stack)
        for (std::uint32_t slice = 0; slice + 1 < row; ++slice) {
            const std::uint32_t corner = stack * row + slice;
            addCell(mesh, corner, corner + 1, corner + row + 1, corner + row);
        }
    return mesh;
}

Mesh cylinder(glm::vec3 bottomCentre, float radius, float height, int slices) {
    Mesh mesh;
    std::vector<float> angles;
    for (int slice = 0; slice <= slices; ++slice) {
        const float angle =
            glm::two_pi<float>() * static_cast<float>(slice) / static_cast<float>(slices);
        angles.push_back(angle);
        const glm::vec3 normal = onCircle(1, angle, 0);
        mesh.vertices.push_back({bottomCentre + onCircle(radius, angle, 0), normal});
        mesh.vertices.push_back({bottomCentre + onCircle(radius, angle, height), normal});
    }
    for (std::uint32_t slice = 0; slice < static_cast<std::uint32_t>(slices); ++slice)
        addCell(mesh, 2 * slice, 2 * slice + 1, 2 * slice + 3, 2 * slice + 2);
    for (const float y : {0.0F, height}) {
        Mesh cap = flatRing([&](float) { return radius; }, [](float) { return 0.0F; }, angles);
        for (Vertex& vertex : cap.vertices) {
            vertex.position += bottomCentre + glm::vec3(0, y, 0);
            vertex.normal = {0, y > 0 ? 1 : -1, 0};
        }
        mesh.append(cap);
    }
    return mesh;
}

Mesh lathe(glm::vec3 foot, const std::vector<glm::vec2>& profile, int slices) {
    Mesh mesh;
    const auto row = static_cast<std::uint32_t>(slices) + 1;
    for (std::size_t i = 0; i < profile.size(); ++i) {
        const glm::vec2 along =
            profile[std::min(i + 1, profile.size() - 1)] - profile[i == 0 ? 0 : i - 1];
        const glm::vec2 across = glm::normalize(glm::vec2(-along.y, along.x));
        for (int slice = 0; slice <= slices; ++slice) {
            const float angle =
                glm::two_pi<float>() * static_cast<float>(slice) / static_cast<float>(slices);
            mesh.vertices.push_back({foot + onCircle(profile[i].x, angle, profile[i].y),
                                     onCircle(across.x, angle, across.y)});
        }
    }
    for (std::uint32_t i = 0; i + 1 < profile.size(); ++i)
        for (std::uint32_t slice = 0; slice + 1 < row; ++slice) {
            const std::uint32_t corner = i * row + slice;
            addCell(mesh, corner, corner + 1, corner + row + 1, corner + row);
        }
    return mesh;
}

Mesh flatRing(const std::function<float(float)>& outer, const std::function<float(float)>& inner,
              const std::vector<float>& angles) {
    Mesh mesh;
    for (const float angle : angles) {
        mesh.vertices.push_back({onCircle(inner(angle), angle, 0), {0, 1, 0}});
        mesh.vertices.push_back({onCircle(outer(angle), angle, 0), {0, 1, 0}});
    }
    for (std::uint32_t i = 0; i + 1 < angles.size(); ++i)
        addCell(mesh, 2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1);
    return mesh;
}

}  // namespace renderer

// SPDX-License-Identifier: MIT
#include "renderer/scene_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "tests/temporary_folder.h"
#include "tests/thrown_message.h"

namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using tests::messageOf;

/// A wedge of the given size far from the origin, as OBJ: a quad, two triangles, one without
/// normals.
const char* const kObj = R"(# a wedge
v 1000 50 7
v 1004 50 7
v 1004 50 9
v 1000 50 9
v 1000 52 9
f 1 2 3 4
f 1 2 5
f 2 3 5
)";

const char* const kPly = R"(ply
format ascii 1.0
element vertex 4
property float x
property float y
property float z
element face 2
property list uchar int vertex_indices
end_header
0 0 0
0.002 0 0
0 0.004 0
0 0 0.001
3 0 1 2
3 0 2 3
)";

/// One triangle (0,0,0) (1,0,0) (0,2,0), its node scaled by 10 along x, its colour red.
const char* const kGltf = R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
"nodes": [{"mesh": 0, "scale": [10, 1, 1]}],
"materials": [{"pbrMetallicRoughness": {"baseColorFactor": [0.7, 0.1, 0.2, 1]}}],
"meshes": [{"name": "sail", "primitives": [{"attributes": {"POSITION": 1}, "indices": 0, "material": 0}]}],
"buffers": [{"byteLength": 44, "uri":
"data:application/octet-stream;base64,AAABAAIAAAAAAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAAAAAAAAQAAAAAA="}],
"bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 6, "target": 34963},
                {"buffer": 0, "byteOffset": 8, "byteLength": 36, "target": 34962}],
"accessors": [{"bufferView": 0, "componentType": 5123, "count": 3, "type": "SCALAR", "max": [2], "min": [0]},
              {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC3", "max": [1, 2, 0], "min": [0, 0, 0]}]}
)";

class SceneFile : public testing::Test {
  protected:
    std::filesystem::path written(const std::string& name, const std::string& text) {
        std::ofstream(folder_.path() / name, std::ios::binary) << text;
        return folder_.path() / name;
    }
    std::string refusal(const std::filesystem::path& file) {
        try {
            renderer::loadScene(file);
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return "accepted";
    }
    const tests::TemporaryFolder folder_;
};

/// On the ground, in the middle, of the promised size, with normals and a window that can be made.
void expectStandsWell(const renderer::Scene& scene, std::size_t triangles) {
    EXPECT_EQ(casterTriangles(scene), triangles);
    const glm::vec3 span = scene.casters.high - scene.casters.low;
    EXPECT_NEAR(std::max({span.x, span.y, span.z}), renderer::kModelSizeM, 1e-4);
    EXPECT_NEAR(scene.casters.low.y, 0, 1e-5);
    EXPECT_NEAR(scene.casters.low.x, -scene.casters.high.x, 1e-4);
    EXPECT_NEAR(scene.casters.low.z, -scene.casters.high.z, 1e-4);
    EXPECT_GT(scene.softnessM, 0);
    EXPECT_FALSE(scene.objects.front().casts) << "there is a ground under it";
    for (const renderer::SceneObject& object : scene.objects)
        for (const renderer::Vertex& vertex : object.mesh.vertices)
            EXPECT_NEAR(glm::length(vertex.normal), 1, 1e-4) << object.name;
    const glm::vec3 eye = scene.camera.eye();
    EXPECT_GT(glm::distance(eye, 0.5F * (scene.casters.low + scene.casters.high)),
              0.5F * glm::length(span))
        << "the camera is outside";
}

TEST_F(SceneFile, ReadsObjPlyAndGltf) {
    const renderer::Scene obj = renderer::loadScene(written("a wedge.obj", kObj));
    expectStandsWell(obj, 4);
    EXPECT_EQ(obj.name, "a_wedge");
    EXPECT_EQ(obj.source, (folder_.path() / "a wedge.obj").string());
    expectStandsWell(renderer::loadScene(written("sliver.ply", kPly)), 2);
    const renderer::Scene gltf = renderer::loadScene(written("sail.gltf", kGltf));
    expectStandsWell(gltf, 1);
    const glm::vec3 span = gltf.casters.high - gltf.casters.low;
    EXPECT_NEAR(span.x / span.y, 5, 1e-3) << "the node's scale counts";
    EXPECT_NEAR(gltf.objects.back().material.albedo.r, 0.7, 1e-3);
    EXPECT_NEAR(gltf.objects.back().material.albedo.g, 0.1, 1e-3);
}

TEST_F(SceneFile, NamesFileAndFaultInOneLine) {
    const std::pair<std::filesystem::path, const char*> bad[] = {
        {folder_.path() / "missing.obj", "no such model file"},
        {folder_.path(), "is not a file"},
        {written("empty.ply", ""), "is empty"},
        {written("noise.gltf", "{\"asset\""), ""},
        {written("cut.gltf", std::string(kGltf).substr(0, 700)), ""},
        {written("prose.xyz", "no model at all"), ""},
        {written("header.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nprope"),
         "ends within its header"},
        {written("start.ply", "ply\n"), "ends within its header"},
        {written("cut.ply", std::string(kPly).substr(0, std::string(kPly).rfind("\n3"))),
         "its header announces "},
        {written("many.ply", std::string(kPly).replace(std::string(kPly).find("vertex 4"), 8,
                                                       "vertex 4000000000")),
         "vertex 4: the line \"3 0 1 2\" does not hold"},
        {written("more vertices.ply",
                 std::string(kPly)
                     .replace(std::string(kPly).find("vertex 4"), 8, "vertex 4000000000")
                     .substr(0, std::string(kPly).find("\n3 0 1") + 10)),
         "its header announces 4000000002 elements, but only 4 lines follow"},
        {written("empty lines.ply",
                 std::string(kPly).replace(std::string(kPly).find("0.002"), 5, "\n\n0.002")),
         "vertex 1: empty lines stand before it"},
        {written("vertices.ply", std::string(kPly).substr(0, std::string(kPly).find("0.002"))),
         "its header announces 6 elements, but only 1 lines follow"},
        {written("gap.ply",
                 std::string(kPly).replace(std::string(kPly).find("0.002 0 0"), 9, "0.002 0")),
         "vertex 1: the line \"0.002 0\" does not hold the values that the header announces"},
        {written("corner.ply",
                 std::string(kPly).replace(std::string(kPly).find("3 0 2 3"), 7, "4 0 2 3")),
         "face 1: the line \"4 0 2 3\" does not hold"},
        {written("more.ply",
                 std::string(kPly).replace(std::string(kPly).find("0.002 0 0"), 9, "0.002 0 0 7")),
         "vertex 1: the line \"0.002 0 0 7\" does not hold"},
        {written("none.ply", std::string(kPly).replace(std::string(kPly).find("3 0 2 3"), 7, "0")),
         "face 1: the line \"0\" does not hold"},
#ifndef __SANITIZE_ADDRESS__  // which ends the program that asks for 34 GB
        {written("list.ply",
                 "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float x\n"
                 "property float y\nproperty float z\nelement face 1\n"
                 "property list uint int vertex_indices\nend_header\n" +
                     std::string(12, '\0') + "\377\377\377\377" + std::string(12, '\0')),
         "announces more than fits into memory"},
#endif
        {written("binary none.ply",
                 "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float x\n"
                 "property float y\nproperty float z\nelement face 2\n"
                 "property list uchar uchar vertex_indices\nend_header\n" +
                     std::string(12, '\0') + "\3" + std::string(4, '\0')),
         "mesh 0, face 1: has no corners"},
        {written("chunk.glb", std::string("glTF\2\0\0\0\377\0\0\0\377\377\377\377JSON", 20)),
         "its first chunk is to have 4294967295 bytes, but only 0 follow"},
        {written("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"), ""},
        {written("line.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n"), ""},
        {written("beyond.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"), ""},
        {written("point.obj", "v 3 3 3\nv 3 3 3\nv 3 3 3\nf 1 2 3\n"), "lie in one point"},
        {written("nan.ply", std::string(kPly).replace(std::string(kPly).find("0.002"), 5, "nan")),
         ""},
    };
    for (const auto& [file, fault] : bad) {
        const std::string message = refusal(file);
        EXPECT_THAT(message, StartsWith(file.string() + ": ")) << file;
        EXPECT_THAT(message, HasSubstr(fault)) << file;
        EXPECT_THAT(message, Not(HasSubstr("\n"))) << file;
        EXPECT_GT(message.size(), file.string().size() + 5) << message;
    }
}

// An empty line, tabs and returns are none of its faults.
TEST_F(SceneFile, ReadsAPlyFileWhoseRowsAreWhole) {
    std::string ply = kPly;
    ply.replace(ply.find("0.002 0 0"), 9, "\n  0.002\t0 0\r");
    expectStandsWell(renderer::loadScene(written("loose.ply", ply)), 2);
}

TEST_F(SceneFile, SaysWhatItLeavesOut) {
    std::string gltf = kGltf;
    ASSERT_TRUE(renderer::loadScene(written("whole.gltf", gltf)).notes.empty());
    const renderer::Scene obj =
        renderer::loadScene(written("bare.obj", "mtllib none.mtl\n" + std::string(kObj)));
    ASSERT_FALSE(obj.notes.empty());
    EXPECT_THAT(obj.notes.front(), StartsWith(obj.source + ": OBJ: "));
    EXPECT_THAT(obj.notes.front(), HasSubstr("none.mtl"));
}

// 10^30 of a unit, and 10^-30: squares of neither are floats.
TEST_F(SceneFile, NormalsAreThoseOfTheTrianglesAtAnyScale) {
    for (const char* scale : {"e30", "e-30", ""}) {
        std::string text;
        for (const char* vertex : {"0 0 0", "1 0 0", "0 0 1", "0 1 0"}) {
            text += "v";
            for (const char* c = vertex; *c != 0; ++c)
                if (*c != ' ') text += std::string(" ") + *c + scale;
            text += "\n";
        }
        text += "f 1 2 3\nf 1 4 2\n";
        const renderer::Scene scene = renderer::loadScene(written("scaled.obj", text));
        const renderer::Mesh& mesh = scene.objects.back().mesh;
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            const auto at = [&](std::size_t corner) {
                return mesh.vertices[mesh.indices[i + corner]];
            };
            const glm::vec3 normal = glm::normalize(
                glm::cross(at(1).position - at(0).position, at(2).position - at(0).position));
            // Two triangles at a right angle share an edge: its corners lie between.
            for (std::size_t corner = 0; corner < 3; ++corner)
                EXPECT_GT(glm::dot(at(corner).normal, normal), 0.7F) << scale << ' ' << i;
        }
    }
}

// A floor that is the lowest part of the model is not that of the scene.
TEST_F(SceneFile, TheGroundLiesBelowTheModel) {
    const renderer::Scene scene = renderer::loadScene(written("low.obj", kObj));
    for (const renderer::Vertex& vertex : scene.objects.front().mesh.vertices) {
        EXPECT_LT(vertex.position.y, -1e-3F);
        EXPECT_GT(vertex.position.y, -1e-2F);
    }
}

TEST_F(SceneFile, TakesTheOptionsOfAScene) {
    const std::string file = written("x.obj", kObj).string();
    const renderer::Scene scene = renderer::openScene(file + ":cascades=3:lamps=2");
    EXPECT_EQ(scene.cascades, 3);
    EXPECT_EQ(scene.lamps.size(), 2U);
    EXPECT_EQ(scene.source, file + ":cascades=3:lamps=2");
    EXPECT_EQ(scene.name, "x_3_cascades_2_lamps") << "fit for a file's name";
    EXPECT_EQ(casterTriangles(renderer::openScene(file + ":triangles=16")), 16U);
    const std::pair<std::string, std::string> bad[] = {
        {file + ":cascade=2", "option \"cascade=2\" is not known; known are "},
        {file + ":cascades", "option \"cascades\" is not known; known are "},
        {file + ":lamps=2:", "option \"\" is not known"},
        {file + ":cascades=9", "cascades is \"9\", must be a whole number from 1 to 8"},
        {file + ":lamps=64", "lamps is \"64\", must be a whole number from 1 to 63"}};
    for (const auto& [source, fault] : bad)
        EXPECT_THAT(messageOf<std::invalid_argument>([&] { renderer::openScene(source); }),
                    StartsWith("scene \"" + source + "\": " + fault));
    for (const std::string missing : {"/no/such.obj", "/no/such:one.obj"})
        EXPECT_EQ(messageOf([&] { renderer::openScene(missing + ":cascades=2:lamps=1"); }),
                  missing + ": no such model file");
}

TEST_F(SceneFile, AFileWhoseNameHoldsWhatLooksLikeAnOptionIsThatFile) {
    const std::string file = written("y.obj:cascades=2.obj", kObj).string();
    EXPECT_EQ(renderer::openScene(file).cascades, 1);
    EXPECT_EQ(renderer::openScene(file + ":cascades=4").cascades, 4);
    EXPECT_EQ(renderer::withoutOptions(file + ":cascades=4"), file);
    EXPECT_EQ(renderer::withoutOptions("yard:cascades=4"), "yard");
}

TEST_F(SceneFile, AScenesNameGoesBeforeAFile) {
    EXPECT_EQ(renderer::openScene("yard").name, "yard");
    EXPECT_EQ(renderer::openScene("city:triangles=9000").source, "city:triangles=9000");
    EXPECT_EQ(renderer::openScene(written("x.obj", kObj).string()).name, "x");
    EXPECT_THROW(renderer::openScene("gardn"), std::invalid_argument);
    EXPECT_THROW(renderer::openScene("./yard"), std::runtime_error) << "a path, and not there";
}

}  // namespace

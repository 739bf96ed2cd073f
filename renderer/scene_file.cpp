// SPDX-License-Identifier: MIT
#include "renderer/scene_file.h"

#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <assimp/DefaultLogger.hpp>
#include <assimp/Importer.hpp>
#include <assimp/LogStream.hpp>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>
#include <exception>
#include <fstream>
#include <new>
#include <sstream>
#include <stdexcept>

#include "renderer/scenes/scenes.h"

namespace renderer {
namespace {

constexpr Material kPlain{.albedo = {0.50F, 0.47F, 0.43F}, .gloss = 0.15F};
/// Of the model's size, chosen by eye: the built-in scenes have about as much.
constexpr double kSoftnessOfSize = 0.012;
constexpr std::size_t kMostTriangles = 50'000'000;
/// Of the ground under the model's lowest point, of the model's size: a floor of its own would
/// otherwise show through it in scraps. Far less than the softness.
constexpr float kGroundBelowOfSize = 1e-3F;

[[noreturn]] void reject(const std::filesystem::path& file, const std::string& problem) {
    throw std::runtime_error(file.string() + ": " + problem);
}

bool isFinite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

glm::vec3 toGlm(const aiVector3D& v) {
    return {v.x, v.y, v.z};
}

Material materialOf(const aiScene& model, const aiMesh& mesh) {
    aiColor4D colour;
    if (mesh.mMaterialIndex >= model.mNumMaterials) return kPlain;
    const aiMaterial& own = *model.mMaterials[mesh.mMaterialIndex];
    if (own.Get(AI_MATKEY_BASE_COLOR, colour) != aiReturn_SUCCESS &&
        own.Get(AI_MATKEY_COLOR_DIFFUSE, colour) != aiReturn_SUCCESS)
        return kPlain;
    Material material = kPlain;
    // A black or dazzling surface would show no shadows.
    material.albedo = glm::clamp(glm::vec3(colour.r, colour.g, colour.b), 0.05F, 0.8F);
    return isFinite(material.albedo) ? material : kPlain;
}

/// Its triangles; Assimp has made them of whatever the file holds.
Mesh meshOf(const std::filesystem::path& file, const aiMesh& own) {
    Mesh mesh;
    mesh.vertices.reserve(own.mNumVertices);
    for (unsigned i = 0; i < own.mNumVertices; ++i) {
        const glm::vec3 position = toGlm(own.mVertices[i]);
        if (!isFinite(position))
            reject(file, "mesh \"" + std::string(own.mName.C_Str()) + "\", vertex " +
                             std::to_string(i) + ": a coordinate is not a finite number");
        const glm::vec3 normal =
            own.HasNormals() ? glm::normalize(toGlm(own.mNormals[i])) : glm::vec3(0);
        mesh.vertices.push_back({position, isFinite(normal) ? normal : glm::vec3(0)});
    }
    for (unsigned i = 0; i < own.mNumFaces; ++i) {
        const aiFace& face = own.mFaces[i];
        if (face.mNumIndices != 3) continue;  // points and lines throw no shadow
        for (unsigned corner = 0; corner < 3; ++corner) {
            if (face.mIndices[corner] >= own.mNumVertices)
                reject(file, "mesh \"" + std::string(own.mName.C_Str()) + "\", triangle " +
                                 std::to_string(i) + ": vertex " +
                                 std::to_string(face.mIndices[corner]) + " does not exist");
            mesh.indices.push_back(face.mIndices[corner]);
        }
    }
    return mesh;
}

/// Where the file has none and Assimp, in single precision and before the model is scaled, makes
/// none: of very large or small coordinates.
void addNormals(Mesh& mesh) {
    std::vector<glm::dvec3> sums(mesh.vertices.size(), glm::dvec3(0));
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const glm::dvec3 a(mesh.vertices[mesh.indices[i]].position);
        const glm::dvec3 b(mesh.vertices[mesh.indices[i + 1]].position);
        const glm::dvec3 c(mesh.vertices[mesh.indices[i + 2]].position);
        for (std::size_t corner = 0; corner < 3; ++corner)
            sums[mesh.indices[i + corner]] += glm::cross(b - a, c - a);
    }
    for (std::size_t i = 0; i < sums.size(); ++i) {
        glm::vec3& normal = mesh.vertices[i].normal;
        if (glm::length(normal) > 0.5F) continue;
        // Corners of triangles without an area have none.
        const double length = glm::length(sums[i]);
        normal = length > 0 ? glm::vec3(sums[i] / length) : glm::vec3(0, 1, 0);
    }
}

std::string oneLine(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    while (!text.empty() && (text.back() == ' ' || text.back() == '.')) text.pop_back();
    return text.empty() ? "not readable as a model" : text;
}

/// What Assimp finds wrong with a file that it reads nevertheless.
class ImportNotes {
  public:
    ImportNotes() {
        Assimp::DefaultLogger::create("", Assimp::Logger::NORMAL, 0);
        Assimp::DefaultLogger::get()->attachStream(&stream_, kSeverities);
    }
    ~ImportNotes() {
        Assimp::DefaultLogger::get()->detachStream(&stream_, kSeverities);
        Assimp::DefaultLogger::kill();
    }
    ImportNotes(const ImportNotes&) = delete;
    ImportNotes& operator=(const ImportNotes&) = delete;

    const std::vector<std::string>& all() const { return stream_.notes; }

  private:
    static constexpr unsigned kSeverities = Assimp::Logger::Warn | Assimp::Logger::Err;
    struct Stream : Assimp::LogStream {
        std::vector<std::string> notes;
        void write(const char* message) override {
            // "Warn,  T0: " goes before it.
            const std::string note = oneLine(message);
            const std::size_t start = note.find(": ");
            const std::string told = start == std::string::npos ? note : note.substr(start + 2);
            // Of what Assimp made of the file, as vertices that nothing uses.
            if (told.rfind("Validation warning", 0) != 0) notes.push_back(told);
        }
    };
    Stream stream_;
};

/// What the header of a PLY file says of one of its elements.
struct PlyElement {
    std::string name;
    double count = 0;
    std::vector<bool> lists;  // of each property: a list, or a single value
};

/// Whether a row of an ASCII file has the values of its element and no more: Assimp takes what lies
/// elsewhere for what is missing.
bool isRowOf(const PlyElement& element, const std::string& row) {
    const char* at = row.c_str();
    const auto skipWord = [&] {
        at += std::strspn(at, " \t\r");
        const char* const begin = at;
        at += std::strcspn(at, " \t\r");
        return std::string_view(begin, static_cast<std::size_t>(at - begin));
    };
    for (const bool list : element.lists) {
        const std::string_view word = skipWord();
        if (word.empty()) return false;
        if (!list) continue;
        std::size_t length = 0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), length);
        if (error != std::errc() || (length == 0 && element.name == "face")) return false;
        for (std::size_t i = 0; i < length; ++i)
            if (skipWord().empty()) return false;
    }
    return skipWord().empty();
}

/// The rows behind the header, a line each; how many there are, all elements having as many as
/// announced or the file being at its end.
double checkPlyRows(const std::filesystem::path& file, std::istream& in,
                    const std::vector<PlyElement>& elements) {
    double rows = 0;
    std::string line;
    for (const PlyElement& element : elements)
        for (double i = 0; i < element.count; ++i) {
            int empty = 0;
            for (; std::getline(in, line); ++empty)
                if (line.find_first_not_of(" \t\r") != std::string::npos) break;
            if (!in) return rows;
            const auto refuse = [&](const std::string& problem) {
                std::ostringstream place;
                place.precision(15);
                place << element.name << " " << i << ": " << problem;
                reject(file, place.str());
            };
            // Assimp skips one, and at a second takes the rows that follow for something else.
            if (empty > 1) refuse("empty lines stand before it");
            if (!isRowOf(element, line))
                refuse("the line \"" + oneLine(line) +
                       "\" does not hold the values that the header announces");
            ++rows;
        }
    return rows;
}

/// Assimp's reader of PLY never returns from a header without an end, and takes what follows for
/// complete.
void checkPly(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::string line;
    if (!std::getline(in, line) || line.substr(0, 3) != "ply") return;  // not one
    bool ascii = false;
    std::vector<PlyElement> elements;
    double announced = 0;
    while (std::getline(in, line)) {
        std::istringstream words(line);
        std::string word;
        words >> word;
        if (word == "end_header") break;
        if (word == "format") {
            words >> word;
            ascii = word == "ascii";
        } else if (word == "element") {
            PlyElement& element = elements.emplace_back();
            if (!(words >> element.name >> element.count) || !(element.count >= 0))
                reject(file, "the header's line \"" + oneLine(line) + "\" has no count");
            announced += element.count;
        } else if (word == "property" && !elements.empty()) {
            words >> word;
            elements.back().lists.push_back(word == "list");
        }
    }
    if (!in) reject(file, "ends within its header: there is no line \"end_header\"");
    // In a binary file at least a byte for each.
    const double held = ascii ? checkPlyRows(file, in, elements)
                              : static_cast<double>(std::filesystem::file_size(file)) -
                                    static_cast<double>(in.tellg());
    if (held < announced) {
        std::ostringstream counts;
        counts.precision(15);
        counts << "its header announces " << announced << " elements, but only " << held
               << (ascii ? " lines" : " bytes") << " follow";
        reject(file, counts.str());
    }
}

/// Assimp asks for as much memory as a binary glTF's first chunk says that it holds.
void checkGlb(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::array<unsigned char, 20> head{};
    in.read(reinterpret_cast<char*>(head.data()), head.size());
    if (!in || std::string(head.begin(), head.begin() + 4) != "glTF") return;
    const std::uintmax_t announced =
        head[12] + 256U * (head[13] + 256U * (head[14] + 256U * head[15]));
    const std::uintmax_t held = std::filesystem::file_size(file) - head.size();
    if (announced > held)
        reject(file, "its first chunk is to have " + std::to_string(announced) +
                         " bytes, but only " + std::to_string(held) + " follow");
}

/// Why there is no model.
std::string whyNot(const Assimp::Importer& importer) {
    constexpr const char* kTooMuch =
        "announces more than fits into memory; it may be damaged or cut short";
    if (const std::exception_ptr& thrown = importer.GetException()) {
        try {
            std::rethrow_exception(thrown);
        } catch (const std::bad_alloc&) {
            return kTooMuch;
        } catch (const std::length_error&) {
            return kTooMuch;
        } catch (const std::exception&) {
            // As Assimp words it.
        }
    }
    return oneLine(importer.GetErrorString());
}

/// Assimp ends the program where it is to make triangles of one.
void rejectFacesWithoutCorners(const std::filesystem::path& file, const aiScene& model) {
    for (unsigned i = 0; i < model.mNumMeshes; ++i) {
        const aiMesh& mesh = *model.mMeshes[i];
        for (unsigned face = 0; face < mesh.mNumFaces; ++face)
            if (mesh.mFaces[face].mNumIndices == 0)
                reject(file, "mesh " + std::to_string(i) + ", face " + std::to_string(face) +
                                 ": has no corners");
    }
}

/// Fit for the name of a picture's file.
std::string plainName(const std::filesystem::path& file) {
    std::string name = file.stem().string();
    for (char& letter : name)
        if (std::isalnum(static_cast<unsigned char>(letter)) == 0 && letter != '-') letter = '_';
    return name.empty() ? "model" : name;
}

std::vector<SceneObject> objectsOf(const std::filesystem::path& file,
                                   std::vector<std::string>& notes) {
    std::error_code error;
    const auto status = std::filesystem::status(file, error);
    if (!std::filesystem::exists(status)) reject(file, "no such model file");
    if (!std::filesystem::is_regular_file(status)) reject(file, "is not a file");
    if (std::filesystem::file_size(file, error) == 0 && !error) reject(file, "is empty");
    checkPly(file);
    checkGlb(file);

    const ImportNotes found;
    Assimp::Importer importer;
    importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                                aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    const aiScene* model = importer.ReadFile(file.string(), aiProcess_ValidateDataStructure);
    if (model == nullptr) reject(file, whyNot(importer));
    rejectFacesWithoutCorners(file, *model);
    model = importer.ApplyPostProcessing(aiProcess_Triangulate | aiProcess_GenSmoothNormals |
                                         aiProcess_SortByPType | aiProcess_PreTransformVertices);
    if (model == nullptr) reject(file, whyNot(importer));

    std::vector<SceneObject> objects;
    std::size_t triangles = 0;
    for (unsigned i = 0; i < model->mNumMeshes; ++i) {
        const aiMesh& own = *model->mMeshes[i];
        Mesh mesh = meshOf(file, own);
        triangles += mesh.indices.size() / 3;
        if (triangles > kMostTriangles)
            reject(file, "holds more than " + std::to_string(kMostTriangles) + " triangles");
        if (!mesh.indices.empty())
            objects.push_back({own.mName.C_Str(), std::move(mesh), materialOf(*model, own)});
    }
    if (objects.empty()) reject(file, "holds no triangles");
    for (const std::string& note : found.all()) notes.push_back(file.string() + ": " + note);
    return objects;
}

}  // namespace

Scene loadScene(const std::filesystem::path& file) {
    Scene scene;
    scene.name = plainName(file);
    scene.source = file.string();
    try {
        scene.objects = objectsOf(file, scene.notes);
    } catch (const std::bad_alloc&) {
        reject(file, "needs more memory than there is");
    }
    Bounds own = boundsOf(scene.objects.front().mesh);
    for (const SceneObject& object : scene.objects) {
        const Bounds bounds = boundsOf(object.mesh);
        own.low = glm::min(own.low, bounds.low);
        own.high = glm::max(own.high, bounds.high);
    }
    const glm::dvec3 low(own.low);
    const glm::dvec3 span = glm::dvec3(own.high) - low;
    const double longest = std::max({span.x, span.y, span.z});
    const double scale = kModelSizeM / longest;
    if (!(longest > 0) || !std::isfinite(scale))
        reject(scene.source, "all of its triangles lie in one point");
    const glm::dvec3 foot = low + 0.5 * glm::dvec3(span.x, 0, span.z);
    for (SceneObject& object : scene.objects) {
        for (Vertex& vertex : object.mesh.vertices)
            vertex.position = glm::vec3(scale * (glm::dvec3(vertex.position) - foot));
        addNormals(object.mesh);
    }

    SceneObject ground = paving();
    for (Vertex& vertex : ground.mesh.vertices)
        vertex.position.y -= kGroundBelowOfSize * kModelSizeM;
    scene.objects.insert(scene.objects.begin(), std::move(ground));
    scene.casters = casterBounds(scene.objects);
    const glm::vec3 size(scale * span);
    // The bounds' sphere and some of the shadow beside it.
    const float radius = 0.5F * glm::length(size);
    scene.camera = {.target = {0, 0.42F * size.y, 0},
                    .yawDeg = 28,
                    .pitchDeg = 22,
                    .distanceM = 1.25F * radius / std::sin(glm::radians(20.0F)),
                    .verticalFieldDeg = 40};
    scene.sun = {.azimuthDeg = 100, .elevationDeg = 48};
    scene.sunPath = {.turnDeg = 360, .elevationSwingDeg = 10};
    scene.softnessM = kSoftnessOfSize * kModelSizeM;
    return scene;
}

bool isModelFile(std::string_view source) {
    const std::string_view name = source.substr(0, source.find(':'));
    const auto scenes = builtInScenes();
    const bool builtIn = std::any_of(scenes.begin(), scenes.end(),
                                     [&](const SceneEntry& entry) { return entry.name == name; });
    return !builtIn && source.find_first_of("./") != std::string_view::npos;
}

std::string_view withoutOptions(std::string_view source) {
    if (!isModelFile(source)) return source.substr(0, source.find(':'));
    std::error_code unreadable;
    for (std::size_t end = source.size(); end != std::string_view::npos && end > 0;
         end = source.rfind(':', end - 1)) {
        const std::string_view file = source.substr(0, end);
        if (std::filesystem::is_regular_file(file, unreadable)) return file;
    }
    std::string_view file = source;
    for (std::size_t colon = file.rfind(':');
         colon != std::string_view::npos && file.find('=', colon) != std::string_view::npos &&
         file.find('/', colon) == std::string_view::npos;
         colon = file.rfind(':'))
        file = file.substr(0, colon);
    return file;
}

Scene openScene(std::string_view source) {
    if (!isModelFile(source)) return makeScene(source);
    const std::string_view file = withoutOptions(source);
    Scene scene = loadScene(file);
    scene.source = source;
    applyOptions(scene, source.substr(file.size()));
    return scene;
}

}  // namespace renderer

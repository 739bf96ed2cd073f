// SPDX-License-Identifier: MIT
// What a renderer holds from frame to frame: scene, targets, maps and programs.
#include "renderer/renderer.h"

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "renderer/uniform_block.h"

namespace renderer {
namespace {

/// `ofPart`: for a map that serves a part of the receivers.
Program makeLookupProgram(const ShaderLibrary& shaders, const Technique& technique, bool ofPart) {
    ShaderOptions options = techniqueOptions(technique);
    if (ofPart) options.defines.emplace_back("PART", "1");
    return makeProgram(shaders, "passes/fullscreen.vert", "passes/lookup.frag", options);
}

}  // namespace

Renderer::Renderer(const GlInfo& info, Scene scene, int widthPx, int heightPx,
                   const ShaderLibrary& shaders)
    : info_(info),
      shaders_(shaders),
      lookupPrograms_(2 * techniques().size()),
      mapFilter_(shaders) {
    reload(shaders);

    viewBlock_ = makeUniformBlock(view_, "view constants");
    lookBlock_ = makeUniformBlock(f32::LookConstants{}, "look constants");
    GLuint name = 0;
    glCreateVertexArrays(1, &name);
    noGeometry_ = VertexArray(name);

    setScene(std::move(scene));
    resize(widthPx, heightPx);
}

void Renderer::setScene(Scene scene) {
    fitShadowWindow(scene.casters, scene.sun);  // throws for a scene that has none
    checkLights(scene.cascades, scene.lamps);
    forgetDepths();
    scene_ = std::move(scene);
    reachM_ = kReachOfSoftness * scene_.softnessM;
    windowSteps_.clear();
    lampSteps_.clear();
    uploadScene();
    fitViews();
    makeVisibilities();
}

void Renderer::uploadScene() {
    Mesh all;
    ranges_.clear();
    pieces_.clear();
    for (const SceneObject& object : scene_.objects) {
        const IndexRun run{all.indices.size(), object.mesh.indices.size()};
        all.append(object.mesh);
        ranges_.push_back({object.material, piecesOf(all, run)});
        pieces_.insert(pieces_.end(), ranges_.back().pieces.begin(), ranges_.back().pieces.end());
    }
    if (all.indices.empty())
        throw std::invalid_argument("scene \"" + scene_.name + "\" has no triangles");
    indexCount_ = all.indices.size();
    surfaces_ = boundsOf(all);
    vertices_ =
        makeBuffer(all.vertices.data(),
                   static_cast<GLsizeiptr>(all.vertices.size() * sizeof(Vertex)), 0, "vertices");
    indices_ =
        makeBuffer(all.indices.data(), static_cast<GLsizeiptr>(indexCount_ * sizeof(std::uint32_t)),
                   0, "indices");
    GLuint name = 0;
    glCreateVertexArrays(1, &name);
    geometry_ = VertexArray(name);
    glVertexArrayVertexBuffer(name, 0, vertices_.name(), 0, sizeof(Vertex));
    glVertexArrayElementBuffer(name, indices_.name());
    for (const GLuint attribute : {0U, 1U}) {
        glEnableVertexArrayAttrib(name, attribute);
        glVertexArrayAttribFormat(name, attribute, 3, GL_FLOAT, GL_FALSE, attribute * 12);
        glVertexArrayAttribBinding(name, attribute, 0);
    }
}

void Renderer::resize(int widthPx, int heightPx) {
    if (widthPx == widthPx_ && heightPx == heightPx_) return;
    if (widthPx < 1 || heightPx < 1 || widthPx > info_.maxResolution ||
        heightPx > info_.maxResolution)
        throw std::invalid_argument("viewport is " + std::to_string(widthPx) + " x " +
                                    std::to_string(heightPx) + " px, each edge must be in [1, " +
                                    std::to_string(info_.maxResolution) + "]");
    const auto target = [&](GLenum format, std::string_view label) {
        return makeTexture(format, widthPx, heightPx, label);
    };
    positions_ = target(GL_RGBA32F, "positions");
    planes_ = target(GL_RGBA32F, "planes");
    normals_ = target(GL_RGBA16F, "normals");
    albedos_ = target(GL_SRGB8_ALPHA8, "albedos");
    surfaceDepth_ = target(GL_DEPTH_COMPONENT32F, "surface depth");
    lit_ = target(GL_RGBA8, "lit");
    prepassTarget_ =
        makeFramebuffer({positions_.name(), planes_.name(), normals_.name(), albedos_.name()},
                        surfaceDepth_.name(), "prepass");
    litTarget_ = makeFramebuffer({lit_.name()}, 0, "lit");
    widthPx_ = widthPx;
    heightPx_ = heightPx;
    makeVisibilities();
    fitViews();
}

std::optional<Renderer::Outputs> Renderer::outputs(std::size_t view) const {
    if (lastTechnique_ == nullptr) return std::nullopt;
    const glm::vec4& kernel = shadows_.at(view).kernel;  // x its radius, y the least
    return Outputs{.positions = positions_.name(),
                   .planes = planes_.name(),
                   .normals = normals_.name(),
                   .albedos = albedos_.name(),
                   .visibility = visibilities_[views_.at(view).light].name(),
                   .lit = lit_.name(),
                   .depths = maps_.at(view).depths.name(),
                   .technique = lastTechnique_,
                   .hasKernel = kernel.x > 0 || kernel.y > 0};
}

std::size_t Renderer::targetBytes() const {
    const std::size_t perPixel = 16 + 16 + 8 + 4 + 4 + 4 + 4 * lights();  // as resize() makes them
    return perPixel * static_cast<std::size_t>(widthPx_) * static_cast<std::size_t>(heightPx_);
}

std::size_t Renderer::mapBytes() const {
    std::size_t texels = 0;
    for (const Map& map : maps_)
        texels += static_cast<std::size_t>(map.edge) * static_cast<std::size_t>(map.edge) *
                  static_cast<std::size_t>(map.samples > 1 ? 1 + map.samples : 1);
    return texels * static_cast<std::size_t>(bytesPerTexel(MapFormat::depth32f)) +
           mapFilter_.bytes();
}

std::size_t Renderer::triangles() const {
    return indexCount_ / 3;
}

void Renderer::reserveMap(int edge) {
    if (edge < 0 || edge > info_.maxResolution)
        throw std::invalid_argument("map reserve is " + std::to_string(edge) +
                                    " texels, must be in [0, " +
                                    std::to_string(info_.maxResolution) + "]");
    reservedEdge_ = edge;
}

void Renderer::ensureMap(std::size_t view, int resolution, int samples) {
    Map& map = maps_[view];
    const int edge = std::max(resolution, reservedEdge_);
    if (edge == map.edge && samples == map.samples) return;
    GLint mostSamples = 1;
    glGetIntegerv(GL_MAX_DEPTH_TEXTURE_SAMPLES, &mostSamples);
    if (samples > 1 && samples > mostSamples)
        throw std::invalid_argument("parameter map_samples is " + std::to_string(samples) +
                                    ", the driver allows at most " + std::to_string(mostSamples) +
                                    " (" + info_.renderer + ")");
    // The old one first: two maps at once may be more than there is room for.
    map = {};
    map.depths = makeTexture(GL_DEPTH_COMPONENT32F, edge, edge, "shadow map");
    map.target = makeFramebuffer({}, map.depths.name(), "shadow map");
    if (samples > 1) {
        map.sampledDepths =
            makeSampledTexture(GL_DEPTH_COMPONENT32F, edge, samples, "sampled shadow map");
        map.sampledTarget = makeFramebuffer({}, map.sampledDepths.name(), "sampled shadow map");
    }
    map.samples = samples;
    map.edge = edge;
}

void Renderer::reload(const ShaderLibrary& shaders) {
    Program depth = makeProgram(shaders, "passes/depth.vert", "passes/depth.frag", {});
    Program prepass = makeProgram(shaders, "passes/prepass.vert", "passes/prepass.frag", {});
    Program lampDepth = makeProgram(shaders, "passes/depth.vert", "passes/depth.frag",
                                    {.defines = {{"LAMP", "1"}}, .substitutions = {}});
    Program lit = makeProgram(shaders, "passes/fullscreen.vert", "passes/lit.frag", {});
    Program lampLit =
        makeProgram(shaders, "passes/fullscreen.vert", "passes/lit.frag",
                    {.defines = {{"MOST_LAMPS", std::to_string(kMostLamps)}}, .substitutions = {}});
    std::vector<Program> lookups(lookupPrograms_.size());
    MapFilter mapFilter(shaders);
    mapFilter.prepareAs(mapFilter_);
    ShaderLibrary own = shaders;
    for (std::size_t row = 0; row < lookups.size(); ++row) {
        if (lookupPrograms_[row].name() == 0) continue;
        const Technique& technique = techniques()[row % techniques().size()];
        lookups[row] = makeLookupProgram(shaders, technique, row >= techniques().size());
    }
    for (const auto& counter : depthCounters_) counter->reload(shaders);
    // Nothing below throws.
    shaders_ = std::move(own);
    depthProgram_ = std::move(depth);
    lampDepthProgram_ = std::move(lampDepth);
    prepassProgram_ = std::move(prepass);
    litProgram_ = std::move(lit);
    lampLitProgram_ = std::move(lampLit);
    lookupPrograms_ = std::move(lookups);
    mapFilter_ = std::move(mapFilter);
}

void Renderer::prepare(const Technique& technique) {
    for (const LightView& view : views_)
        lookupProgram(technique, view.window.part != kAllReceivers);
    mapFilter_.prepare(technique);
    while (hasLayers(technique) && depthCounters_.size() < views_.size()) {
        auto counter = std::make_unique<DepthCounter>();
        counter->prepare(shaders_);
        depthCounters_.push_back(std::move(counter));
    }
}

const Program& Renderer::lookupProgram(const Technique& technique, bool ofPart) {
    const auto row = static_cast<std::size_t>(&technique - techniques().data());
    Program& program = lookupPrograms_.at(ofPart ? techniques().size() + row : row);
    if (program.name() == 0) program = makeLookupProgram(shaders_, technique, ofPart);
    return program;
}

}  // namespace renderer

// SPDX-License-Identifier: MIT
#include "renderer/renderer.h"

#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <stdexcept>

#include "renderer/prefilter.h"

namespace renderer {
namespace {

/// A pass in the GL debugger, on the clock, and nothing else.
class PassScope {
  public:
    PassScope(Pass pass, PassClock* clock) : pass_(pass), clock_(clock) {
        glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, -1, std::string(toText(pass)).c_str());
        if (clock_ != nullptr) clock_->begin(pass_);
    }
    ~PassScope() {
        if (clock_ != nullptr) clock_->end(pass_);
        glPopDebugGroup();
    }
    PassScope(const PassScope&) = delete;
    PassScope& operator=(const PassScope&) = delete;

  private:
    Pass pass_;
    PassClock* clock_;
};

[[noreturn]] void rejectSetting(const std::string& name, const std::string& value,
                                const std::string& rule) {
    throw std::invalid_argument("frame settings: " + name + " is " + value + ", must be " + rule);
}

float nearestSeenM(const OrbitCamera& camera) {
    return 0.02F * camera.distanceM;
}

float farthestSeenM(const OrbitCamera& camera) {
    return std::max(200.0F, 40 * camera.distanceM);
}

void checkUnit(const std::string& name, float value) {
    if (!(value >= 0 && value <= 1)) rejectSetting(name, std::to_string(value), "in [0, 1]");
}

/// A late-afternoon sky; chosen by eye.
f32::LookConstants lookOf(const Scene& scene) {
    return {.sunColour = glm::vec4(scene.sun.colour, 0),
            .zenithColour = {0.13F, 0.33F, 0.85F, 0},
            .horizonColour = {0.72F, 0.86F, 1.05F, 0},
            .skyLight = {0.30F, 0.39F, 0.56F, 0},
            .groundLight = {0.36F, 0.29F, 0.22F, 0},
            .tone = {0.66F, scene.hazeM, 0, 0}};
}

template <class Block>
Buffer makeUniformBlock(const Block& block, std::string_view label) {
    return makeBuffer(&block, sizeof block, GL_DYNAMIC_STORAGE_BIT, label);
}

template <class Block>
void fillUniformBlock(const Buffer& buffer, const Block& block) {
    glNamedBufferSubData(buffer.name(), 0, sizeof block, &block);
}

void bindTextures(std::initializer_list<GLuint> names) {
    GLuint unit = 0;
    for (const GLuint name : names) glBindTextureUnit(unit++, name);
}

Program makeLookupProgram(const ShaderLibrary& shaders, const Technique& technique) {
    return makeProgram(shaders, "passes/fullscreen.vert", "passes/lookup.frag",
                       techniqueOptions(technique));
}

void throwOnGlError() {
    const GLenum error = glGetError();
    if (error != GL_NO_ERROR)
        throw std::runtime_error("rendering: the driver reports GL error " + std::to_string(error) +
                                 (error == GL_OUT_OF_MEMORY ? " (out of memory)" : ""));
}

}  // namespace

f64::ViewConstants toDouble(const f32::ViewConstants& c) {
    return {glm::dmat4(c.clipFromEyeRelative),
            glm::dvec4(c.eye),
            glm::dvec4(c.pixelRight),
            glm::dvec4(c.pixelUp),
            glm::dvec4(c.forward),
            glm::dvec4(c.viewport)};
}

f64::ShadowConstants toDouble(const f32::ShadowConstants& c) {
    return {glm::dmat4(c.shadowFromEyeRelative),
            glm::dmat4(c.shadowFromWorld),
            glm::dvec4(c.towardsLight),
            glm::dvec4(c.map),
            glm::dvec4(c.kernel),
            {glm::dvec4(c.parameters[0]), glm::dvec4(c.parameters[1])},
            glm::dvec4(c.prefilter),
            {glm::dvec4(c.layerEnds[0]), glm::dvec4(c.layerEnds[1]), glm::dvec4(c.layerEnds[2]),
             glm::dvec4(c.layerEnds[3])}};
}

void FrameSettings::validate(const GlInfo& info) const {
    if (resolution < 1 || resolution > info.maxResolution)
        rejectSetting("resolution", std::to_string(resolution),
                      "in [1, " + std::to_string(info.maxResolution) +
                          "], what the driver allows (" + info.renderer + ")");
    checkUnit("radiusUv", radiusUv);
    checkUnit("minRadiusUv", minRadiusUv);
    checkUnit("fadeWeight", fadeWeight);
    if (fadeWeight < 1 && (fadeFrom < 1 || fadeFrom > info.maxResolution))
        rejectSetting("fadeFrom", std::to_string(fadeFrom),
                      "in [1, " + std::to_string(info.maxResolution) + "]");
    if (samplesPerPixelEdge < 1 || samplesPerPixelEdge > 16)
        rejectSetting("samplesPerPixelEdge", std::to_string(samplesPerPixelEdge), "in [1, 16]");
}

Renderer::Renderer(const GlInfo& info, Scene scene, int widthPx, int heightPx,
                   const ShaderLibrary& shaders)
    : info_(info), shaders_(shaders), lookupPrograms_(techniques().size()), mapFilter_(shaders) {
    reload(shaders);

    viewBlock_ = makeUniformBlock(view_, "view constants");
    shadowBlock_ = makeUniformBlock(shadow_, "shadow constants");
    lookBlock_ = makeUniformBlock(f32::LookConstants{}, "look constants");
    GLuint name = 0;
    glCreateVertexArrays(1, &name);
    noGeometry_ = VertexArray(name);

    setScene(std::move(scene));
    resize(widthPx, heightPx);
}

void Renderer::setScene(Scene scene) {
    fitShadowWindow(scene.casters, scene.sun);  // throws for a scene that has none
    depthCounter_.forget();
    scene_ = std::move(scene);
    reachM_ = kReachOfSoftness * scene_.softnessM;
    windowStep_.reset();
    fitWindow();
    uploadScene();
}

void Renderer::setCamera(const OrbitCamera& camera) {
    scene_.camera = camera;
    fitWindow();
}

void Renderer::setSun(const Sun& sun) {
    fitShadowWindow(scene_.casters, sun);  // throws for a sun that gives no light
    scene_.sun = sun;
    fitWindow();
}

void Renderer::setWindowFit(WindowFit fit) {
    windowFit_ = fit;
    fitWindow();
}

void Renderer::setReach(double reachM) {
    if (!(reachM >= 0) || !std::isfinite(reachM))
        throw std::invalid_argument("kernel reach is " + std::to_string(reachM) +
                                    " m, must be finite and at least 0");
    reachM_ = reachM;
    fitWindow();
}

void Renderer::setWindow(const ShadowWindow& window) {
    fitted_ = window_ = window;
}

void Renderer::fitWindow() {
    fitted_ = fitShadowWindow(scene_.casters, scene_.sun);
    if (windowFit_ == WindowFit::view && widthPx_ > 0)
        fitted_ = narrowShadowWindow(
            fitted_, scene_.casters,
            viewVolume(scene_.camera, static_cast<double>(widthPx_) / heightPx_,
                       nearestSeenM(scene_.camera), farthestSeenM(scene_.camera)),
            reachM_, windowStep_);
    window_ = fitted_;
}

void Renderer::uploadScene() {
    Mesh all;
    ranges_.clear();
    for (const SceneObject& object : scene_.objects) {
        ranges_.push_back({object.material, static_cast<GLsizei>(object.mesh.indices.size()),
                           all.indices.size()});
        all.append(object.mesh);
    }
    if (all.indices.empty())
        throw std::invalid_argument("scene \"" + scene_.name + "\" has no triangles");
    indexCount_ = all.indices.size();
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
    visibility_ = target(GL_R32F, "visibility");
    lit_ = target(GL_RGBA8, "lit");
    prepassTarget_ =
        makeFramebuffer({positions_.name(), planes_.name(), normals_.name(), albedos_.name()},
                        surfaceDepth_.name(), "prepass");
    visibilityTarget_ = makeFramebuffer({visibility_.name()}, 0, "lookup");
    litTarget_ = makeFramebuffer({lit_.name()}, 0, "lit");
    widthPx_ = widthPx;
    heightPx_ = heightPx;
    lastTechnique_ = nullptr;
    fitWindow();
}

std::optional<Renderer::Outputs> Renderer::outputs() const {
    if (lastTechnique_ == nullptr) return std::nullopt;
    return Outputs{.positions = positions_.name(),
                   .planes = planes_.name(),
                   .normals = normals_.name(),
                   .albedos = albedos_.name(),
                   .visibility = visibility_.name(),
                   .lit = lit_.name(),
                   .depths = map_.name(),
                   .technique = lastTechnique_,
                   .hasKernel = lastFrameSoft_};
}

void Renderer::bindConstants() const {
    glBindBufferBase(GL_UNIFORM_BUFFER, kViewBinding, viewBlock_.name());
    glBindBufferBase(GL_UNIFORM_BUFFER, kShadowBinding, shadowBlock_.name());
    glBindBufferBase(GL_UNIFORM_BUFFER, kLookBinding, lookBlock_.name());
}

std::size_t Renderer::targetBytes() const {
    const std::size_t perPixel = 16 + 16 + 8 + 4 + 4 + 4 + 4;  // in the order of resize()
    return perPixel * static_cast<std::size_t>(widthPx_) * static_cast<std::size_t>(heightPx_);
}

std::size_t Renderer::mapBytes() const {
    return static_cast<std::size_t>(mapEdge_) * static_cast<std::size_t>(mapEdge_) *
               static_cast<std::size_t>(bytesPerTexel(MapFormat::depth32f)) +
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

void Renderer::ensureMap(int resolution) {
    const int edge = std::max(resolution, reservedEdge_);
    if (edge == mapEdge_) return;
    // The old one first: two maps at once may be more than there is room for.
    mapTarget_ = {};
    map_ = {};
    mapEdge_ = 0;
    map_ = makeTexture(GL_DEPTH_COMPONENT32F, edge, edge, "shadow map");
    mapTarget_ = makeFramebuffer({}, map_.name(), "shadow map");
    mapEdge_ = edge;
}

void Renderer::updateConstants(const FrameSettings& settings) {
    const OrbitCamera& camera = scene_.camera;
    const auto width = static_cast<float>(widthPx_);
    const auto height = static_cast<float>(heightPx_);
    const glm::vec3 eye = camera.eye();
    const glm::vec3 forward = glm::normalize(camera.target - eye);
    const glm::vec3 right = glm::normalize(glm::cross(forward, glm::vec3(0, 1, 0)));
    const glm::vec3 up = glm::cross(right, forward);
    const float verticalField = glm::radians(camera.verticalFieldDeg);
    const float pixel = 2 * std::tan(verticalField / 2) / height;

    view_.clipFromEyeRelative =
        glm::perspectiveRH_ZO(verticalField, width / height, nearestSeenM(camera),
                              farthestSeenM(camera)) *
        glm::lookAtRH(glm::vec3(0), forward, glm::vec3(0, 1, 0));
    view_.eye = glm::vec4(eye, 0);
    view_.pixelRight = glm::vec4(right * pixel, 0);
    view_.pixelUp = glm::vec4(up * pixel, 0);
    view_.forward = glm::vec4(forward, 0);
    view_.viewport = {width, height, 1 / width, 1 / height};

    window_ = snapToTexels(fitted_, settings.resolution);
    const glm::dmat4 fromEyeRelative =
        window_.shadowFromWorld * glm::translate(glm::dmat4(1), glm::dvec3(eye));
    const Technique& technique =
        settings.technique != nullptr ? *settings.technique : techniques().front();
    const ParameterValues values = settings.parameters.value_or(technique.standardParameters());
    const auto resolution = static_cast<float>(settings.resolution);
    shadow_.shadowFromEyeRelative = glm::mat4(fromEyeRelative);
    shadow_.shadowFromWorld = glm::mat4(window_.shadowFromWorld);
    shadow_.towardsLight = glm::vec4(window_.towardsLight, 0);
    shadow_.map = {resolution, 1 / resolution, 1 / static_cast<float>(mapEdge_), 0};
    shadow_.kernel = {settings.radiusUv, settings.minRadiusUv,
                      static_cast<float>(settings.samplesPerPixelEdge), 0};
    shadow_.parameters[0] = glm::make_vec4(values.data());
    shadow_.parameters[1] = glm::make_vec4(values.data() + 4);
    shadow_.prefilter = prefilterConstants(technique, values, settings.radiusUv,
                                           settings.minRadiusUv, settings.resolution);

    fillUniformBlock(viewBlock_, view_);
    fillUniformBlock(shadowBlock_, shadow_);
    fillUniformBlock(lookBlock_, lookOf(scene_));
    bindConstants();
}

void Renderer::reload(const ShaderLibrary& shaders) {
    Program depth = makeProgram(shaders, "passes/depth.vert", "passes/depth.frag", {});
    Program prepass = makeProgram(shaders, "passes/prepass.vert", "passes/prepass.frag", {});
    Program lit = makeProgram(shaders, "passes/fullscreen.vert", "passes/lit.frag", {});
    std::vector<Program> lookups(techniques().size());
    MapFilter mapFilter(shaders);
    ShaderLibrary own = shaders;
    for (std::size_t row = 0; row < lookups.size(); ++row) {
        if (lookupPrograms_[row].name() == 0) continue;
        lookups[row] = makeLookupProgram(shaders, techniques()[row]);
        mapFilter.prepare(techniques()[row]);
    }
    depthCounter_.reload(shaders);
    // Nothing below throws.
    shaders_ = std::move(own);
    depthProgram_ = std::move(depth);
    prepassProgram_ = std::move(prepass);
    litProgram_ = std::move(lit);
    lookupPrograms_ = std::move(lookups);
    mapFilter_ = std::move(mapFilter);
}

void Renderer::prepare(const Technique& technique) {
    lookupProgram(technique);
    mapFilter_.prepare(technique);
}

const Program& Renderer::lookupProgram(const Technique& technique) {
    const auto row = static_cast<std::size_t>(&technique - techniques().data());
    Program& program = lookupPrograms_.at(row);
    if (program.name() == 0) program = makeLookupProgram(shaders_, technique);
    return program;
}

void Renderer::render(const FrameSettings& settings, PassClock* clock) {
    settings.validate(info_);
    const Technique& technique =
        settings.technique != nullptr ? *settings.technique : techniques().front();
    prepare(technique);
    if (technique.prefilter == Prefilter::none) mapFilter_.release();
    if (!hasLayers(technique)) depthCounter_.forget();  // its count is of an earlier light
    const bool fades = settings.fadeWeight < 1;
    ensureMap(fades ? std::max(settings.resolution, settings.fadeFrom) : settings.resolution);
    lastFrameSoft_ = technique.soft && settings.radiusUv > 0;
    lastTechnique_ = &technique;
    updateConstants(settings);
    {
        const PassScope scope(Pass::prepass, clock);
        drawPrepass();
    }
    if (fades) {
        // First, so that the map of this frame is the one that later passes find. Its passes go
        // untimed: a clock has one time for each.
        FrameSettings leaving = settings;
        leaving.resolution = settings.fadeFrom;
        updateConstants(leaving);
        drawShadows(leaving, technique, 1, nullptr);
        updateConstants(settings);
    }
    drawShadows(settings, technique, settings.fadeWeight, clock);
    if (settings.lit) {
        const PassScope scope(Pass::lit, clock);
        drawLit();
    }
    throwOnGlError();
}

void Renderer::drawShadows(const FrameSettings& settings, const Technique& technique, float weight,
                           PassClock* clock) {
    {
        const PassScope scope(Pass::depth, clock);
        drawCasters(mapTarget_, settings.resolution);
    }
    if (technique.prefilter != Prefilter::none) {
        const PassScope scope(Pass::prefilter, clock);
        const ParameterValues parameters =
            withLayers(technique, settings.parameters.value_or(technique.standardParameters()));
        // Both maps of a fade in one texture.
        mapFilter_.run(technique, parameters, shadow_, map_,
                       settings.fadeWeight < 1 ? mapEdge_ : reservedEdge_);
    }
    const PassScope scope(Pass::lookup, clock);
    drawLookup(technique, weight);
}

void Renderer::drawCasters(const Framebuffer& target, int edge) const {
    glBindFramebuffer(GL_FRAMEBUFFER, target.name());
    glViewport(0, 0, edge, edge);
    // The sub-rectangle alone: clearing a large texture costs more than drawing a small map.
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, 0, edge, edge);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDepthMask(GL_TRUE);
    glEnable(GL_DEPTH_CLAMP);
    const float farthest = 1;
    glClearBufferfv(GL_DEPTH, 0, &farthest);
    glUseProgram(depthProgram_.name());
    glBindVertexArray(geometry_.name());
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(indexCount_), GL_UNSIGNED_INT, nullptr);
    glDisable(GL_DEPTH_CLAMP);
    glDisable(GL_SCISSOR_TEST);
}

ParameterValues Renderer::withLayers(const Technique& technique, const ParameterValues& asked) {
    if (!hasLayers(technique)) return asked;
    const int resolution = static_cast<int>(shadow_.map.x);
    const Layers layers =
        placeLayers(technique, asked, depthCounter_.count(shaders_, map_, resolution));
    useLayers(technique, layers, shadow_);
    fillUniformBlock(shadowBlock_, shadow_);
    ParameterValues values = asked;
    values[technique.parameterSlot("layers").value()] = static_cast<float>(layers.count);
    return values;
}

void Renderer::drawPrepass() {
    glBindFramebuffer(GL_FRAMEBUFFER, prepassTarget_.name());
    glViewport(0, 0, widthPx_, heightPx_);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDepthMask(GL_TRUE);
    const std::array<float, 4> none{};
    const float farthest = 1;
    for (GLint target = 0; target < 4; ++target) glClearBufferfv(GL_COLOR, target, none.data());
    glClearBufferfv(GL_DEPTH, 0, &farthest);
    glEnable(GL_FRAMEBUFFER_SRGB);  // albedos
    glUseProgram(prepassProgram_.name());
    glBindVertexArray(geometry_.name());
    for (const DrawRange& range : ranges_) {
        const Material& material = range.material;
        const glm::vec4 albedo(material.albedo, material.gloss);
        const glm::vec4 second(material.second, material.periodM);
        glUniform4fv(0, 1, glm::value_ptr(albedo));
        glUniform4fv(1, 1, glm::value_ptr(second));
        glUniform1ui(2, static_cast<GLuint>(material.pattern));
        glDrawElements(GL_TRIANGLES, range.indices, GL_UNSIGNED_INT,
                       reinterpret_cast<const void*>(range.firstIndex * sizeof(std::uint32_t)));
    }
    glDisable(GL_FRAMEBUFFER_SRGB);
    glDisable(GL_DEPTH_TEST);
}

void Renderer::drawLookup(const Technique& technique, float weight) {
    if (weight < 1) {
        glEnable(GL_BLEND);
        glBlendColor(0, 0, 0, weight);
        glBlendFunc(GL_CONSTANT_ALPHA, GL_ONE_MINUS_CONSTANT_ALPHA);
    }
    glBindFramebuffer(GL_FRAMEBUFFER, visibilityTarget_.name());
    glViewport(0, 0, widthPx_, heightPx_);
    const bool filtered = technique.prefilter != Prefilter::none;
    bindTextures({positions_.name(), planes_.name(), filtered ? mapFilter_.map() : map_.name()});
    glUseProgram(lookupProgram(technique).name());
    glBindVertexArray(noGeometry_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisable(GL_BLEND);
}

void Renderer::drawLit() {
    glBindFramebuffer(GL_FRAMEBUFFER, litTarget_.name());
    glViewport(0, 0, widthPx_, heightPx_);
    bindTextures(
        {positions_.name(), planes_.name(), normals_.name(), albedos_.name(), visibility_.name()});
    glUseProgram(litProgram_.name());
    glBindVertexArray(noGeometry_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace renderer

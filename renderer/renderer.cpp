// SPDX-License-Identifier: MIT
#include "renderer/renderer.h"

#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <memory>
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

void checkLights(int cascades, const std::vector<Lamp>& lamps) {
    if (cascades < 1 || cascades > kMostCascades)
        throw std::invalid_argument("cascades is " + std::to_string(cascades) +
                                    ", must be in [1, " + std::to_string(kMostCascades) + "]");
    if (lamps.size() > kMostLamps)
        throw std::invalid_argument("the scene has " + std::to_string(lamps.size()) +
                                    " lamps, must be at most " + std::to_string(kMostLamps));
    for (const Lamp& lamp : lamps)
        if (const std::string problem = validate(lamp); !problem.empty())
            throw std::invalid_argument(problem);
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

/// `ofPart`: for a map that serves a part of the receivers.
Program makeLookupProgram(const ShaderLibrary& shaders, const Technique& technique, bool ofPart) {
    ShaderOptions options = techniqueOptions(technique);
    if (ofPart) options.defines.emplace_back("PART", "1");
    return makeProgram(shaders, "passes/fullscreen.vert", "passes/lookup.frag", options);
}

/// As lit.frag has them.
std::vector<glm::vec4> lampConstants(const std::vector<Lamp>& lamps, glm::vec3 eye) {
    std::vector<glm::vec4> constants;
    for (const Lamp& lamp : lamps) {
        const bool spot = lamp.kind == Lamp::Kind::spot;
        constants.emplace_back(lamp.position - eye,
                               spot ? std::cos(glm::radians(lamp.coneDeg) / 2) : -2.0F);
        constants.emplace_back(spot ? glm::normalize(lamp.target - lamp.position) : glm::vec3(0),
                               0);
        constants.emplace_back(lamp.colour, 0);
    }
    return constants;
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
            glm::dvec4(c.scale),
            glm::dvec4(c.part),
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
    for (const MapSettings& map : maps)
        FrameSettings{.resolution = map.resolution,
                      .radiusUv = map.radiusUv,
                      .minRadiusUv = map.minRadiusUv,
                      .fadeWeight = map.fadeWeight,
                      .fadeFrom = map.fadeFrom}
            .validate(info);
    if (samplesPerPixelEdge < 1 || samplesPerPixelEdge > 16)
        rejectSetting("samplesPerPixelEdge", std::to_string(samplesPerPixelEdge), "in [1, 16]");
}

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
    fitViews();
    makeVisibilities();
    uploadScene();
}

void Renderer::setCamera(const OrbitCamera& camera) {
    scene_.camera = camera;
    fitViews();
}

void Renderer::setSun(const Sun& sun) {
    fitShadowWindow(scene_.casters, sun);  // throws for a sun that gives no light
    scene_.sun = sun;
    fitViews();
}

void Renderer::setCascades(int count) {
    checkLights(count, scene_.lamps);
    scene_.cascades = count;
    fitViews();
}

void Renderer::setLamps(std::vector<Lamp> lamps) {
    checkLights(scene_.cascades, lamps);
    scene_.lamps = std::move(lamps);
    fitViews();
    makeVisibilities();
}

void Renderer::setWindowFit(WindowFit fit) {
    windowFit_ = fit;
    fitViews();
}

void Renderer::setReach(double reachM) {
    if (!(reachM >= 0) || !std::isfinite(reachM))
        throw std::invalid_argument("kernel reach is " + std::to_string(reachM) +
                                    " m, must be finite and at least 0");
    reachM_ = reachM;
    fitViews();
}

void Renderer::setLightViews(std::span<const LightView> views) {
    if (views.size() != fitted_.size())
        throw std::invalid_argument("light views: " + std::to_string(views.size()) +
                                    " were given, the scene has " + std::to_string(fitted_.size()));
    fitted_.assign(views.begin(), views.end());
    views_ = fitted_;
}

void Renderer::fitViews() {
    const ShadowWindow whole = fitShadowWindow(scene_.casters, scene_.sun);
    const bool toView = (windowFit_ == WindowFit::view || scene_.cascades > 1) && widthPx_ > 0;
    if (toView) {
        fitted_ = sunViews(whole, scene_.casters, scene_.camera,
                           static_cast<double>(widthPx_) / heightPx_, scene_.cascades, reachM_,
                           windowSteps_);
    } else {
        fitted_.assign(1, {});
        fitted_.front().window = whole;
    }
    for (std::size_t lamp = 0; lamp < scene_.lamps.size(); ++lamp)
        for (const LightView& view : lampViews(scene_.lamps[lamp], lamp + 1))
            fitted_.push_back(view);
    views_ = fitted_;
    if (shadows_.size() != views_.size()) lastTechnique_ = nullptr;
    maps_.resize(views_.size());
}

void Renderer::makeVisibilities() {
    lastTechnique_ = nullptr;
    if (widthPx_ == 0) return;
    visibilityTargets_.clear();
    visibilities_.clear();
    lampVisibilities_ = {};
    visibilities_.push_back(makeTexture(GL_R32F, widthPx_, heightPx_, "visibility"));
    const auto lamps = static_cast<int>(scene_.lamps.size());
    if (lamps > 0)
        lampVisibilities_ =
            makeTextureArray(GL_R32F, widthPx_, heightPx_, lamps, 1, "lamps' visibilities");
    for (int lamp = 0; lamp < lamps; ++lamp)
        visibilities_.push_back(
            makeLayerView(GL_R32F, lampVisibilities_, lamp, "lamp's visibility"));
    for (const Texture& visibility : visibilities_)
        visibilityTargets_.push_back(makeFramebuffer({visibility.name()}, 0, "lookup"));
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
    return Outputs{.positions = positions_.name(),
                   .planes = planes_.name(),
                   .normals = normals_.name(),
                   .albedos = albedos_.name(),
                   .visibility = visibilities_[views_.at(view).light].name(),
                   .lit = lit_.name(),
                   .depths = maps_.at(view).depths.name(),
                   .technique = lastTechnique_,
                   .hasKernel = lastTechnique_->soft && shadows_.at(view).kernel.x > 0};
}

void Renderer::bindConstants(std::size_t view) const {
    glBindBufferBase(GL_UNIFORM_BUFFER, kViewBinding, viewBlock_.name());
    glBindBufferBase(GL_UNIFORM_BUFFER, kShadowBinding, shadowBlocks_.at(view).name());
    glBindBufferBase(GL_UNIFORM_BUFFER, kLookBinding, lookBlock_.name());
}

std::size_t Renderer::targetBytes() const {
    const std::size_t perPixel = 16 + 16 + 8 + 4 + 4 + 4 + 4 * lights();  // as resize() makes them
    return perPixel * static_cast<std::size_t>(widthPx_) * static_cast<std::size_t>(heightPx_);
}

std::size_t Renderer::mapBytes() const {
    std::size_t texels = 0;
    for (const Map& map : maps_)
        texels += static_cast<std::size_t>(map.edge) * static_cast<std::size_t>(map.edge);
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

void Renderer::ensureMap(std::size_t view, int resolution) {
    Map& map = maps_[view];
    const int edge = std::max(resolution, reservedEdge_);
    if (edge == map.edge) return;
    // The old one first: two maps at once may be more than there is room for.
    map = {};
    map.depths = makeTexture(GL_DEPTH_COMPONENT32F, edge, edge, "shadow map");
    map.target = makeFramebuffer({}, map.depths.name(), "shadow map");
    map.edge = edge;
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

    view_.clipFromEyeRelative = glm::perspectiveRH_ZO(verticalField, width / height,
                                                      nearestSeenM(camera), farthestSeenM(camera)) *
                                glm::lookAtRH(glm::vec3(0), forward, glm::vec3(0, 1, 0));
    view_.eye = glm::vec4(eye, 0);
    view_.pixelRight = glm::vec4(right * pixel, 0);
    view_.pixelUp = glm::vec4(up * pixel, 0);
    view_.forward = glm::vec4(forward, 0);
    view_.viewport = {width, height, 1 / width, 1 / height};

    for (std::size_t view = 0; view < views_.size(); ++view)
        setShadowConstants(settings, view, mapSettings(settings, view).resolution);
    fillUniformBlock(viewBlock_, view_);
    fillUniformBlock(lookBlock_, lookOf(scene_));
    bindConstants();
}

void Renderer::setShadowConstants(const FrameSettings& settings, std::size_t view, int resolution) {
    const glm::vec3 eye(view_.eye);
    const MapSettings map = mapSettings(settings, view);
    const Technique& technique =
        settings.technique != nullptr ? *settings.technique : techniques().front();
    const ParameterValues values = settings.parameters.value_or(technique.standardParameters());
    ShadowWindow& window = views_[view].window;
    window = snapToTexels(fitted_[view].window, resolution);
    f32::ShadowConstants& shadow = shadows_[view];
    shadow.shadowFromEyeRelative =
        glm::mat4(window.shadowFromWorld * glm::translate(glm::dmat4(1), glm::dvec3(eye)));
    shadow.shadowFromWorld = glm::mat4(window.shadowFromWorld);
    shadow.towardsLight = window.lampAt ? glm::vec4(glm::vec3(*window.lampAt - glm::dvec3(eye)), 1)
                                        : glm::vec4(window.towardsLight, 0);
    shadow.map = {static_cast<float>(resolution), 1 / static_cast<float>(resolution),
                  1 / static_cast<float>(maps_[view].edge),
                  static_cast<float>(window.lampAt ? window.depthRangeM / window.nearM : 0)};
    shadow.kernel = {map.radiusUv, map.minRadiusUv,
                     static_cast<float>(settings.samplesPerPixelEdge), 0};
    shadow.parameters[0] = glm::make_vec4(values.data());
    shadow.parameters[1] = glm::make_vec4(values.data() + 4);
    shadow.scale = {window.nearM, window.depthRangeM, window.extentM, window.lampAt ? 1 : 0};
    shadow.part = {window.part.fromM, window.part.toM, window.part.halfWidthUv, 0};
    shadow.prefilter =
        prefilterConstants(technique, values, map.radiusUv, map.minRadiusUv, resolution);
    fillUniformBlock(shadowBlocks_[view], shadow);
}

MapSettings Renderer::mapSettings(const FrameSettings& settings, std::size_t view) const {
    if (!settings.maps.empty()) return settings.maps[view];
    const LightView& own = fitted_[view];
    if (view == 0)
        return {settings.resolution, settings.radiusUv, settings.minRadiusUv, settings.fadeWeight,
                settings.fadeFrom};
    const double radius = own.light > 0 ? own.softnessUv
                                        : static_cast<double>(settings.radiusUv) *
                                              fitted_.front().window.extentM / own.window.extentM;
    return {.resolution = settings.resolution,
            .radiusUv = static_cast<float>(std::min(radius, 1.0))};
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
    ShaderLibrary own = shaders;
    for (std::size_t row = 0; row < lookups.size(); ++row) {
        if (lookupPrograms_[row].name() == 0) continue;
        const Technique& technique = techniques()[row % techniques().size()];
        lookups[row] = makeLookupProgram(shaders, technique, row >= techniques().size());
        mapFilter.prepare(technique);
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
}

const Program& Renderer::lookupProgram(const Technique& technique, bool ofPart) {
    const auto row = static_cast<std::size_t>(&technique - techniques().data());
    Program& program = lookupPrograms_.at(ofPart ? techniques().size() + row : row);
    if (program.name() == 0) program = makeLookupProgram(shaders_, technique, ofPart);
    return program;
}

void Renderer::render(const FrameSettings& settings, PassClock* clock) {
    settings.validate(info_);
    if (!settings.maps.empty() && settings.maps.size() != fitted_.size())
        rejectSetting("maps", std::to_string(settings.maps.size()) + " long",
                      "one for each of the frame's " + std::to_string(fitted_.size()) + " maps");
    const Technique& technique =
        settings.technique != nullptr ? *settings.technique : techniques().front();
    prepare(technique);
    if (technique.prefilter == Prefilter::none) mapFilter_.release();
    if (!hasLayers(technique)) forgetDepths();  // their count is of an earlier light
    int smallest = info_.maxResolution, largest = 0;
    for (std::size_t view = 0; view < views_.size(); ++view) {
        const MapSettings map = mapSettings(settings, view);
        const int other = map.fadeWeight < 1 ? map.fadeFrom : map.resolution;
        ensureMap(view, std::max(map.resolution, other));
        smallest = std::min({smallest, map.resolution, other});
        largest = std::max({largest, map.resolution, other});
    }
    // Maps of several sizes are filtered in the same textures.
    filterSpare_ = smallest == largest ? reservedEdge_ : std::max(largest, reservedEdge_);
    lastTechnique_ = &technique;
    shadows_.resize(views_.size());
    while (shadowBlocks_.size() < views_.size())
        shadowBlocks_.push_back(makeUniformBlock(f32::ShadowConstants{}, "shadow constants"));
    updateConstants(settings);
    {
        const PassScope scope(Pass::prepass, clock);
        drawPrepass();
    }
    clearVisibilities();
    for (std::size_t view = 0; view < views_.size(); ++view) {
        const MapSettings map = mapSettings(settings, view);
        if (map.fadeWeight < 1) {
            // First, so that the map of this frame is the one that later passes find.
            setShadowConstants(settings, view, map.fadeFrom);
            drawShadows(settings, technique, view, 1, clock);
            setShadowConstants(settings, view, map.resolution);
        }
        drawShadows(settings, technique, view, map.fadeWeight, clock);
    }
    if (settings.lit) {
        if (views_.size() > 1) bindConstants();
        const PassScope scope(Pass::lit, clock);
        drawLit();
    }
    throwOnGlError();
}

void Renderer::drawShadows(const FrameSettings& settings, const Technique& technique,
                           std::size_t view, float weight, PassClock* clock) {
    bindConstants(view);
    {
        const PassScope scope(Pass::depth, clock);
        drawCasters(maps_[view].target, static_cast<int>(shadows_[view].map.x), view);
    }
    if (technique.prefilter != Prefilter::none) {
        const PassScope scope(Pass::prefilter, clock);
        const ParameterValues parameters = withLayers(
            technique, settings.parameters.value_or(technique.standardParameters()), view);
        mapFilter_.run(technique, parameters, shadows_[view], maps_[view].depths, filterSpare_);
    }
    const PassScope scope(Pass::lookup, clock);
    drawLookup(technique, view, weight);
}

void Renderer::drawCasters(const Framebuffer& target, int edge, std::size_t view) const {
    const bool lamp = views_.at(view).window.lampAt.has_value();
    glBindFramebuffer(GL_FRAMEBUFFER, target.name());
    glViewport(0, 0, edge, edge);
    // The sub-rectangle alone: clearing a large texture costs more than drawing a small map.
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, 0, edge, edge);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDepthMask(GL_TRUE);
    if (!lamp) glEnable(GL_DEPTH_CLAMP);
    const float farthest = 1;
    glClearBufferfv(GL_DEPTH, 0, &farthest);
    glUseProgram(lamp ? lampDepthProgram_.name() : depthProgram_.name());
    glBindVertexArray(geometry_.name());
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(indexCount_), GL_UNSIGNED_INT, nullptr);
    glDisable(GL_DEPTH_CLAMP);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_DEPTH_TEST);
}

ParameterValues Renderer::withLayers(const Technique& technique, const ParameterValues& asked,
                                     std::size_t view) {
    if (!hasLayers(technique)) return asked;
    f32::ShadowConstants& shadow = shadows_[view];
    while (depthCounters_.size() < views_.size())
        depthCounters_.push_back(std::make_unique<DepthCounter>());
    const Layers layers = placeLayers(
        technique, asked,
        depthCounters_[view]->count(shaders_, maps_[view].depths, static_cast<int>(shadow.map.x)));
    useLayers(technique, layers, shadow);
    fillUniformBlock(shadowBlocks_[view], shadow);
    ParameterValues values = asked;
    values[technique.parameterSlot("layers").value()] = static_cast<float>(layers.count);
    return values;
}

void Renderer::forgetDepths() {
    for (const auto& counter : depthCounters_) counter->forget();
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

void Renderer::clearVisibilities() {
    const float lit = 1;
    for (const LightView& view : views_)
        if (view.window.part != kAllReceivers)
            glClearNamedFramebufferfv(visibilityTargets_[view.light].name(), GL_COLOR, 0, &lit);
}

void Renderer::drawLookup(const Technique& technique, std::size_t view, float weight) {
    if (weight < 1) {
        glEnable(GL_BLEND);
        glBlendColor(0, 0, 0, weight);
        glBlendFunc(GL_CONSTANT_ALPHA, GL_ONE_MINUS_CONSTANT_ALPHA);
    }
    glBindFramebuffer(GL_FRAMEBUFFER, visibilityTargets_[views_[view].light].name());
    glViewport(0, 0, widthPx_, heightPx_);
    const bool filtered = technique.prefilter != Prefilter::none;
    bindTextures({positions_.name(), planes_.name(),
                  filtered ? mapFilter_.map() : maps_[view].depths.name()});
    glUseProgram(lookupProgram(technique, views_[view].window.part != kAllReceivers).name());
    glBindVertexArray(noGeometry_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisable(GL_BLEND);
}

void Renderer::drawLit() {
    glBindFramebuffer(GL_FRAMEBUFFER, litTarget_.name());
    glViewport(0, 0, widthPx_, heightPx_);
    bindTextures({positions_.name(), planes_.name(), normals_.name(), albedos_.name(),
                  visibilities_[0].name()});
    if (scene_.lamps.empty()) {
        glUseProgram(litProgram_.name());
    } else {
        glUseProgram(lampLitProgram_.name());
        glBindTextureUnit(5, lampVisibilities_.name());
        const std::vector<glm::vec4> lamps = lampConstants(scene_.lamps, glm::vec3(view_.eye));
        glUniform1i(0, static_cast<GLint>(scene_.lamps.size()));
        glUniform4fv(1, static_cast<GLsizei>(lamps.size()), glm::value_ptr(lamps.front()));
    }
    glBindVertexArray(noGeometry_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace renderer

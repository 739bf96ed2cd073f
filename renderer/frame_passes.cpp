// SPDX-License-Identifier: MIT
// The passes of a frame, in their order.
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <memory>
#include <stdexcept>

#include "renderer/renderer.h"
#include "renderer/uniform_block.h"

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

void bindTextures(std::initializer_list<GLuint> names) {
    GLuint unit = 0;
    for (const GLuint name : names) glBindTextureUnit(unit++, name);
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

/// The lower left corner alone: clearing a large texture costs more than drawing a small map.
void clearDepths(const Framebuffer& target, int edge) {
    const float farthest = 1;
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, 0, edge, edge);
    glDepthMask(GL_TRUE);
    glClearNamedFramebufferfv(target.name(), GL_DEPTH, 0, &farthest);
    glDisable(GL_SCISSOR_TEST);
}

/// As depth.vert does it.
glm::dmat4 mapClip(const f32::ShadowConstants& shadow) {
    const glm::dmat4 h = glm::transpose(glm::dmat4(shadow.shadowFromWorld));
    glm::dmat4 clip(2.0 * h[0] - h[3], 2.0 * h[1] - h[3], h[2], h[3]);
    if (shadow.scale.w > 0) {
        const auto nearM = static_cast<double>(shadow.scale.x);
        const auto rangeM = static_cast<double>(shadow.scale.y);
        clip[2] = (h[3] - glm::dvec4(0, 0, 0, nearM)) * ((nearM + rangeM) / rangeM);
    }
    return glm::transpose(clip);
}

/// Of the prepass.
ConvexBody seenVolume(const f32::ViewConstants& view, const Bounds& surfaces) {
    const glm::vec3 eye(view.eye);
    return clipVolume(glm::translate(glm::dmat4(view.clipFromEyeRelative), -glm::dvec3(eye)), false,
                      {glm::min(surfaces.low, eye), glm::max(surfaces.high, eye)});
}

/// Of the vertex array that is bound. Returns the number of triangles.
std::size_t drawRuns(std::span<const IndexRun> runs) {
    std::vector<GLsizei> counts;
    std::vector<const void*> firsts;
    std::size_t indices = 0;
    for (const IndexRun& run : runs) {
        counts.push_back(static_cast<GLsizei>(run.count));
        firsts.push_back(reinterpret_cast<const void*>(run.first * sizeof(std::uint32_t)));
        indices += run.count;
    }
    glMultiDrawElements(GL_TRIANGLES, counts.data(), GL_UNSIGNED_INT, firsts.data(),
                        static_cast<GLsizei>(runs.size()));
    return indices / 3;
}

/// Of a map's technique, layers among them.
ParameterValues parametersIn(const f32::ShadowConstants& shadow) {
    ParameterValues values;
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = shadow.parameters[i / 4][static_cast<glm::length_t>(i % 4)];
    return values;
}

/// Mesa's llvmpipe runs a compute pass that reads what was drawn before that is rasterised, once
/// another framebuffer is bound.
void waitForRasteriser(const GlInfo& info) {
    if (info.softwareRasteriser) glFinish();
}

void throwOnGlError() {
    const GLenum error = glGetError();
    if (error != GL_NO_ERROR)
        throw std::runtime_error("rendering: the driver reports GL error " + std::to_string(error) +
                                 (error == GL_OUT_OF_MEMORY ? " (out of memory)" : ""));
}

}  // namespace

void Renderer::render(const FrameSettings& settings, PassClock* clock) {
    checkSettings(settings);
    const Technique& technique =
        settings.technique != nullptr ? *settings.technique : techniques().front();
    prepare(technique);
    if (technique.prefilter == Prefilter::none) mapFilter_.release();
    if (!hasLayers(technique)) forgetDepths();  // their count is of an earlier light
    const int samples =
        technique.mapSamples(settings.parameters.value_or(technique.standardParameters()));
    int smallest = info_.maxResolution, largest = 0;
    for (std::size_t view = 0; view < views_.size(); ++view) {
        const MapSettings map = mapSettings(settings, view);
        const int other = map.fadeWeight < 1 ? map.fadeFrom : map.resolution;
        ensureMap(view, std::max(map.resolution, other), samples);
        smallest = std::min({smallest, map.resolution, other});
        largest = std::max({largest, map.resolution, other});
    }
    // All maps are filtered in the same textures; those of one size differ in their guard bands.
    const bool several = views_.size() > 1 || smallest != largest;
    const int spare = several ? std::max(largest, reservedEdge_) : reservedEdge_;
    if (spare < filterSpare_) mapFilter_.release();
    filterSpare_ = spare;
    lastTechnique_ = &technique;
    shadows_.resize(views_.size());
    while (shadowBlocks_.size() < views_.size())
        shadowBlocks_.push_back(makeUniformBlock(f32::ShadowConstants{}, "shadow constants"));
    updateConstants(settings);
    {
        const PassScope scope(Pass::prepass, clock);
        drawPrepass(settings.drawOutside);
    }
    if (technique.prefilter != Prefilter::none) waitForRasteriser(info_);
    clearVisibilities();
    drawnTriangles_ = 0;
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
    const auto edge = static_cast<int>(shadows_[view].map.x);
    if (served_[view].empty()) {
        clearDepths(maps_[view].target, edge);  // so that whoever reads it finds no other frame's
        return;
    }
    {
        const PassScope scope(Pass::depth, clock);
        const Map& map = maps_[view];
        drawnTriangles_ += drawCasters(map.target, edge, shadows_[view], settings.drawOutside);
        if (map.samples > 1)
            drawnTriangles_ +=
                drawCasters(map.sampledTarget, edge, shadows_[view], settings.drawOutside);
    }
    if (maps_[view].samples > 1 && hasLayers(technique)) waitForRasteriser(info_);
    if (technique.prefilter != Prefilter::none) {
        const PassScope scope(Pass::prefilter, clock);
        enterLayers(technique, settings.parameters.value_or(technique.standardParameters()), view);
        const VisibleSurfaces seen{.positions = positions_.name(), .pixels = served_[view]};
        filterMap(technique, view,
                  {.seen = settings.filterUnseen ? nullptr : &seen,
                   .outsidePenumbrae = !settings.filterOutsidePenumbrae});
    }
    const PassScope scope(Pass::lookup, clock);
    drawLookup(technique, view, weight);
}

std::size_t Renderer::drawCasters(const Framebuffer& target, int edge,
                                  const f32::ShadowConstants& shadow, bool outside) const {
    const bool lamp = shadow.scale.w > 0;
    clearDepths(target, edge);
    glBindFramebuffer(GL_FRAMEBUFFER, target.name());
    glViewport(0, 0, edge, edge);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    if (!lamp) glEnable(GL_DEPTH_CLAMP);
    glUseProgram(lamp ? lampDepthProgram_.name() : depthProgram_.name());
    glBindVertexArray(geometry_.name());
    const std::size_t drawn =
        outside ? drawRuns(std::array{IndexRun{0, indexCount_}})
                : drawRuns(runsWithin(pieces_, clipVolume(mapClip(shadow), !lamp, surfaces_)));
    glDisable(GL_DEPTH_CLAMP);
    glDisable(GL_DEPTH_TEST);
    return drawn;
}

void Renderer::filterMap(const Technique& technique, std::size_t view,
                         const LeftOut& leave) {
    const Map& map = maps_[view];
    mapFilter_.run(technique, parametersIn(shadows_[view]), shadows_[view],
                   map.samples > 1 ? map.sampledDepths : map.depths, filterSpare_, leave);
}

void Renderer::enterLayers(const Technique& technique, const ParameterValues& asked,
                           std::size_t view) {
    if (!hasLayers(technique)) return;
    f32::ShadowConstants& shadow = shadows_[view];
    const Layers layers = placeLayers(
        technique, asked,
        depthCounters_[view]->count(shaders_, maps_[view].depths, static_cast<int>(shadow.map.x)));
    useLayers(technique, layers, shadow);
    fillUniformBlock(shadowBlocks_[view], shadow);
}

void Renderer::forgetDepths() {
    for (const auto& counter : depthCounters_) counter->forget();
}

void Renderer::drawPrepass(bool outside) {
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
    const ConvexBody seen = outside ? ConvexBody() : seenVolume(view_, surfaces_);
    for (const DrawRange& range : ranges_) {
        const std::vector<IndexRun> runs = runsWithin(range.pieces, seen);
        if (runs.empty()) continue;
        const Material& material = range.material;
        const glm::vec4 albedo(material.albedo, material.gloss);
        const glm::vec4 second(material.second, material.periodM);
        glUniform4fv(0, 1, glm::value_ptr(albedo));
        glUniform4fv(1, 1, glm::value_ptr(second));
        glUniform1ui(2, static_cast<GLuint>(material.pattern));
        drawRuns(runs);
    }
    glDisable(GL_FRAMEBUFFER_SRGB);
    glDisable(GL_DEPTH_TEST);
}

void Renderer::clearVisibilities() {
    const float lit = 1;
    for (const Framebuffer& target : visibilityTargets_)
        glClearNamedFramebufferfv(target.name(), GL_COLOR, 0, &lit);
}

void Renderer::drawLookup(const Technique& technique, std::size_t view, float weight) {
    if (weight < 1) {
        glEnable(GL_BLEND);
        glBlendColor(0, 0, 0, weight);
        glBlendFunc(GL_CONSTANT_ALPHA, GL_ONE_MINUS_CONSTANT_ALPHA);
    }
    glBindFramebuffer(GL_FRAMEBUFFER, visibilityTargets_[views_[view].light].name());
    glViewport(0, 0, widthPx_, heightPx_);
    const PixelRect& served = served_[view];
    glEnable(GL_SCISSOR_TEST);
    glScissor(served.x, served.y, served.width, served.height);
    const bool filtered = technique.prefilter != Prefilter::none;
    bindTextures({positions_.name(), planes_.name(),
                  filtered ? mapFilter_.map() : maps_[view].depths.name()});
    glUseProgram(lookupProgram(technique, views_[view].window.part != kAllReceivers).name());
    glBindVertexArray(noGeometry_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisable(GL_SCISSOR_TEST);
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

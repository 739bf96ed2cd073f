// SPDX-License-Identifier: MIT
// Renderer's uniform blocks: what camera, lights and settings come to in the shaders.
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "renderer/prefilter.h"
#include "renderer/renderer.h"
#include "renderer/uniform_block.h"

namespace renderer {
namespace {

/// A late-afternoon sky; chosen by eye.
f32::LookConstants lookOf(const Scene& scene) {
    return {.sunColour = glm::vec4(scene.sun.colour, 0),
            .zenithColour = {0.13F, 0.33F, 0.85F, 0},
            .horizonColour = {0.72F, 0.86F, 1.05F, 0},
            .skyLight = {0.30F, 0.39F, 0.56F, 0},
            .groundLight = {0.36F, 0.29F, 0.22F, 0},
            .tone = {0.66F, scene.hazeM, 0, 0}};
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
            glm::dvec4(c.stretch),
            glm::dvec4(c.prefilter),
            {glm::dvec4(c.layerEnds[0]), glm::dvec4(c.layerEnds[1]), glm::dvec4(c.layerEnds[2]),
             glm::dvec4(c.layerEnds[3])}};
}

void Renderer::bindConstants(std::size_t view) const {
    glBindBufferBase(GL_UNIFORM_BUFFER, kViewBinding, viewBlock_.name());
    glBindBufferBase(GL_UNIFORM_BUFFER, kShadowBinding, shadowBlocks_.at(view).name());
    glBindBufferBase(GL_UNIFORM_BUFFER, kLookBinding, lookBlock_.name());
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
    // Without a kernel no blur hides the map's steps, so nothing may count on one.
    const bool soft = technique.soft;
    shadow.kernel = {soft ? map.radiusUv : 0, soft ? map.minRadiusUv : 0,
                     static_cast<float>(settings.samplesPerPixelEdge), 0};
    shadow.parameters[0] = glm::make_vec4(values.data());
    shadow.parameters[1] = glm::make_vec4(values.data() + 4);
    shadow.scale = {window.nearM, window.depthRangeM, window.extentM, window.lampAt ? 1 : 0};
    shadow.part = {window.part.lowUv, window.part.highUv};
    shadow.stretch = {window.part.fromM, window.part.toM, 0, 0};
    shadow.prefilter =
        prefilterConstants(technique, values, map.radiusUv, map.minRadiusUv, resolution);
    fillUniformBlock(shadowBlocks_[view], shadow);
}

}  // namespace renderer

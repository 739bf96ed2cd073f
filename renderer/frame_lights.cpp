// SPDX-License-Identifier: MIT
// Renderer's camera and lights: which maps they need, and a visibility for each light.
#include <cmath>
#include <stdexcept>

#include "renderer/renderer.h"

namespace renderer {

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
    useViews({views.begin(), views.end()});
}

void Renderer::fitViews() {
    const ShadowWindow whole = fitShadowWindow(scene_.casters, scene_.sun);
    std::vector<LightView> fitted;
    const bool toView = (windowFit_ == WindowFit::view || scene_.cascades > 1) && widthPx_ > 0;
    if (toView) {
        fitted = sunViews(whole, scene_.casters, scene_.camera,
                          static_cast<double>(widthPx_) / heightPx_, scene_.cascades, reachM_,
                          windowSteps_);
    } else {
        fitted.emplace_back();
        fitted.front().window = whole;
    }
    const std::size_t firstOfLamps = fitted.size();
    for (std::size_t lamp = 0; lamp < scene_.lamps.size(); ++lamp)
        for (LightView& view : lampViews(scene_.lamps[lamp], lamp + 1)) {
            fitLampDepth(view.window, scene_.casters, surfaces_);
            fitted.push_back(std::move(view));
        }
    lampSteps_.resize(fitted.size() - firstOfLamps);
    if (windowFit_ == WindowFit::view && widthPx_ > 0) {
        ConvexBody seen = viewVolume(scene_.camera, static_cast<double>(widthPx_) / heightPx_,
                                     static_cast<double>(nearestSeenM(scene_.camera)),
                                     static_cast<double>(farthestSeenM(scene_.camera)));
        cutToBox(seen, surfaces_);
        for (std::size_t i = 0; i < lampSteps_.size(); ++i)
            narrowLampView(fitted[firstOfLamps + i], scene_.casters, seen, lampSteps_[i]);
    }
    useViews(std::move(fitted));
    if (shadows_.size() != views_.size()) lastTechnique_ = nullptr;
    maps_.resize(views_.size());
}

void Renderer::useViews(std::vector<LightView> fitted) {
    fitted_ = std::move(fitted);
    views_ = fitted_;
    served_.clear();
    for (const LightView& view : fitted_)
        served_.push_back(widthPx_ == 0 ? PixelRect()
                                        : renderer::servedPixels(view, scene_.camera, surfaces_,
                                                                 widthPx_, heightPx_));
}

PixelRect Renderer::pixelsBetween(std::size_t view, const glm::dvec2& lowUv,
                                  const glm::dvec2& highUv) const {
    LightView between = views_.at(view);
    ViewPart& part = between.window.part;
    part.lowUv = glm::max(part.lowUv, lowUv);
    part.highUv = glm::min(part.highUv, highUv);
    return renderer::servedPixels(between, scene_.camera, surfaces_, widthPx_, heightPx_);
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

}  // namespace renderer

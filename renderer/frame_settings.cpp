// SPDX-License-Identifier: MIT
// What a frame is asked for, and what of it each of its maps gets.
#include <algorithm>
#include <stdexcept>

#include "renderer/renderer.h"

namespace renderer {
namespace {

[[noreturn]] void rejectSetting(const std::string& name, const std::string& value,
                                const std::string& rule) {
    throw std::invalid_argument("frame settings: " + name + " is " + value + ", must be " + rule);
}

void checkUnit(const std::string& name, float value) {
    if (!(value >= 0 && value <= 1)) rejectSetting(name, std::to_string(value), "in [0, 1]");
}

}  // namespace

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

void Renderer::checkSettings(const FrameSettings& settings) const {
    settings.validate(info_);
    if (!settings.maps.empty() && settings.maps.size() != fitted_.size())
        rejectSetting("maps", std::to_string(settings.maps.size()) + " long",
                      "one for each of the frame's " + std::to_string(fitted_.size()) + " maps");
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

}  // namespace renderer

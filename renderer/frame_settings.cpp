// SPDX-License-Identifier: MIT
// What a frame is asked for, and what of it each of its maps gets.
#include <algorithm>
#include <stdexcept>

#include "renderer/prefilter.h"
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

void checkSize(const std::string& name, int resolution, const GlInfo& info) {
    if (resolution < 1 || resolution > info.maxResolution)
        rejectSetting(name, std::to_string(resolution),
                      "in [1, " + std::to_string(info.maxResolution) +
                          "], what the driver allows (" + info.renderer + ")");
}

/// `of`: where the map's settings stand.
void checkMap(const std::string& of, const MapSettings& map, const GlInfo& info) {
    checkSize(of + "resolution", map.resolution, info);
    checkUnit(of + "radiusUv", map.radiusUv);
    checkUnit(of + "minRadiusUv", map.minRadiusUv);
    checkUnit(of + "fadeWeight", map.fadeWeight);
    if (map.fadeWeight < 1) checkSize(of + "fadeFrom", map.fadeFrom, info);
}

/// With what its kernel needs around it.
void checkFilteredSize(const std::string& of, const MapSettings& map, const Technique& technique,
                       const ParameterValues& values, const GlInfo& info) {
    f32::ShadowConstants shadow{};
    shadow.map.x = static_cast<float>(map.resolution);
    shadow.prefilter =
        prefilterConstants(technique, values, map.radiusUv, map.minRadiusUv, map.resolution);
    if (technique.prefilter != Prefilter::none && filteredEdge(shadow) > info.maxResolution)
        rejectSetting(of + "resolution", std::to_string(map.resolution),
                      "so small that the map filtered by " + std::string(technique.name) +
                          ", which with its kernel's reach around it is " +
                          std::to_string(filteredEdge(shadow)) + " texels wide, is within the " +
                          std::to_string(info.maxResolution) + " that the driver allows");
}

}  // namespace

void FrameSettings::validate(const GlInfo& info) const {
    checkMap("", {resolution, radiusUv, minRadiusUv, fadeWeight, fadeFrom}, info);
    for (std::size_t i = 0; i < maps.size(); ++i)
        checkMap("maps[" + std::to_string(i) + "].", maps[i], info);
    const Technique& used = technique != nullptr ? *technique : techniques().front();
    if (parameters) checkParameters(used, *parameters);
    if (samplesPerPixelEdge < 1 || samplesPerPixelEdge > 16)
        rejectSetting("samplesPerPixelEdge", std::to_string(samplesPerPixelEdge), "in [1, 16]");
}

void Renderer::checkSettings(const FrameSettings& settings) const {
    settings.validate(info_);
    if (!settings.maps.empty() && settings.maps.size() != fitted_.size())
        rejectSetting("maps", std::to_string(settings.maps.size()) + " long",
                      "one for each of the frame's " + std::to_string(fitted_.size()) + " maps");
    const Technique& technique =
        settings.technique != nullptr ? *settings.technique : techniques().front();
    for (std::size_t view = 0; view < fitted_.size(); ++view) {
        MapSettings map = mapSettings(settings, view);
        const std::string of = settings.maps.empty() ? "" : "maps[" + std::to_string(view) + "].";
        const ParameterValues values = settings.parameters.value_or(technique.standardParameters());
        checkFilteredSize(of, map, technique, values, info_);
        if (map.fadeWeight == 1) continue;
        map.resolution = map.fadeFrom;
        checkFilteredSize(of, map, technique, values, info_);
    }
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

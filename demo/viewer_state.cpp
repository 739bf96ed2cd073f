// SPDX-License-Identifier: MIT
#include "demo/viewer_state.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "records/json_document.h"
#include "records/json_fields.h"
#include "records/whole_file.h"
#include "renderer/scene_file.h"

namespace demo {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kSmallestFixed = 128;  // key 1; each further digit doubles it
constexpr double kLeastPercentile = 0.5;
constexpr int kMostFadeFrames = 120;
constexpr std::int64_t kMostBudgetTexels = 1'000'000'000'000;
constexpr float kLeastGain = 1, kMostGain = 64;
constexpr float kLeastAngleDeg = 2, kMostAngleDeg = 88;
constexpr float kLeastDistance = 0.2F, kMostDistance = 6;  // of the scene's own
constexpr std::array<std::pair<std::string_view, Path>, 3> kPathWords = {
    {{"still", Path::still}, {"camera", Path::camera}, {"sun", Path::sun}}};
constexpr const char* kSchema = "stairwell-viewer-state 1.0";

std::array<std::pair<std::string_view, renderer::View>, renderer::kAllViews.size()> viewWords() {
    std::array<std::pair<std::string_view, renderer::View>, renderer::kAllViews.size()> words;
    for (std::size_t i = 0; i < words.size(); ++i)
        words[i] = {toText(renderer::kAllViews[i]), renderer::kAllViews[i]};
    return words;
}

template <class Words>
auto wordOf(const Words& words, const std::string& word, const std::string& option) {
    std::string known;
    for (const auto& [name, value] : words) {
        if (name == word) return value;
        known += (known.empty() ? "" : ", ") + std::string(name);
    }
    throw std::invalid_argument(option + " is \"" + word + "\", must be one of " + known);
}

template <class Table>
auto next(const Table& table, const auto& isCurrent) {
    const auto found = std::find_if(table.begin(), table.end(), isCurrent);
    return found == table.end() || found + 1 == table.end() ? table.begin() : found + 1;
}

/// `close` is ")" where the upper end is not allowed.
std::string outside(const char* field, double value, double low, double high,
                    const char* close = "]") {
    char sentence[160];
    std::snprintf(sentence, sizeof sentence, "%s: %g: must be in [%g, %g%s", field, value, low,
                  high, close);
    return sentence;
}

template <class T>
Json orNull(const std::optional<T>& value) {
    return value ? Json(*value) : Json();
}

std::optional<float> optionalFloat(const records::JsonFields& fields, const std::string& key) {
    const auto value = fields.optionalNumber(key);
    return value ? std::optional(static_cast<float>(*value)) : std::nullopt;
}

Json parametersJson(const ViewerState& state) {
    Json json = Json::object();
    for (const auto& [name, values] : state.parameters) {
        const renderer::Technique& technique = renderer::findTechnique(name);
        Json own = Json::object();
        for (std::size_t i = 0; i < technique.parameters.size(); ++i)
            own[std::string(technique.parameters[i].name)] = values[i];
        json[name] = own;
    }
    return json;
}

void readParameters(const records::JsonFields& fields, const std::string& where,
                    ViewerState& state) {
    for (const renderer::Technique& technique : renderer::techniques()) {
        const auto own = fields.optionalObject(std::string(technique.name));
        if (!own) continue;
        renderer::ParameterValues values = technique.standardParameters();
        for (const renderer::TechniqueParameter& parameter : technique.parameters) {
            const auto value = optionalFloat(*own, std::string(parameter.name));
            if (!value) continue;
            try {
                setParameter(technique, values, parameter.name, *value);
            } catch (const std::invalid_argument& error) {
                throw std::runtime_error(where + ": field parameters: " + error.what());
            }
        }
        own->noOtherFields();
        state.parameters[std::string(technique.name)] = values;
    }
    fields.noOtherFields();
}

}  // namespace

std::string validate(const ViewerState& state) {
    try {
        renderer::findTechnique(state.technique);
        if (!renderer::isModelFile(state.scene)) renderer::findScene(state.scene);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    // How large they may be, driver and scene say.
    for (const auto& [field, size] :
         {std::pair{"resolution", state.resolution.value_or(1)},
          std::pair{"compare_with", state.compareWith}, std::pair{"view_map", state.viewMap}})
        if (size < 1)
            return std::string(field) + ": " + std::to_string(size) + ": must be at least 1";
    if (!(state.gain >= kLeastGain && state.gain <= kMostGain))
        return outside("gain", static_cast<double>(state.gain), kLeastGain, kMostGain);
    if (!(state.splitAt >= 0 && state.splitAt <= 1))
        return outside("split_at", static_cast<double>(state.splitAt), 0, 1);
    if (!(state.pathPlace >= 0 && state.pathPlace < 1))
        return outside("path_place", state.pathPlace, 0, 1, ")");
    if (!(state.audience.detection >= 0 && state.audience.detection < 1))
        return outside("detection", state.audience.detection, 0, 1, ")");
    if (!(state.audience.people >= 0.01 && state.audience.people <= 0.99))
        return outside("people", state.audience.people, 0.01, 0.99);
    if (!(state.percentile >= kLeastPercentile && state.percentile <= 1))
        return outside("percentile", state.percentile, kLeastPercentile, 1);
    if (state.crossFadeFrames < 0 || state.crossFadeFrames > kMostFadeFrames)
        return outside("cross_fade_frames", state.crossFadeFrames, 0, kMostFadeFrames);
    if (state.budgetTexels && (*state.budgetTexels < 1 || *state.budgetTexels > kMostBudgetTexels))
        return outside("budget_texels", static_cast<double>(*state.budgetTexels), 1,
                       static_cast<double>(kMostBudgetTexels));
    for (const auto& [field, angle] : {std::pair{"camera_yaw_deg", state.cameraYawDeg},
                                       std::pair{"camera_pitch_deg", state.cameraPitchDeg},
                                       std::pair{"camera_distance_m", state.cameraDistanceM},
                                       std::pair{"sun_azimuth_deg", state.sunAzimuthDeg},
                                       std::pair{"sun_elevation_deg", state.sunElevationDeg}})
        if (angle && !(std::abs(*angle) <= 1000))
            return outside(field, static_cast<double>(*angle), -1000, 1000);
    return "";
}

ViewerState readViewerState(const std::filesystem::path& file) {
    const nlohmann::json json = records::readJson(file);
    const records::JsonFields fields(json, file.string());
    if (const std::string schema = fields.text("schema"); schema != kSchema)
        throw std::runtime_error(file.string() + ": field schema: \"" + schema + "\": must be \"" +
                                 kSchema + "\"");
    ViewerState state;
    state.scene = fields.text("scene");
    state.technique = fields.text("technique");
    if (const auto own = fields.optionalObject("parameters"))
        readParameters(*own, file.string(), state);
    state.resolution = fields.optionalInteger("resolution");
    state.compareWith = fields.integer("compare_with");
    state.radiusM = fields.optionalNumber("radius_m");
    state.radiusUv = fields.optionalNumber("radius_uv");
    if (const auto slope = fields.optionalText("slope")) state.slopeFile = *slope;
    state.audience.detection = fields.number("detection");
    state.audience.people = fields.number("people");
    // Files of before these settings have none.
    state.percentile = fields.optionalNumber("percentile").value_or(state.percentile);
    state.crossFadeFrames =
        fields.optionalInteger("cross_fade_frames").value_or(state.crossFadeFrames);
    if (const auto texels = fields.optionalUnsignedInteger("budget_texels"))
        state.budgetTexels = static_cast<std::int64_t>(
            std::min<std::uint64_t>(*texels, std::numeric_limits<std::int64_t>::max()));
    state.view = fields.word("view", viewWords());
    state.viewMap = fields.optionalInteger("view_map").value_or(state.viewMap);
    state.splitAt = static_cast<float>(fields.number("split_at"));
    state.gain = static_cast<float>(fields.number("gain"));
    state.cameraYawDeg = optionalFloat(fields, "camera_yaw_deg");
    state.cameraPitchDeg = optionalFloat(fields, "camera_pitch_deg");
    state.cameraDistanceM = optionalFloat(fields, "camera_distance_m");
    state.sunAzimuthDeg = optionalFloat(fields, "sun_azimuth_deg");
    state.sunElevationDeg = optionalFloat(fields, "sun_elevation_deg");
    state.path = fields.word("path", kPathWords);
    state.pathPlace = fields.number("path_place");
    state.panel = fields.boolean("panel");
    state.timePasses = fields.boolean("time_passes");
    fields.noOtherFields();
    if (const std::string problem = validate(state); !problem.empty())
        throw std::runtime_error(file.string() + ": field " + problem);
    return state;
}

void writeViewerState(const std::filesystem::path& file, const ViewerState& state) {
    const auto path = std::find_if(kPathWords.begin(), kPathWords.end(),
                                   [&](const auto& word) { return word.second == state.path; });
    const Json json = {
        {"schema", kSchema},
        {"scene", state.scene},
        {"technique", state.technique},
        {"parameters", parametersJson(state)},
        {"resolution", orNull(state.resolution)},
        {"compare_with", state.compareWith},
        {"radius_m", orNull(state.radiusM)},
        {"radius_uv", orNull(state.radiusUv)},
        {"slope",
         state.slopeFile ? Json(std::filesystem::absolute(*state.slopeFile).string()) : Json()},
        {"detection", state.audience.detection},
        {"people", state.audience.people},
        {"percentile", state.percentile},
        {"cross_fade_frames", state.crossFadeFrames},
        {"budget_texels", orNull(state.budgetTexels)},
        {"view", toText(state.view)},
        {"view_map", state.viewMap},
        {"split_at", state.splitAt},
        {"gain", state.gain},
        {"camera_yaw_deg", orNull(state.cameraYawDeg)},
        {"camera_pitch_deg", orNull(state.cameraPitchDeg)},
        {"camera_distance_m", orNull(state.cameraDistanceM)},
        {"sun_azimuth_deg", orNull(state.sunAzimuthDeg)},
        {"sun_elevation_deg", orNull(state.sunElevationDeg)},
        {"path", path->first},
        {"path_place", state.pathPlace},
        {"panel", state.panel},
        {"time_passes", state.timePasses}};
    records::writeWholeFile(file, json.dump(2) + "\n");
}

renderer::ParameterValues parametersOf(const ViewerState& state) {
    const auto own = state.parameters.find(state.technique);
    return own != state.parameters.end()
               ? own->second
               : renderer::findTechnique(state.technique).standardParameters();
}

float zoomed(float distanceM, float factor, const renderer::OrbitCamera& own) {
    return std::clamp(distanceM * factor, kLeastDistance * own.distanceM,
                      kMostDistance * own.distanceM);
}

renderer::OrbitCamera cameraOf(const ViewerState& state, const renderer::OrbitCamera& own,
                               const renderer::CameraPath& path) {
    renderer::OrbitCamera camera = own;
    camera.yawDeg = std::remainder(state.cameraYawDeg.value_or(camera.yawDeg), 360.0F);
    if (state.cameraPitchDeg)
        camera.pitchDeg = std::clamp(*state.cameraPitchDeg, kLeastAngleDeg, kMostAngleDeg);
    if (state.cameraDistanceM) camera.distanceM = zoomed(*state.cameraDistanceM, 1, own);
    return state.path == Path::camera ? along(path, camera, state.pathPlace) : camera;
}

renderer::Sun sunOf(const ViewerState& state, const renderer::Sun& own,
                    const renderer::SunPath& path) {
    renderer::Sun sun = own;
    sun.azimuthDeg = std::remainder(state.sunAzimuthDeg.value_or(sun.azimuthDeg), 360.0F);
    if (state.sunElevationDeg)
        sun.elevationDeg = std::clamp(*state.sunElevationDeg, kLeastAngleDeg, kMostAngleDeg);
    return state.path == Path::sun ? along(path, sun, state.pathPlace) : sun;
}

namespace {

/// Where an option stands behind the scene's name.
std::size_t placeOf(const std::string& option, const std::string& source) {
    return source.find(":" + option + "=", renderer::withoutOptions(source).size());
}

}  // namespace

int sceneOption(const std::string& source, const std::string& option, int standard) {
    const std::size_t at = placeOf(option, source);
    if (at == std::string::npos) return standard;
    int value = standard;
    const char* number = source.data() + at + option.size() + 2;
    std::from_chars(number, source.data() + source.size(), value);
    return value;
}

std::string withSceneOption(const std::string& source, const std::string& option, int value,
                            int standard) {
    std::string changed = source;
    if (const std::size_t at = placeOf(option, source); at != std::string::npos)
        changed.erase(at, source.find(':', at + 1) - at);
    return value == standard ? changed : changed + ":" + option + "=" + std::to_string(value);
}

renderer::View parseView(const std::string& word, const std::string& option) {
    return wordOf(viewWords(), word, option);
}

Path parsePath(const std::string& word, const std::string& option) {
    return wordOf(kPathWords, word, option);
}

std::string keyHelp() {
    return "R  automatic or fixed size\n"
           "1..6  fixed size 128, 256, 512, 1024, 2048, 4096\n"
           "V  next view: picture, split, difference, demand, penumbra, texels\n"
           "T  next technique\n"
           "S  next scene\n"
           "P  play: camera round, sun round, still\n"
           "H  hide or show the panel\n"
           "L  load the shaders of --shaders again\n"
           "drag, wheel  turn, zoom; in the split view drag the line\n"
           "Esc  close\n";
}

bool applyKey(char key, ViewerState& state) {
    if (key >= '1' && key <= '6') {
        state.resolution = kSmallestFixed << (key - '1');
        return true;
    }
    switch (key) {
        case 'R':
            state.resolution = state.resolution ? ResolutionOption() : ResolutionOption(2048);
            return true;
        case 'V':
            state.view =
                *next(renderer::kAllViews, [&](renderer::View view) { return view == state.view; });
            return true;
        case 'T':
            state.technique = next(renderer::techniques(), [&](const renderer::Technique& row) {
                                  return row.name == state.technique;
                              })->name;
            return true;
        case 'S':
            state.scene = next(renderer::builtInScenes(), [&](const renderer::SceneEntry& row) {
                              return row.name == state.scene.substr(0, state.scene.find(':'));
                          })->name;
            state.cameraYawDeg = state.cameraPitchDeg = state.cameraDistanceM = {};
            state.sunAzimuthDeg = state.sunElevationDeg = {};
            return true;
        case 'P':
            state.path = state.path == Path::still    ? Path::camera
                         : state.path == Path::camera ? Path::sun
                                                      : Path::still;
            return true;
        case 'H':
            state.panel = !state.panel;
            return true;
        default:
            return false;
    }
}

}  // namespace demo

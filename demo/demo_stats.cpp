// SPDX-License-Identifier: MIT
#include "demo/demo_stats.h"

#include <nlohmann/json.hpp>

#include "records/whole_file.h"

namespace demo {
namespace {

using Json = nlohmann::ordered_json;

Json toJson(const Spread& spread) {
    return {{"median", spread.median},
            {"p25", spread.p25},
            {"p75", spread.p75},
            {"least", spread.least},
            {"frames", spread.count}};
}

Json parametersJson(const DemoStats& stats) {
    Json json = Json::object();
    for (std::size_t i = 0; i < stats.technique->parameters.size(); ++i)
        json[std::string(stats.technique->parameters[i].name)] = stats.parameters[i];
    return json;
}

Json encodingJson(resolution_controller::Encoding encoding) {
    using resolution_controller::Encoding;
    if (encoding == Encoding::unknown) return {};
    return encoding == Encoding::srgb ? "srgb" : "code";
}

Json slopeJson(const DemoStats& stats) {
    namespace rc = resolution_controller;
    const rc::Slope& slope = stats.slope.slope;
    return {{"c", slope.c},
            {"criterion", slope.criterion},
            {"task", slope.task == rc::Task::twoAfc ? "2afc" : "yes_no"},
            {"encoding", encodingJson(slope.encoding)},
            {"beta", slope.beta},
            {"text", stats.slope.text},
            {"file", stats.slope.file.empty() ? Json() : Json(stats.slope.file)},
            {"notes", stats.slope.notes}};
}

Json automaticJson(const ChosenResolution& chosen) {
    return {{"need", chosen.need},
            {"min_radius_uv", chosen.minRadiusUv},
            {"share_above", chosen.shareAbove},
            {"artifact_ratio", chosen.artifactRatio},
            {"detail_texels", chosen.detailTexels}};
}

Json mapsJson(const DemoStats& stats) {
    Json json = Json::array();
    for (std::size_t map = 0; map < stats.maps.size(); ++map) {
        const ChosenResolution& chosen = stats.maps[map];
        Json own = {{"map", stats.mapNames.at(map)},
                    {"resolution", chosen.resolution},
                    {"reason", chosen.reason}};
        if (chosen.automatic) own.update(automaticJson(chosen));
        json.push_back(own);
    }
    return json;
}

Json budgetJson(const std::optional<SharedBudget>& budget) {
    if (!budget) return {};
    return {{"texels", budget->texels},
            {"wanted_texels", budget->wanted},
            {"used_texels", budget->used},
            {"feasible", budget->feasible}};
}

Json passesJson(const DemoStats& stats) {
    Json json = Json::object();
    for (const renderer::Pass pass : renderer::kAllPasses) {
        const Spread& spread = stats.passesMs.passes[static_cast<std::size_t>(pass)];
        if (spread.count > 0) json[std::string(toText(pass))] = toJson(spread);
    }
    return json;
}

}  // namespace

void writeStats(const std::filesystem::path& file, const DemoStats& stats) {
    Json json;
    json["schema"] = "stairwell-demo-stats 1.1";
    json["context"] = stats.context;
    json["scene"] = stats.scene;
    json["technique"] = std::string(stats.technique->name);
    json["parameters"] = parametersJson(stats);
    json["radius_m"] = stats.softness.radiusM;
    json["radius_uv"] = stats.softness.radiusUv;
    json["map_extent_m"] = stats.mapExtentM;
    json["resolution"] = stats.chosen.resolution;
    json["resolution_mode"] = stats.chosen.automatic ? "auto" : "fixed";
    json["reason"] = stats.chosen.reason;
    if (stats.chosen.automatic) {
        json.update(automaticJson(stats.chosen));
        json["settling_frames"] = stats.settlingFrames;
    }
    json["maps"] = mapsJson(stats);
    json["budget"] = budgetJson(stats.budget);
    json["slope"] = slopeJson(stats);
    json["timing"] = stats.timing;
    json["frame_ms"] = toJson(stats.wholeFrameMs);
    json["passes_ms"] = passesJson(stats);
    json["map_bytes"] = stats.mapBytes;
    json["target_bytes"] = stats.targetBytes;
    json["triangles"] = stats.triangles;
    records::writeWholeFile(file, json.dump(2) + "\n");
}

}  // namespace demo

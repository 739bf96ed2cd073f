// SPDX-License-Identifier: MIT
#include "study_app/display_file.h"

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "records/json_document.h"
#include "records/json_fields.h"

namespace study_app {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr const char* kSchemaName = "stairwell displays";
constexpr int kMajor = 1, kMinor = 1;  // since 1.1: luminance of black and grey

bool sameDisplay(const DisplayProfile& a, const DisplayProfile& b) {
    return a.name == b.name && a.widthPx == b.widthPx && a.heightPx == b.heightPx;
}

ordered_json orNull(const std::optional<double>& value) {
    return value ? ordered_json(*value) : ordered_json(nullptr);
}

ordered_json toJson(const DisplayProfile& p) {
    ordered_json json = {{"name", p.name},
                         {"width_px", p.widthPx},
                         {"height_px", p.heightPx},
                         {"px_per_mm", orNull(p.pxPerMm)},
                         {"distance_mm", orNull(p.distanceMm)},
                         {"gamma", orNull(p.gamma)}};
    records::addLuminance(json, p.luminance);
    return json;
}

DisplayProfile profileFrom(const records::JsonFields& fields) {
    DisplayProfile p{.name = fields.text("name"),
                     .widthPx = fields.integer("width_px", 1),
                     .heightPx = fields.integer("height_px", 1),
                     .pxPerMm = fields.optionalNumber("px_per_mm", records::kPositive),
                     .distanceMm = fields.optionalNumber("distance_mm", records::kPositive),
                     .gamma = fields.optionalNumber("gamma", records::kPositive),
                     .luminance = records::luminanceFrom(fields)};
    if (const std::string problem = validate(p); !problem.empty()) {
        throw std::runtime_error(fields.where("name") + ": " + p.name + ": " + problem);
    }
    return p;
}

}  // namespace

fs::path displayFile() {
    const auto variable = [](const char* name) -> fs::path {
        const char* value = std::getenv(name);
        return value == nullptr ? "" : value;
    };
    if (const fs::path file = variable("STAIRWELL_DISPLAYS"); !file.empty()) return file;
    fs::path folder = variable("XDG_CONFIG_HOME");
    if (folder.empty() && !variable("HOME").empty()) folder = variable("HOME") / ".config";
    return folder.empty() ? "displays.json" : folder / "stairwell" / "displays.json";
}

std::vector<DisplayProfile> readDisplays(const fs::path& file) {
    if (!fs::exists(file)) return {};
    const nlohmann::json json = records::readJson(file);
    const records::JsonFields fields(json, file.string());
    records::checkSchema(fields, kSchemaName, kMajor);
    std::vector<DisplayProfile> displays;
    for (const auto& one : fields.objects("displays")) displays.push_back(profileFrom(one));
    return displays;
}

std::optional<DisplayProfile> findDisplay(const std::vector<DisplayProfile>& displays,
                                          const DisplayProfile& monitor) {
    const auto found = std::ranges::find_if(
        displays, [&](const DisplayProfile& p) { return sameDisplay(p, monitor); });
    return found == displays.end() ? std::nullopt : std::optional(*found);
}

void storeDisplay(const fs::path& file, const DisplayProfile& profile) {
    if (const std::string problem = validate(profile); !problem.empty()) {
        throw std::invalid_argument("display " + profile.name + ": " + problem);
    }
    std::vector<DisplayProfile> displays = readDisplays(file);
    std::erase_if(displays, [&](const DisplayProfile& p) { return sameDisplay(p, profile); });
    displays.push_back(profile);
    ordered_json list = ordered_json::array();
    for (const DisplayProfile& p : displays) list.push_back(toJson(p));
    records::writeJson(file, {{"schema", records::schemaJson(kSchemaName, kMajor, kMinor)},
                              {"displays", std::move(list)}});
}

}  // namespace study_app

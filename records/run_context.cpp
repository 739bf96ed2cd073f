// SPDX-License-Identifier: MIT
#include "records/run_context.h"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <ctime>
#include <nlohmann/json.hpp>
#include <string_view>

#include "program/build_info.h"
#include "records/json_fields.h"

namespace records {

namespace {

std::string utcNow() {
    const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    std::tm utc{};
    ::gmtime_r(&now, &utc);
    char text[sizeof "2026-01-31T12:00:00Z"];
    return {text, std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc)};
}

// So that the command can be given again as it stands.
std::string quotedForShell(const std::string& word) {
    constexpr std::string_view kPlain = "%+,-./:=@_";
    const bool plain = std::all_of(word.begin(), word.end(), [&](unsigned char c) {
        return std::isalnum(c) || kPlain.find(static_cast<char>(c)) != std::string_view::npos;
    });
    if (plain && !word.empty()) return word;
    std::string quoted = "'";
    for (const char c : word) {
        if (c == '\'') quoted += "'\\'";  // close, an escaped quote, open again
        quoted += c;
    }
    return quoted + "'";
}

template <typename Json>
void write(Json& json, const RunContext& context) {
    json = Json{{"program", context.program},   {"version", context.version},
                {"revision", context.revision}, {"build_type", context.buildType},
                {"compiler", context.compiler}, {"date", context.date},
                {"command", context.command}};
    const auto add = [&](const char* key, const auto& value) {
        if (value) json[key] = *value;
    };
    add("seed", context.seed);
    add("gl_renderer", context.glRenderer);
    add("gl_version", context.glVersion);
    add("software_rasteriser", context.softwareRasteriser);
    add("viewport_width_px", context.viewportWidthPx);
    add("viewport_height_px", context.viewportHeightPx);
}

}  // namespace

RunContext currentRunContext(const std::string& programName, std::vector<std::string> command) {
    const program::BuildInfo& build = program::buildInfo();
    return {.program = programName,
            .version = build.version,
            .revision = build.revision,
            .buildType = build.buildType,
            .compiler = build.compiler,
            .date = utcNow(),
            .command = std::move(command),
            .seed = {},
            .glRenderer = {},
            .glVersion = {},
            .softwareRasteriser = {},
            .viewportWidthPx = {},
            .viewportHeightPx = {}};
}

void to_json(nlohmann::json& json, const RunContext& context) {
    write(json, context);
}
void to_json(nlohmann::ordered_json& json, const RunContext& context) {
    write(json, context);
}

RunContext runContextFromJson(const nlohmann::json& json, const std::string& file,
                              const std::string& path) {
    const JsonFields fields(json, file, path);
    return {.program = fields.text("program"),
            .version = fields.text("version"),
            .revision = fields.text("revision"),
            .buildType = fields.text("build_type"),
            .compiler = fields.text("compiler"),
            .date = fields.text("date"),
            .command = fields.texts("command"),
            .seed = fields.optionalUnsignedInteger("seed"),
            .glRenderer = fields.optionalText("gl_renderer"),
            .glVersion = fields.optionalText("gl_version"),
            .softwareRasteriser = fields.optionalBoolean("software_rasteriser"),
            .viewportWidthPx = fields.optionalInteger("viewport_width_px", 1),
            .viewportHeightPx = fields.optionalInteger("viewport_height_px", 1)};
}

std::string contextText(const RunContext& context) {
    std::string text;
    const auto add = [&](const std::string& label, const std::string& value) {
        text += label + std::string(label.size() < 10 ? 10 - label.size() : 1, ' ') + value + "\n";
    };
    add("program", context.program + " " + context.version);
    add("revision", context.revision);
    add("build", context.buildType + ", " + context.compiler);
    add("date", context.date);
    std::string command;
    for (const std::string& word : context.command) {
        if (!command.empty()) command += ' ';
        command += quotedForShell(word);
    }
    add("command", command);
    if (context.seed) add("seed", std::to_string(*context.seed));
    if (context.glRenderer) add("GL", *context.glRenderer);
    if (context.glVersion) add("driver", *context.glVersion);
    if (context.softwareRasteriser)
        add("timing", *context.softwareRasteriser ? "software rasteriser: finish and clock"
                                                  : "GPU timer queries");
    if (context.viewportWidthPx && context.viewportHeightPx)
        add("viewport", std::to_string(*context.viewportWidthPx) + " x " +
                            std::to_string(*context.viewportHeightPx) + " px");
    return text;
}

}  // namespace records

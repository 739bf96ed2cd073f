// SPDX-License-Identifier: MIT
// The context block with which every output file starts: who wrote it, when, from which command and
// revision.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace records {

struct RunContext {
    std::string program;                // "fit_slope"
    std::string version;                // "0.1.0"
    std::string revision;               // git commit, "-dirty" when the tree had changes
    std::string buildType;              // "Release"
    std::string compiler;               // "GNU 12.2.0"
    std::string date;                   // UTC, ISO 8601, "2026-01-31T12:00:00Z"
    std::vector<std::string> command;   // argv as given
    std::optional<std::uint64_t> seed;  // where the run drew random numbers
    // Where the run rendered:
    std::optional<std::string> glRenderer;   // GL_RENDERER
    std::optional<std::string> glVersion;    // GL_VERSION (names the driver)
    std::optional<bool> softwareRasteriser;  // timings by finish-and-clock instead of timer queries
    std::optional<int> viewportWidthPx;
    std::optional<int> viewportHeightPx;

    bool operator==(const RunContext&) const = default;
};

/// Fills program, version, revision, build, compiler, date and command for a run that starts now.
RunContext currentRunContext(const std::string& programName, std::vector<std::string> command);

void to_json(nlohmann::json& json, const RunContext& context);
void to_json(nlohmann::ordered_json& json, const RunContext& context);
/// Throws std::runtime_error naming file, field, the value found and the rule. `path` is where in
/// the file the context stands.
RunContext runContextFromJson(const nlohmann::json& json, const std::string& file,
                              const std::string& path = "context");

/// The context as lines "program   fit_slope 0.1.0" for the foot of a report.
std::string contextText(const RunContext& context);

}  // namespace records

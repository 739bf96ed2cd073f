// SPDX-License-Identifier: MIT
// The list of rendered frame pairs in a folder, manifest.json: each pair is one view with a
// converged shadow map and with a map of texel size a, at the same blur radius r. shadow_demo
// --write-frames writes such folders; designs with `frames` show them. docs/frames.schema.json is
// the published schema.
//
// Pairs of one scene and one radius belong together: a staircase moves among their r / a.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "records/run_context.h"

namespace records {

inline constexpr int kFramesMajor = 1;
inline constexpr const char* kManifestName = "manifest.json";

struct FramePair {
    std::string artifact, converged;      ///< file names in the folder: PNG, square, 8-bit grey
    double artifactPx = 0, radiusPx = 0;  ///< a and r as seen, screen px; only r / a is exact where
                                          ///< the view is in perspective
    std::string scene, technique;         ///< one line each
    bool operator==(const FramePair&) const = default;
};

struct FrameManifest {
    std::optional<RunContext> context;  ///< of the program that rendered
    std::vector<FramePair> pairs;       ///< at least one, no frame with an artifact twice
    bool operator==(const FrameManifest&) const = default;
};

/// Reads <folder>/manifest.json. Throws std::runtime_error with file, field, value and rule. The
/// pictures are not looked at.
FrameManifest readFrameManifest(const std::filesystem::path& folder);
/// Written whole or not at all. Throws std::invalid_argument for what the reader would refuse.
void writeFrameManifest(const std::filesystem::path& folder, const FrameManifest& manifest);

/// The list alone, for files that hold one: an array of pairs at `key` of an object.
std::vector<FramePair> framePairsFromJson(const nlohmann::json& object, const std::string& file,
                                          const std::string& path, const std::string& key);
nlohmann::ordered_json toJson(const std::vector<FramePair>& pairs);

}  // namespace records

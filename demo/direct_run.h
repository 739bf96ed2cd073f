// SPDX-License-Identifier: MIT
// What confirms the comparison of policies from a table (policy_comparison.h): every policy draws
// the frames of the paths itself, with the parameter that the table gave it, and its sizes, times
// and errors are measured again. Beside them the programs' own automatic size, through the
// controller, with the slope as it was loaded.
//
// The journal sweep_direct.tsv holds one line for each frame, technique and policy; a killed run
// goes on with it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "demo/policy_comparison.h"
#include "demo/sweep.h"
#include "demo/sweep_table.h"

namespace demo {

inline const std::vector<std::string> kDirectColumns = {
    "scene",     "frame",    "technique", "policy",     "parameter",    "resolution",
    "reference", "frame_ms", "rmse",      "ripple_p95", "ripple_counts"};

/// The name in the journal of what `--resolution auto` does.
inline constexpr std::string_view kControllerRun = "auto";

/// What the journal does not hold yet of the calibrated policies of the sweep in
/// `settings.folder`. Also writes for the first frame of each scene's path a picture of what
/// `auto` is off by, pictures/SCENE_TECHNIQUE_error.png, and SCENE.png for what it looks like.
void runDirect(const renderer::GlInfo& info, const SweepSettings& settings,
               const records::RunContext& context);

/// Full colour in these pictures.
inline constexpr double kFullErrorInPictures = 0.1;
std::filesystem::path errorPicture(const std::filesystem::path& folder, const std::string& scene,
                                   const std::string& technique);
std::filesystem::path litPicture(const std::filesystem::path& folder, const std::string& scene);

struct DirectRow {
    std::string scene, technique, policy, parameter;
    int frame = 0, resolution = 0, reference = 0;
    double frameMs = 0, rmse = 0, rippleP95 = 0;
    RippleCounts ripples;
};
/// Empty where the folder has no journal of them.
std::vector<DirectRow> readDirect(const std::filesystem::path& folder);

/// A policy over all frames, as measured directly; absent where a frame was not, or with another
/// parameter.
struct DirectResult {
    double geometricMeanMs = 0;  ///< over the scenes, as in PolicyResult
    double rippleP95 = 0;        ///< over what the comparison takes it
    double worstRmse = 0;
};
std::optional<DirectResult> directResult(const std::vector<DirectRow>& rows,
                                         const SweepTable& table, const PolicyResult& fromTable,
                                         RippleOver over);

}  // namespace demo

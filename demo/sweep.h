// SPDX-License-Identifier: MIT
// The measured table behind the report: every frame of every scene's path x softness x technique x
// map size, what it costs and how wrong it is, and what each sizing policy would have taken there.
// Policies are compared from this table (policy_comparison.h), so that all of them see the same
// measurements, and confirmed by drawing what they take (direct_run.h).
//
// Three journals in the folder, which a killed sweep goes on with: sweep_times.tsv (one line per
// visit of a cell), sweep_errors.tsv (one per cell), sweep_policies.tsv (one per frame and policy).
// Shards write journals of their own, "sweep_times.2of8.tsv"; sweep_table.h reads whatever lies in
// the folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "demo/loaded_slope.h"
#include "demo/swept_technique.h"
#include "records/run_context.h"
#include "renderer/gl_context.h"

namespace demo {

struct Shard {
    int index = 1, count = 1;  ///< 1 <= index <= count
};
/// "2/8". Throws std::invalid_argument that names `option`.
Shard parseShard(const std::string& text, const std::string& option);

struct SweepSettings {
    std::vector<std::string> scenes;     ///< as openScene() takes them
    std::vector<double> softness = {1};  ///< times each scene's own; each is a scene of its own
    std::vector<SweptTechnique> techniques;
    std::vector<int> sizes;  ///< levels, ascending; the largest that can be had is the reference
    int frames = 2;          ///< of each scene's path, >= 1
    int rounds = 3;          ///< timed visits of each cell, >= 1
    int widthPx = 640, heightPx = 360;
    double mostFrameMs = 4000;     ///< cells that are predicted to be slower are skipped, and named
    bool confirmsPolicies = true;  ///< draws calibrated policies' frames again (direct_run.h)
    Shard shard;
    LoadedSlope slope;
    std::filesystem::path folder;

    /// Throws std::invalid_argument that names the field, its value and its range.
    void validate() const;
    /// What has to be the same for a sweep to go on.
    std::string plan() const;
};

inline const std::vector<std::string> kSweepTimeColumns = {
    "scene",    "frame",        "technique",  "resolution", "round",  "status",   "frame_ms",
    "depth_ms", "prefilter_ms", "prepass_ms", "lookup_ms",  "lit_ms", "map_bytes"};
inline const std::vector<std::string> kSweepErrorColumns = {"scene",
                                                            "frame",
                                                            "technique",
                                                            "resolution",
                                                            "reference",
                                                            "radius_uv",
                                                            "penumbra_px",
                                                            "rmse",
                                                            "max",
                                                            "p95",
                                                            "bias",
                                                            "share_beyond_level",
                                                            "share_beyond_2_percent",
                                                            "share_beyond_5_percent",
                                                            "ssim",
                                                            "contour_px",
                                                            "ripple_p95",
                                                            "ripple_max",
                                                            "edge_width_px",
                                                            "reference_width_px",
                                                            "edge_width_ratio",
                                                            "thin_px",
                                                            "thin_rmse",
                                                            "thin_lost",
                                                            "flicker_light",
                                                            "flicker_orbit",
                                                            "flicker_size",
                                                            "ripple_counts"};
inline const std::vector<std::string> kSweepPolicyColumns = {"scene", "frame", "technique",
                                                             "policy", "sizes"};

/// A policy's parameter is tried at `standard` x 2^(step / 8), step = -kPolicySteps ..
/// kPolicySteps: finer than the sizes' sqrt 2, since not all scenes change theirs at once.
inline constexpr int kPolicySteps = 40;
double policyParameter(double standard, int step);

/// Measures what the journals do not hold yet. `context` goes into their heads. Throws
/// std::runtime_error where the folder holds a sweep of another plan.
void runSweep(const renderer::GlInfo& info, const SweepSettings& settings,
              const records::RunContext& context);

}  // namespace demo

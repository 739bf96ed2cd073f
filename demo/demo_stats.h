// SPDX-License-Identifier: MIT
// What `shadow_demo --stats` writes: the context block, what was rendered, which N was chosen for
// each map and why, and what it took.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "demo/loaded_slope.h"
#include "demo/shadow_run.h"
#include "records/run_context.h"

namespace demo {

struct DemoStats {
    records::RunContext context;
    std::string scene;
    const renderer::Technique* technique = nullptr;
    renderer::ParameterValues parameters{};
    Softness softness;
    ChosenResolution chosen;  ///< of the sun's map, or its first cascade's
    std::vector<ChosenResolution> maps;
    std::vector<std::string> mapNames;  ///< one for each of them
    std::optional<SharedBudget> budget;
    int settlingFrames = 0;
    LoadedSlope slope;
    double mapExtentM = 0;
    std::string timing;  ///< "timer queries", "finish and steady clock"
    Spread wholeFrameMs;
    ShadowRun::PassSpreads passesMs;
    std::size_t mapBytes = 0;
    std::size_t targetBytes = 0;
    std::size_t triangles = 0;
};

/// Whole or not at all; throws std::runtime_error naming file and reason.
void writeStats(const std::filesystem::path& file, const DemoStats& stats);

}  // namespace demo

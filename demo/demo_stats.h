// SPDX-License-Identifier: MIT
// What `shadow_demo --stats` writes: the context block, what was rendered, which N was chosen and
// why, and what it took.
#pragma once

#include <filesystem>
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
    ChosenResolution chosen;
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

// SPDX-License-Identifier: MIT
// The measurement behind shadow_bench: every scene and technique at every size, at the same
// softness, interleaved, so that whatever else the machine does falls on all of them; and the
// resolution error of each against the largest fixed map among them.
#pragma once

#include <string>
#include <vector>

#include "demo/error_metrics.h"
#include "demo/loaded_slope.h"
#include "demo/picture.h"
#include "demo/shadow_run.h"

namespace demo {

struct BenchmarkSettings {
    std::vector<std::string> scenes;      ///< names; empty: every built-in scene
    std::vector<std::string> techniques;  ///< names; empty: every technique with a kernel
    std::vector<ResolutionOption> resolutions;
    int widthPx = 640, heightPx = 360;
    int rounds = 5;                 ///< timed visits of each cell, >= 1
    double mostSecondsPerCell = 8;  ///< after three rounds, slower cells are visited no more
    LoadedSlope slope;
};

/// One scene x technique x size.
struct BenchmarkCell {
    const renderer::Technique* technique = nullptr;
    std::string scene;
    Softness softness;
    ChosenResolution chosen;
    Spread frameMs;                   ///< whole frames, nothing waits inside them
    ShadowRun::PassSpreads passesMs;  ///< from frames of their own
    std::size_t mapBytes = 0;
    bool isReference = false;  ///< the largest fixed map: its error is 0 by definition
    VisibilityError error;
    renderer::ByteImage picture;  ///< antialiased
    renderer::FloatImage visibility;
};

/// All cells of one scene and technique.
struct BenchmarkGroup {
    std::string scene;
    const renderer::Technique* technique = nullptr;
    Softness softness;
    double mapExtentM = 0;
    std::size_t triangles = 0;
    std::vector<BenchmarkCell> cells;  ///< in the order of the sizes asked for
    Part detail;                       ///< where the smallest map is furthest from the reference

    const BenchmarkCell& reference() const;
    const BenchmarkCell* automatic() const;  ///< null where it was not asked for
};

struct BenchmarkResult {
    std::vector<BenchmarkGroup> groups;
    std::string timing;  ///< how passes were timed
};

/// Throws std::invalid_argument for names that are not known and where no fixed size is asked for.
BenchmarkResult runBenchmark(const renderer::GlInfo& info, const BenchmarkSettings& settings);

/// One for each technique that was measured at automatic size: "8.5x the speed", "of the fixed 4096
/// map, ...". Speeds are geometric means over the scenes.
struct Headline {
    std::string number;
    std::string meaning;
};
std::vector<Headline> headlines(const BenchmarkResult& result);

}  // namespace demo

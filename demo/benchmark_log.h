// SPDX-License-Identifier: MIT
// The benchmark's numbers as a tab-separated table: lines that begin with # hold the context, then
// a header, then one row per cell. `n/a` stands for what was not measured.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "demo/benchmark.h"
#include "demo/loaded_slope.h"
#include "records/run_context.h"

namespace demo {

std::string benchmarkLog(const BenchmarkResult& result, const records::RunContext& context,
                         const LoadedSlope& slope);

}  // namespace demo

// SPDX-License-Identifier: MIT
// The benchmark's report: one self-contained page with the headline first, then the figure, the
// table, pictures with enlarged details, the slope that chose the sizes, and how everything was
// measured.
#pragma once

#include <filesystem>
#include <optional>

#include "demo/benchmark.h"
#include "demo/loaded_slope.h"
#include "records/run_context.h"

namespace demo {

/// Writes report.html, benchmark.tsv, frame_time.svg and the pictures into `folder`; returns the
/// report's path. `fitFolder` is a folder of fit_slope: its slope and its figures go into the
/// report. Throws std::runtime_error where something cannot be read or written.
std::filesystem::path writeReport(const std::filesystem::path& folder,
                                  const BenchmarkResult& result, const records::RunContext& context,
                                  const LoadedSlope& slope,
                                  const std::optional<std::filesystem::path>& fitFolder);

}  // namespace demo

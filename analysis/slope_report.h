// SPDX-License-Identifier: MIT
// Everything that fit_slope leaves in its folder: slope.json, report.html, figures/ (SVG and PDF,
// with the gnuplot script that draws each), the tables as TSV, and data.sha256, the checksums of
// the trial tables.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "analysis/reference_sizes.h"
#include "analysis/slope_analysis.h"
#include "records/slope_file.h"

namespace analysis {

/// slope.json is written last: where it is new, everything beside it is. Throws std::runtime_error,
/// located: a file cannot be written, gnuplot is missing or fails.
void writeReport(const std::filesystem::path& folder, const SlopeAnalysis& analysis,
                 const records::Slope& slope, const ReferenceSizes& reference,
                 StageTimes* times = nullptr);

}  // namespace analysis

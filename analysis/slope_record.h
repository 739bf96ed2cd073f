// SPDX-License-Identifier: MIT
// An analysis as a slope file.
#pragma once

#include "analysis/slope_analysis.h"
#include "records/slope_file.h"

namespace analysis {

/// slope.json.
records::Slope slopeRecord(const SlopeAnalysis& analysis, const records::RunContext& context);

}  // namespace analysis

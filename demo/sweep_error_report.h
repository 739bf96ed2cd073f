// SPDX-License-Identifier: MIT
// What a sweep's report says of errors: against speed, against r/a, number by number, from frame to
// frame, in pictures, and, told apart, those of the techniques themselves.
#pragma once

#include <filesystem>

#include "demo/report_tables.h"
#include "demo/sweep_table.h"

namespace demo {

/// What the automatic size is off by, in the first frame of each path; of direct_run.h's pictures.
void addPictures(records::HtmlPage& page, const SweepTable& table,
                 const std::filesystem::path& folder);
void addFronts(records::HtmlPage& page, ReportTables& tables, const SweepTable& table);
void addRipples(records::HtmlPage& page, const SweepTable& table);
void addErrors(records::HtmlPage& page, ReportTables& tables, const SweepTable& table);
void addTemporalErrors(records::HtmlPage& page, ReportTables& tables, const SweepTable& table);
/// Of model_error.h, where the folder has them, or how they are had.
void addModelErrors(records::HtmlPage& page, const std::filesystem::path& folder);

}  // namespace demo

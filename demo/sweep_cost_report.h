// SPDX-License-Identifier: MIT
// What a sweep's report says of time: pass by pass, and how it grows.
#pragma once

#include <filesystem>

#include "demo/report_tables.h"
#include "demo/sweep_table.h"

namespace demo {

void addCosts(records::HtmlPage& page, ReportTables& tables, const SweepTable& table);
void addGrowth(records::HtmlPage& page, ReportTables& tables, const SweepTable& table);
/// Of growth_run.h, where the folder has it.
void addGrowthRun(records::HtmlPage& page, const std::filesystem::path& folder);

}  // namespace demo

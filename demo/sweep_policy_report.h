// SPDX-License-Identifier: MIT
// What a sweep's report says of sizing policies: the headline, one line for each technique, then
// all policies in full, what `--resolution auto` does, and what the slope c buys.
#pragma once

#include <string>
#include <vector>

#include "demo/direct_run.h"
#include "demo/policy_comparison.h"
#include "demo/report_tables.h"
#include "demo/sweep_table.h"

namespace demo {

/// One number for all techniques: the automatic size against the two largest fixed powers of two,
/// or, where the automatic size was not drawn, against the best fixed size at equal ripple.
struct SweepHeadline {
    std::string number, meaning;  ///< empty where nothing was measured that gives one
};
SweepHeadline sweepHeadline(const std::vector<DirectRow>& direct,
                            const std::vector<PolicyComparison>& comparisons,
                            const SweepTable& table);

/// One row for each technique: ours over the best of the others, of fixed sizes, of engines' rules,
/// of the published rule, where we lose too.
NamedTable techniqueTable(const std::vector<PolicyComparison>& comparisons);
/// Time at the fixed size over that at the automatic one, by technique and scene.
NamedTable automaticTable(const std::vector<DirectRow>& direct, const SweepTable& table);
/// The automatic size with other c.
NamedTable slopeTable(const SweepTable& table);

void addTechniques(records::HtmlPage& page, ReportTables& tables,
                   const std::vector<PolicyComparison>& comparisons);
void addPolicies(records::HtmlPage& page, ReportTables& tables,
                 const std::vector<PolicyComparison>& comparisons, const SweepTable& table,
                 const std::vector<DirectRow>& direct);
void addAutomatic(records::HtmlPage& page, ReportTables& tables,
                  const std::vector<DirectRow>& direct, const SweepTable& table);
void addSlopes(records::HtmlPage& page, ReportTables& tables, const SweepTable& table);

}  // namespace demo

// SPDX-License-Identifier: MIT
#include "demo/sweep_policy_report.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

#include "demo/automatic_against_fixed.h"
#include "demo/policy_summary.h"

namespace demo {
namespace {

std::string sizesTaken(int smallest, int largest) {
    if (largest == 0) return "n/a";
    const std::string first = std::to_string(smallest);
    return smallest == largest ? first : first + " to " + std::to_string(largest);
}

/// Why there is no result, or how the one from the table was confirmed.
std::string standing(const PolicyComparison::Entry& entry,
                     const std::optional<DirectResult>& direct) {
    if (entry.result) return direct ? "direct" : "table";
    if (!entry.nearest) return "unmeasured";
    return "nearest";
}

void addPolicyTable(ReportTables& tables, const std::string& name,
                    const std::vector<PolicyComparison>& comparisons, const SweepTable& table,
                    const std::vector<DirectRow>& directRows, const std::string& caption) {
    TableRows rows;
    for (const PolicyComparison& comparison : comparisons)
        for (const auto& entry : comparison.entries) {
            const std::optional<PolicyResult>& result = entry.result ? entry.result : entry.nearest;
            const std::optional<DirectResult> direct =
                entry.result ? directResult(directRows, table, *entry.result, comparison.over)
                             : std::nullopt;
            std::vector<std::string> row = {comparison.technique, std::string(entry.policy->name)};
            const auto number = [&](const char* format, double value) {
                row.push_back(formatted(format, value));
            };
            number("%.3f", entry.timesOurs);
            row.push_back(result ? sizesTaken(result->smallest, result->largest) : "n/a");
            number("%.3f", result ? result->ripple(comparison.over) : NAN);
            number("%.4f", result ? result->worstRmse : NAN);
            number("%.2f", result ? result->geometricMeanMs : NAN);
            number("%.4g", result ? result->parameter : NAN);
            row.push_back(standing(entry, direct));
            number("%.3f", direct ? direct->rippleP95 : NAN);
            number("%.2f", direct ? direct->geometricMeanMs : NAN);
            number("%.3f", comparison.bound);
            for (std::size_t i = 0; i < table.scenes.size(); ++i)
                number("%.2f", entry.result && comparison.ours
                                   ? entry.result->sceneMs[i] / comparison.ours->sceneMs[i]
                                   : NAN);
            rows.push_back(std::move(row));
        }
    std::vector<std::string> head = {"technique",  "policy",        "time / ours", "sizes taken",
                                     "ripple p95", "worst RMSE",    "ms",          "parameter",
                                     "standing",   "direct ripple", "direct ms",   "bound"};
    for (const std::string& scene : table.scenes) head.push_back(scene);
    tables.add({.name = name, .caption = caption, .head = head, .rows = rows});
}

/// The two largest powers of two among the sweep's sizes, which are what engines fix; ascending.
std::vector<int> fixedSizes(const SweepTable& table) {
    std::vector<int> sizes;
    for (const int size : table.sizes)
        if (std::has_single_bit(static_cast<unsigned>(size))) sizes.push_back(size);
    if (sizes.size() > 2) sizes.erase(sizes.begin(), sizes.end() - 2);
    return sizes;
}

/// The automatic size over the fixed ones, over all techniques that have both everywhere.
struct OverFixed {
    std::vector<int> sizes;
    std::vector<double> ratios;  ///< one for each size
    std::vector<std::string> techniques, leftOut;
    double worstRmse = 0;
    int finerFrames = 0;
};

OverFixed overFixedSizes(const std::vector<DirectRow>& direct, const SweepTable& table) {
    OverFixed over{.sizes = fixedSizes(table), .ratios = {}, .techniques = {}, .leftOut = {}};
    const std::vector<AutomaticAgainstFixed> all = automaticAgainstFixed(direct, table, over.sizes);
    const auto isOf = [](const std::string& technique) {
        return [&technique](const auto& one) { return one.technique == technique; };
    };
    const auto isWhole = [](const auto& one) { return std::isfinite(one.geometricMean); };
    std::vector<std::vector<double>> bySize(over.sizes.size());
    for (const std::string& technique : table.techniques) {
        // One after the other, a size each.
        const auto first = std::find_if(all.begin(), all.end(), isOf(technique));
        const auto last = std::find_if_not(first, all.end(), isOf(technique));
        if (first == last || !std::all_of(first, last, isWhole)) {
            over.leftOut.push_back(technique);
            continue;
        }
        over.techniques.push_back(technique);
        for (auto one = first; one != last; ++one) {
            bySize[static_cast<std::size_t>(one - first)].push_back(one->geometricMean);
            over.worstRmse = std::max(over.worstRmse, one->worstRmse);
            if (one == first) over.finerFrames += one->finerFrames;
        }
    }
    for (const auto& ratios : bySize) over.ratios.push_back(geometricMeanOf(ratios));
    return over;
}

std::string listed(const std::vector<std::string>& names) {
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i)
        text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
    return text;
}

}  // namespace

SweepHeadline sweepHeadline(const std::vector<DirectRow>& direct,
                            const std::vector<PolicyComparison>& comparisons,
                            const SweepTable& table) {
    const std::string scenes = std::to_string(table.scenes.size()) + " scenes";
    const OverFixed over = overFixedSizes(direct, table);
    if (!over.techniques.empty()) {
        SweepHeadline headline;
        std::string fixed;
        for (std::size_t i = over.sizes.size(); i-- > 0;) {
            const char* const joint = fixed.empty() ? "" : " and ";
            headline.number += joint + formatted("%.1fx", over.ratios[i]);
            fixed += joint + std::to_string(over.sizes[i]);
        }
        headline.number += " the speed";
        headline.meaning = "of a fixed map of " + fixed +
                           " at the automatic size, all of the same softness: whole frames, "
                           "geometric mean over " +
                           scenes + " and " + listed(over.techniques) +
                           "; resolution error of the automatic size at most " +
                           formatted("%.3f", over.worstRmse) + " RMSE in a frame.";
        if (over.finerFrames > 0)
            headline.meaning += " " + std::to_string(over.finerFrames) +
                                " frames took maps finer than the reference, which says nothing "
                                "of their errors.";
        if (!over.leftOut.empty())
            headline.meaning +=
                " Without " + listed(over.leftOut) + ", which were not measured in every scene.";
        return headline;
    }
    std::vector<double> ratios;
    std::vector<std::string> techniques;
    for (const PolicySummary& one : summarised(comparisons))
        if (std::isfinite(one.overFixed)) {
            ratios.push_back(one.overFixed);
            techniques.push_back(one.technique);
        }
    if (ratios.empty()) return {};
    return {formatted("%.2fx", geometricMeanOf(ratios)) + " the speed",
            "of the best fixed size at the automatic one, at equal stair-steps: whole frames, "
            "geometric mean over " +
                scenes + " and " + listed(techniques) +
                ". What --resolution auto does was not drawn (--direct)."};
}

NamedTable techniqueTable(const std::vector<PolicyComparison>& comparisons) {
    NamedTable table{
        .name = "techniques",
        .caption =
            "Time with other ways over that with the automatic size, each with the parameter that "
            "keeps the edge ripple within the bound: above 1 ours is faster, below 1 it loses. "
            "Engines: the fastest of coverage, texels per pixel and distance. Published: the "
            "paper's rule. n/a: no parameter keeps to the bound.",
        .head = {"technique", "best other", "which", "ours is", "best fixed", "engines",
                 "published", "c", "sizes taken", "bound", "ms"},
        .rows = {}};
    std::vector<double> best, fixed, engines, published;
    for (const PolicySummary& one : summarised(comparisons)) {
        table.rows.push_back({one.technique, formatted("%.2f", one.overBest),
                              one.best.empty() ? "none" : one.best, verdict(one.overBest),
                              formatted("%.2f", one.overFixed), formatted("%.2f", one.overEngines),
                              formatted("%.2f", one.overPublished), formatted("%.2f", one.c),
                              sizesTaken(one.smallest, one.largest), formatted("%.3f", one.bound),
                              formatted("%.1f", one.ms)});
        best.push_back(one.overBest);
        fixed.push_back(one.overFixed);
        engines.push_back(one.overEngines);
        published.push_back(one.overPublished);
    }
    table.rows.push_back({"geometric mean", formatted("%.2f", geometricMeanOf(best)), "",
                          verdict(geometricMeanOf(best)), formatted("%.2f", geometricMeanOf(fixed)),
                          formatted("%.2f", geometricMeanOf(engines)),
                          formatted("%.2f", geometricMeanOf(published)), "n/a", "", "n/a", "n/a"});
    return table;
}

void addTechniques(records::HtmlPage& page, ReportTables& tables,
                   const std::vector<PolicyComparison>& comparisons) {
    page.heading("Against other ways of choosing the size");
    tables.add(techniqueTable(comparisons));
    for (const PolicyComparison& comparison : comparisons) {
        if (!comparison.ours)
            page.note(comparison.technique +
                      ": the automatic size has no c of which all sizes were measured.");
        else if (comparison.bound > kRippleBound)
            page.note(
                comparison.technique + ": no c brings the automatic size to an edge ripple of " +
                formatted("%.2f", kRippleBound) + " in every scene; the policies are compared at " +
                formatted("%.3f", comparison.bound) + ", the least that it leaves.");
    }
}

void addPolicies(records::HtmlPage& page, ReportTables& tables,
                 const std::vector<PolicyComparison>& comparisons, const SweepTable& table,
                 const std::vector<DirectRow>& direct) {
    page.heading("Sizing policies at equal quality");
    page.paragraph(
        "Every policy has one parameter, set to the fastest value at which the edge ripple of 95 % "
        "of the contour pixels stays within the bound. Times are whole frames from one measured "
        "table; above 1 a policy is slower than ours, below 1 we lose. Then each policy drew the "
        "frames itself with that parameter: the direct columns.");
    addPolicyTable(tables, "policies", comparisons, table, direct,
                   "The bound holds in every scene's path. One row for each technique and policy. "
                   "Standing: direct, also drawn with that parameter; table, from the table alone; "
                   "nearest, no value of the parameter keeps to the bound, and the one with the "
                   "least ripple stands there without a ratio; unmeasured, not all sizes of any "
                   "value were measured. The last columns are time over ours by scene.");
    addPolicyTable(tables, "policies_together", comparePolicies(table, RippleOver::allTogether),
                   table, direct,
                   "The bound holds over the contour pixels of all scenes together, so that a "
                   "scene with few of them may be over it.");
    std::vector<std::pair<std::string, std::string>> terms;
    for (const SizingPolicy& policy : sizingPolicies())
        terms.emplace_back(policy.name, std::string(policy.title) + ": " +
                                            std::string(policy.source) +
                                            "; parameter: " + std::string(policy.parameter));
    page.terms(terms);
}

NamedTable automaticTable(const std::vector<DirectRow>& direct, const SweepTable& table) {
    NamedTable summary{
        .name = "automatic_against_fixed",
        .caption =
            "Time at a fixed size over that at the automatic one: geometric mean over the "
            "scenes, then by scene; 1 and below: nothing is saved there. Errors are those "
            "of the automatic size over all frames but those that took a map finer than the "
            "reference, counted under finer; ripple max is that of the worst pixel.",
        .head = {"technique", "fixed", "times as fast", "worst RMSE", "ripple p95", "ripple max",
                 "finer"},
        .rows = {}};
    summary.head.insert(summary.head.end(), table.scenes.begin(), table.scenes.end());
    for (const AutomaticAgainstFixed& one :
         automaticAgainstFixed(direct, table, fixedSizes(table))) {
        std::vector<std::string> row = {one.technique,
                                        std::to_string(one.fixed),
                                        formatted("%.2f", one.geometricMean),
                                        formatted("%.4f", one.worstRmse),
                                        formatted("%.3f", one.rippleP95),
                                        formatted("%.3f", one.rippleMost),
                                        std::to_string(one.finerFrames)};
        for (const double times : one.times) row.push_back(formatted("%.2f", times));
        summary.rows.push_back(std::move(row));
    }
    return summary;
}

void addAutomatic(records::HtmlPage& page, ReportTables& tables,
                  const std::vector<DirectRow>& direct, const SweepTable& table) {
    TableRows rows;
    for (const DirectRow& row : direct)
        if (row.policy == kControllerRun)
            rows.push_back({row.scene, std::to_string(row.frame), row.technique, row.parameter,
                            std::to_string(row.resolution), std::to_string(row.reference),
                            formatted("%.2f", row.frameMs), formatted("%.4f", row.rmse),
                            formatted("%.3f", row.rippleP95)});
    page.heading("The automatic size");
    if (rows.empty()) {
        page.paragraph(
            "Not drawn: a sweep without shards does it at its end, --report --direct for others.");
        return;
    }
    tables.add(automaticTable(direct, table));
    tables.add(
        {.name = "automatic",
         .caption = "What --resolution auto takes with the slope as it is, thin casters "
                    "counted, asking included in the time; errors against the sweep's "
                    "reference.",
         .head = {"scene", "frame", "technique", "c", "N", "reference", "ms", "RMSE", "ripple p95"},
         .rows = rows});
}

NamedTable slopeTable(const SweepTable& table) {
    NamedTable slopes{
        .name = "slopes",
        .caption =
            "The automatic size with other slopes, in steps of 2^(1/8); ripple p95 of the "
            "scene in which it is largest.",
        .head = {"technique", "c", "ms", "ripple p95", "worst RMSE", "sizes taken", "missing"},
        .rows = {}};
    for (const std::string& technique : table.techniques)
        for (const SlopeStep& step : sweepOverSlope(table, technique, {1, 2, 3.47, 5, 8})) {
            const PolicyResult& result = step.result;
            slopes.rows.push_back(
                {technique, formatted("%.2f", step.c), formatted("%.2f", result.geometricMeanMs),
                 formatted("%.3f", result.rippleP95), formatted("%.4f", result.worstRmse),
                 sizesTaken(result.smallest, result.largest),
                 result.complete() ? "" : result.missing});
        }
    return slopes;
}

void addSlopes(records::HtmlPage& page, ReportTables& tables, const SweepTable& table) {
    page.heading("What c buys");
    tables.add(slopeTable(table));
}

}  // namespace demo

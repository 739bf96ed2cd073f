// SPDX-License-Identifier: MIT
// fit_slope: from trial tables to the slope c of r = c a.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <future>
#include <stdexcept>
#include <string>
#include <vector>

#include "analysis/findings.h"
#include "analysis/number_text.h"
#include "analysis/reference_sizes.h"
#include "analysis/result_tables.h"
#include "analysis/slope_record.h"
#include "analysis/slope_report.h"
#include "program/run_program.h"
#include "records/run_context.h"
#include "records/whole_file.h"

namespace {

struct Options {
    std::vector<std::string> paths;
    std::string out;
    double criterion = quest::kPaperCriterion;
    bool noScreening = false, timing = false;
};

void print(const analysis::SlopeAnalysis& result, const records::Slope& slope,
           const analysis::ReferenceSizes& reference) {
    for (const std::string& notice : result.notices) {
        std::fprintf(stderr, "%s\n", notice.c_str());
    }
    std::printf("%s\n\n", records::describe(slope).c_str());
    for (const std::string& warning : analysis::warnings(result)) {
        std::printf("WARNING: %s\n", warning.c_str());
    }
    for (const analysis::Finding& finding : analysis::findings(result)) {
        std::printf("%s: %s\n", finding.topic.c_str(), finding.text.c_str());
    }
    for (const analysis::TextTable& table : analysis::reportTables(result, reference)) {
        if (table.name == "screening") continue;  // in the report; its finding is above
        std::printf("\n%s\n%s", table.caption.c_str(), analysis::alignedText(table).c_str());
    }
}

void fit(const Options& options, std::vector<std::string> command) {
    if (!(options.criterion > 0 && options.criterion < 1)) {
        throw std::invalid_argument("--criterion: " + analysis::shortText(options.criterion) +
                                    ": must be a probability between 0 and 1");
    }
    if (options.out.empty()) throw std::invalid_argument("--out: empty: must name a folder");
    analysis::StageTimes times;
    records::RunContext context = records::currentRunContext("fit_slope", std::move(command));
    context.seed = analysis::kBootstrapSeed;
    const std::vector<std::filesystem::path> paths(options.paths.begin(), options.paths.end());
    const analysis::Study study = analysis::loadStudy(paths);
    records::createFolders(options.out);
    times.lap("reading");

    analysis::AnalysisOptions settings;
    settings.criterion = options.criterion;
    settings.screening.apply = !options.noScreening;
    // Needs no fit, and takes half as long: beside it.
    std::future<analysis::ReferenceSizes> referenceSizes =
        std::async(std::launch::async, [&study] { return analysis::referenceSizes(study); });
    const analysis::SlopeAnalysis result = analysis::analyseSlope(study, settings, &times);
    const analysis::ReferenceSizes reference = referenceSizes.get();
    times.lap("waiting for the reference sizes");
    const records::Slope slope = analysis::slopeRecord(result, context);
    analysis::writeReport(options.out, result, slope, reference, &times);
    print(result, slope, reference);
    std::printf("\nreport: %s\n",
                (std::filesystem::path(options.out) / "report.html").string().c_str());
    if (!options.timing) return;
    double total = 0;
    for (const auto& [stage, seconds] : times.seconds()) {
        std::printf("%8.3f s  %s\n", seconds, stage.c_str());
        total += seconds;
    }
    std::printf("%8.3f s  in all, %d trials\n", total, analysis::trialCount(result.study));
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{"Fits the slope c of r = c a: the filter radius that hides artifacts of size a."};
    Options options;
    app.add_option("PATH", options.paths, "Trial tables, or folders of them")->required();
    app.add_option("--out", options.out,
                   "Folder for slope.json, report.html, figures and tables (created)")
        ->required();
    app.add_option("--criterion", options.criterion,
                   "F*: detection probability at r = c a, guesses and lapses taken out (default: "
                   "the published .6465)");
    app.add_flag("--no-screening", options.noScreening,
                 "Fit every observer, whatever the rules say");
    app.add_flag("--timing", options.timing, "Print where the time went");
    std::vector<std::string> command(argv, argv + argc);
    return program::run(app, argc, argv, [&] { fit(options, command); });
}

// SPDX-License-Identifier: MIT
// fit_slope: from trial tables to the slope c of r = c a, and --coverage: what a study of a given
// design would find.
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <future>
#include <stdexcept>
#include <string>
#include <vector>

#include "analysis/coverage.h"
#include "analysis/findings.h"
#include "analysis/number_text.h"
#include "analysis/reference_sizes.h"
#include "analysis/result_tables.h"
#include "analysis/slope_record.h"
#include "analysis/slope_report.h"
#include "program/progress.h"
#include "program/run_program.h"
#include "records/run_context.h"
#include "records/whole_file.h"
#include "study_app/design_file.h"

namespace {

struct Options {
    std::vector<std::string> paths;
    std::string out;
    double criterion = quest::kPaperCriterion;
    std::vector<std::string> by;
    int bootstrap = 0;
    bool noScreening = false, timing = false;
    std::optional<double> falseAlarmRate, catchFailureShare;
    // --coverage:
    std::string design, observer = "simulated";
    int observers = 10, studies = 100, guessing = 0, threads = 0;
    std::optional<int> trials;
    std::uint64_t seed = 1;
};

void requireCriterion(double criterion) {
    if (criterion > 0 && criterion < 1) return;
    throw std::invalid_argument("--criterion: " + analysis::shortText(criterion) +
                                ": must be a probability between 0 and 1");
}

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
    requireCriterion(options.criterion);
    for (const std::string& path : options.paths) {
        if (path.empty()) {
            throw std::invalid_argument("PATH: empty: must name a trial table or a folder of them");
        }
    }
    if (options.out.empty()) throw std::invalid_argument("--out: empty: must name a folder");
    analysis::StageTimes times;
    records::RunContext context = records::currentRunContext("fit_slope", std::move(command));
    context.seed = analysis::kBootstrapSeed;
    const std::vector<std::filesystem::path> paths(options.paths.begin(), options.paths.end());
    const analysis::Study study = analysis::loadStudy(paths, options.by);
    records::createFolders(options.out);
    times.lap("reading");

    analysis::AnalysisOptions settings;
    settings.criterion = options.criterion;
    settings.screening.apply = !options.noScreening;
    analysis::ScreeningLimits& limits = settings.screening.limits;
    limits = study.screening.value_or(limits);
    limits.falseAlarmRate = options.falseAlarmRate.value_or(limits.falseAlarmRate);
    limits.catchFailureShare = options.catchFailureShare.value_or(limits.catchFailureShare);
    settings.bootstrap = options.bootstrap;
    std::optional<program::Progress> draws;
    if (options.bootstrap > 0) {
        draws.emplace("draws of observers", static_cast<std::size_t>(options.bootstrap));
        settings.bootstrapDone = [&draws] { draws->advance(); };
    }
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
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);  // Linux: in kB
    std::printf("%8.0f MB  peak memory\n", static_cast<double>(usage.ru_maxrss) / 1e3);
}

// Answers before anybody sits down: how wide an interval a design would give, and whether it
// covers.
void simulate(const Options& options, std::vector<std::string> command) {
    requireCriterion(options.criterion);
    std::string observer =
        options.observer;  // study_app's words, of which the first may be left out
    if (!observer.starts_with("simulated")) observer.insert(0, "simulated:");
    analysis::CoveragePlan plan{
        .design = study_app::readDesign(study_app::findDesign(options.design)),
        .population = study_app::populationFromText(observer),
        .observers = options.observers,
        .guessing = options.guessing,
        .studies = options.studies,
        .seed = options.seed,
        .criterion = options.criterion,
        .threads = options.threads};
    if (options.trials) plan.design.trialsPerCondition = *options.trials;
    program::Progress progress("studies", static_cast<std::size_t>(plan.studies));
    const analysis::Coverage coverage =
        analysis::simulateCoverage(plan, [&] { progress.advance(); });
    std::printf(
        "%s\n",
        records::contextText(records::currentRunContext("fit_slope", std::move(command))).c_str());
    for (const std::string& sentence : analysis::coverageFindings(coverage)) {
        std::printf("%s\n", sentence.c_str());
    }
    const analysis::TextTable table = analysis::coverageTable(coverage);
    std::printf("\n%s\n%s", table.caption.c_str(), analysis::alignedText(table).c_str());
}

void run(const CLI::App& app, const Options& options, std::vector<std::string> command) {
    if (app.count("--coverage") > 0) return simulate(options, std::move(command));
    for (const char* required : {"PATH", "--out"}) {
        if (app.count(required) == 0) throw CLI::RequiredError(required);
    }
    fit(options, std::move(command));
}

void addCoverageOptions(CLI::App& app, Options& o) {
    CLI::Option* const coverage = app.add_option(
        "--coverage", o.design,
        "Simulate studies of this design (file, or name of a shipped one) and print bias, scatter "
        "and interval coverage of every estimator, with Monte-Carlo errors");
    for (const char* other :
         {"PATH", "--out", "--by", "--bootstrap", "--no-screening", "--timing"}) {
        coverage->excludes(app.get_option(other));
    }
    const auto add = [&](const char* name, auto& value, const char* text) {
        return app.add_option(name, value, text)->needs(coverage);
    };
    add("--observers", o.observers, "Of each simulated study (default 10)")
        ->check(CLI::Range(1, 9999));
    add("--studies", o.studies, "To simulate (default 100)")->check(CLI::Range(2, 1000000));
    add("--trials", o.trials, "For each condition (default: the design's)")
        ->check(CLI::Range(1, 100000));
    add("--observer", o.observer, "key=value,...: the simulated population, see below");
    add("--guessing", o.guessing, "So many of the observers press at random (default 0)")
        ->check(CLI::Range(0, 9998));
    add("--seed", o.seed, "Of the simulated studies (default 1)");
    add("--threads", o.threads, "The result does not depend on it (default: all processors)")
        ->check(CLI::Range(1, 256));
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{"Fits the slope c of r = c a: the filter radius that hides artifacts of size a."};
    app.footer("Keys of --observer with their defaults:\n" + study_app::describeKeys() +
               "\nExamples: fit_slope my-study --out my-fit\n"
               "          fit_slope --coverage paper16 --observers 8 --observer observer_sd=.15");
    Options options;
    app.add_option("PATH", options.paths, "Trial tables, or folders of them");
    app.add_option("--out", options.out,
                   "Folder for slope.json, report.html, figures and tables (created)");
    app.add_option("--criterion", options.criterion,
                   "F*: detection probability at r = c a, guesses and lapses taken out (default: "
                   "the published .6465)");
    app.add_option("--by", options.by,
                   "NAME[,NAME]: divide the groups further, by a column of the tables (kernel, "
                   "noise, an extra one), of participants.tsv (expertise), by design or session; "
                   "the headline is the worst group of all")
        ->delimiter(',');
    app.add_option("--bootstrap", options.bootstrap,
                   "Refit this many draws of the observers, for intervals that assume no "
                   "distribution (default: none)")
        ->check(CLI::Range(20, 100000));
    app.add_flag("--no-screening", options.noScreening,
                 "Fit every observer, whatever the rules say");
    app.add_option("--false-alarm-rate", options.falseAlarmRate,
                   "Yes/no: leave out whose lower 95 % bound is above (default: the design's, .10)")
        ->check(CLI::Range(0.0, 1.0));
    app.add_option("--catch-failures", options.catchFailureShare,
                   "2AFC: leave out who fails a larger share of the catch trials (default: the "
                   "design's, .20)")
        ->check(CLI::Range(0.0, 1.0));
    app.add_flag("--timing", options.timing, "Print where the time went, and the peak memory");
    addCoverageOptions(app, options);
    std::vector<std::string> command(argv, argv + argc);
    return program::run(app, argc, argv, [&] { run(app, options, command); });
}

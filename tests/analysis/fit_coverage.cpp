// SPDX-License-Identifier: MIT
// fit_coverage: simulates studies, fits each, and prints how often the 95 % intervals cover and how
// far the estimates are off. Built with the tests, run by hand: the numbers in docs/results.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>

#include "program/progress.h"
#include "program/run_program.h"
#include "records/run_context.h"
#include "tests/analysis/coverage.h"

namespace {

struct Options {
    int studies = 500, threads = 1;
    std::uint64_t seed = 1;
    std::string only;
    bool list = false;
};

void printCase(const tests::StudyPlan& plan, const Options& options) {
    using tests::StudyOutcome;
    program::Progress progress(plan.name, static_cast<std::size_t>(options.studies));
    const auto outcomes = tests::fitMany(plan, options.studies, options.threads, options.seed,
                                         [&] { progress.advance(); });
    const double n = options.studies;
    const auto percent = [&](bool StudyOutcome::*what) { return 100 * share(outcomes, what); };
    // Of a median: 1.2533 sd / sqrt(n) for a normal distribution.
    const double error =
        1.2533 * standardDeviation(outcomes, &StudyOutcome::headlineError) / std::sqrt(n);
    std::printf(
        "%-40s %6.1f %6.1f %6.1f %6.1f %6.1f  %+8.4f %+8.4f %+8.4f %7.4f  %6.4f %6.4f "
        "%5.2f  %5.1f %7.1f\n",
        plan.name.c_str(), percent(&StudyOutcome::headlineCovered),
        percent(&StudyOutcome::overallCovered), percent(&StudyOutcome::covered90),
        percent(&StudyOutcome::kappaCovered), percent(&StudyOutcome::kappaRejected),
        median(outcomes, &StudyOutcome::headlineError),
        median(outcomes, &StudyOutcome::overallError), median(outcomes, &StudyOutcome::error90),
        error, median(outcomes, &StudyOutcome::tau), median(outcomes, &StudyOutcome::omega),
        median(outcomes, &StudyOutcome::beta), 100 - percent(&StudyOutcome::fitted),
        1e3 * median(outcomes, &StudyOutcome::seconds));
    std::fflush(stdout);
}

void run(const Options& options, std::vector<std::string> command) {
    if (!options.list) {
        std::printf("%s\n", records::contextText(
                                records::currentRunContext("fit_coverage", std::move(command)))
                                .c_str());
        std::printf(
            "%d studies per row (observers x conditions x trials), seed %llu. Coverage of the 95 "
            "%% "
            "interval in %%, Monte-Carlo error %.1f at 95 %%;\nmedian of log10(estimate / truth) "
            "with the Monte-Carlo standard error of the headline's; medians of tau, omega (.1, .05 "
            "unless named), beta (3.5);\nstudies without a converged fit in %%; median time of a "
            "fit "
            "with test of the law, ms\n\n",
            options.studies, static_cast<unsigned long long>(options.seed),
            100 * std::sqrt(0.95 * 0.05 / options.studies));
        std::printf("%-40s %6s %6s %6s %6s %6s  %8s %8s %8s %7s  %6s %6s %5s  %5s %7s\n", "study",
                    "headl.", "overa.", "c90", "kappa", "reject", "headl.", "overall", "c90",
                    "error", "tau", "omega", "beta", "none", "ms");
    }
    bool any = false;
    for (const tests::StudyPlan& plan : tests::coveragePlans()) {
        if (options.list) {
            std::printf("%s\n", plan.name.c_str());
        } else if (plan.name.find(options.only) != std::string::npos) {
            printCase(plan, options);
            any = true;
        }
    }
    if (!any && !options.list) {
        throw std::runtime_error("--only: " + options.only + ": no study has that in its name");
    }
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{"Coverage and bias of the slope's intervals over simulated studies."};
    Options options;
    app.add_option("--studies", options.studies, "Studies per case")->check(CLI::Range(2, 1000000));
    app.add_option("--threads", options.threads, "The result does not depend on it")
        ->check(CLI::Range(1, 256));
    app.add_option("--seed", options.seed, "Of the simulated studies");
    app.add_option("--only", options.only, "Cases whose name contains this");
    app.add_flag("--list", options.list, "Print the names of the cases");
    std::vector<std::string> command(argv, argv + argc);
    return program::run(app, argc, argv, [&] { run(options, command); });
}

// SPDX-License-Identifier: MIT
#include <cstdio>

#include "demo/benchmark.h"
#include "demo/benchmark_report.h"
#include "demo/policy_comparison.h"
#include "demo/speed_error_front.h"
#include "demo/sweep.h"
#include "demo/sweep_difference.h"
#include "demo/sweep_report.h"
#include "program/run_program.h"
#include "records/slope_file.h"
#include "records/whole_file.h"

namespace {

struct Options {
    std::vector<std::string> scenes, techniques;
    std::vector<std::string> resolutions = {"auto", "512", "2048", "4096"};
    std::filesystem::path out;
    demo::SlopeOptions slope;
    std::optional<std::filesystem::path> fit;
    int width = 640, height = 360, rounds = 5;
    bool quick = false;
    bool sweep = false, reportAlone = false;
    std::vector<int> sizes = {128, 184, 256, 368, 512, 728, 1024, 1456, 2048, 2904, 4096};
    int frames = 3;
    double mostFrameMs = 4000;
    std::string shard = "1/1";
    std::optional<std::filesystem::path> stability;
    std::vector<std::filesystem::path> compare;
    std::optional<std::filesystem::path> recommendFrom;
    std::string recommendScene;
    demo::Wish wish;
    std::vector<std::string> command;
};

// The techniques that policies are compared with, one of each family, where none are named.
const std::vector<std::string> kSweptTechniques = {"pcf_disc", "pcss", "vsm",
                                                   "evsm4",    "msm",  "power_cdf"};

demo::SweepSettings sweepSettings(const Options& options) {
    demo::SweepSettings settings;
    settings.scenes = options.scenes;
    if (settings.scenes.empty())
        for (const renderer::SceneEntry& entry : renderer::builtInScenes())
            settings.scenes.emplace_back(entry.name);
    for (const std::string& name : settings.scenes) renderer::findScene(name);
    for (const std::string& name :
         options.techniques.empty() ? kSweptTechniques : options.techniques)
        settings.techniques.push_back(&renderer::findTechnique(name));
    settings.sizes = options.sizes;
    settings.frames = options.frames;
    settings.rounds = options.rounds;
    settings.widthPx = options.width;
    settings.heightPx = options.height;
    settings.mostFrameMs = options.mostFrameMs;
    settings.shard = demo::parseShard(options.shard, "--shard");
    settings.slope = demo::loadSlope(options.slope);
    settings.folder = options.out;
    if (options.quick) {
        settings.sizes = {128, 256, 512, 1024, 2048};
        settings.widthPx /= 2;
        settings.heightPx /= 2;
        settings.frames = 1;
        settings.rounds = 1;
        settings.mostFrameMs = std::min(settings.mostFrameMs, 400.0);
    }
    return settings;
}

void printPolicies(const std::vector<demo::PolicyComparison>& comparisons) {
    for (const demo::PolicyComparison& comparison : comparisons)
        for (const auto& entry : comparison.entries) {
            std::printf("%-10s %-18s", comparison.technique.c_str(),
                        std::string(entry.policy->name).c_str());
            if (entry.result)
                std::printf(" %8.2f ms  %6.3f of ours  ripple %.3f  %s %.4g\n",
                            entry.result->geometricMeanMs, entry.timesOurs, entry.result->rippleP95,
                            std::string(entry.policy->parameter).c_str(), entry.result->parameter);
            else
                std::printf(" keeps to the bound with no measured sizes\n");
        }
}

void sweep(const Options& options) {
    const demo::SweepSettings settings = sweepSettings(options);
    settings.validate();
    if (!options.reportAlone) {
        records::createFolders(options.out);
        const renderer::HeadlessContext context;
        records::RunContext run = records::currentRunContext("shadow_bench", options.command);
        run.glRenderer = context.info().renderer;
        run.glVersion = context.info().version;
        run.softwareRasteriser = context.info().softwareRasteriser;
        run.viewportWidthPx = settings.widthPx;
        run.viewportHeightPx = settings.heightPx;
        demo::runSweep(context.info(), settings, run);
        if (settings.shard.count > 1) return;  // the last to come reports: --report
    }
    const demo::SweepTable table = demo::readSweep(options.out);
    const auto report = demo::writeSweepReport(options.out, table, options.stability);
    printPolicies(demo::comparePolicies(table));
    for (const std::string& broken : demo::brokenTechniques(table))
        std::printf("BROKEN: %s\n", broken.c_str());
    std::printf("report: %s\n", report.string().c_str());
}

void compare(const Options& options) {
    const auto differences = demo::slowerOrWorse(demo::readSweep(options.compare.at(0)),
                                                 demo::readSweep(options.compare.at(1)));
    for (const demo::SweepDifference& difference : differences)
        std::printf("%s\t%d\t%s\t%d\t%s\t%.5g\t%.5g\n", difference.scene.c_str(), difference.frame,
                    difference.technique.c_str(), difference.resolution, difference.what.c_str(),
                    difference.before, difference.now);
    std::printf("%zu slower, worse or missing beyond noise\n", differences.size());
}

void recommend(const Options& options) {
    const auto all =
        demo::speedAndErrors(demo::readSweep(*options.recommendFrom), options.recommendScene);
    if (all.empty())
        throw std::runtime_error(options.recommendFrom->string() +
                                 ": holds no finished cells of \"" + options.recommendScene + "\"");
    const demo::SpeedAndError* best = demo::recommended(all, options.wish);
    if (best == nullptr)
        std::printf("nothing in the sweep meets it\n");
    else
        std::printf("%s at %d: %.2f ms a frame, resolution error at most %.5f RMSE\n",
                    best->technique.c_str(), best->resolution, best->frameMs, best->error);
    std::printf("chosen from:\n");
    for (const demo::SpeedAndError& point : all)
        if (!point.dominated)
            std::printf("%-12s %5d  %9.2f ms  %.5f\n", point.technique.c_str(), point.resolution,
                        point.frameMs, point.error);
}

void measure(const Options& options) {
    demo::BenchmarkSettings settings{.scenes = options.scenes,
                                     .techniques = options.techniques,
                                     .resolutions = {},
                                     .widthPx = options.width,
                                     .heightPx = options.height,
                                     .rounds = options.rounds,
                                     .slope = demo::loadSlope(options.slope)};
    for (const std::string& text : options.resolutions)
        settings.resolutions.push_back(demo::parseResolution(text, "--resolutions"));
    if (options.quick) {
        settings.widthPx = options.width / 2;
        settings.heightPx = options.height / 2;
        settings.rounds = 3;
    }
    // Before minutes of measuring:
    if (options.fit) records::readSlope(*options.fit / "slope.json");
    records::createFolders(options.out);
    const renderer::HeadlessContext context;
    const demo::BenchmarkResult result = demo::runBenchmark(context.info(), settings);

    records::RunContext run = records::currentRunContext("shadow_bench", options.command);
    run.glRenderer = context.info().renderer;
    run.glVersion = context.info().version;
    run.softwareRasteriser = context.info().softwareRasteriser;
    run.viewportWidthPx = settings.widthPx;
    run.viewportHeightPx = settings.heightPx;
    const std::filesystem::path report =
        demo::writeReport(options.out, result, run, settings.slope, options.fit);
    for (const demo::Headline& headline : demo::headlines(result))
        std::printf("%s %s\n", headline.number.c_str(), headline.meaning.c_str());
    std::printf("report: %s\n", report.string().c_str());
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{
        "Speed against error: every scene and technique at automatic and at fixed map sizes, at "
        "the same "
        "softness."};
    Options options;
    options.command.assign(argv, argv + argc);
    app.add_option("--scenes", options.scenes, "scenes or model files; default: all built-in ones")->delimiter(',');
    app.add_option("--techniques", options.techniques, "techniques; default: all with a kernel")
        ->delimiter(',');
    app.add_option("--resolutions", options.resolutions,
                   "auto and map edges in texels; the largest is the reference")
        ->delimiter(',')
        ->capture_default_str();
    app.add_option("--out", options.out, "folder of the report, the table and the pictures");
    demo::addSlopeOptions(app, options.slope);
    app.add_option("--fit", options.fit,
                   "folder of fit_slope whose slope and figures go into the report");
    app.add_option("--width", options.width, "viewport width in px")->capture_default_str();
    app.add_option("--height", options.height, "viewport height in px")->capture_default_str();
    app.add_option("--rounds", options.rounds, "timed visits of each cell")->capture_default_str();
    app.add_flag("--quick", options.quick, "half the viewport's edges, three rounds");
    app.add_flag(
        "--sweep", options.sweep,
        "measure a table of path frame x technique x size that sizing policies are compared "
        "from, or go on with the one in --out");
    app.add_flag("--report", options.reportAlone,
                 "with --sweep: measure nothing, write the report of what lies in --out");
    app.add_option("--sizes", options.sizes, "sizes of the sweep, levels of the controller")
        ->delimiter(',')
        ->capture_default_str();
    app.add_option("--frames", options.frames, "frames of each scene's path in the sweep")
        ->capture_default_str();
    app.add_option("--most-ms", options.mostFrameMs,
                   "cells of the sweep that are predicted to take longer are skipped")
        ->capture_default_str();
    app.add_option("--shard", options.shard, "INDEX/COUNT: this part of the sweep")
        ->capture_default_str();
    app.add_option("--stability", options.stability,
                   "with --sweep: table of technique_errors for the report");
    app.add_option("--compare", options.compare,
                   "OLD NEW: what of two sweeps' folders got slower or worse beyond noise")
        ->expected(2);
    app.add_option("--recommend", options.recommendFrom,
                   "folder of a sweep: the cheapest technique and size that meet --max-error, or "
                   "the most exact within --max-ms");
    app.add_option("--scene", options.recommendScene, "with --recommend: the scene; default: all");
    app.add_option("--max-error", options.wish.mostError, "with --recommend: RMSE");
    app.add_option("--max-ms", options.wish.mostMs, "with --recommend: milliseconds a frame");
    app.callback([&] {
        if (options.out.empty() && options.compare.empty() && !options.recommendFrom)
            throw CLI::RequiredError("--out");
    });
    return program::run(app, argc, argv, [&] {
        if (!options.compare.empty()) return compare(options);
        if (options.recommendFrom) return recommend(options);
        options.sweep ? sweep(options) : measure(options);
    });
}

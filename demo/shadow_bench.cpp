// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdio>

#include "demo/benchmark.h"
#include "demo/benchmark_report.h"
#include "demo/direct_run.h"
#include "demo/growth_run.h"
#include "demo/model_error.h"
#include "demo/policy_comparison.h"
#include "demo/speed_error_front.h"
#include "demo/sweep.h"
#include "demo/sweep_context.h"
#include "demo/sweep_difference.h"
#include "demo/sweep_report.h"
#include "demo/tsv_journal.h"
#include "program/run_program.h"
#include "records/slope_file.h"
#include "records/whole_file.h"
#include "renderer/scene_file.h"

namespace {

struct Options {
    std::vector<std::string> scenes, techniques;
    std::vector<std::string> resolutions = {"auto", "512", "2048", "4096"};
    std::filesystem::path out;
    demo::SlopeOptions slope;
    std::optional<std::filesystem::path> fit;
    int width = 640, height = 360;
    std::optional<int> rounds;
    bool quick = false;
    bool sweep = false, reportAlone = false, model = false, direct = false, growth = false;
    std::vector<int> sizes = {128, 184, 256, 368, 512, 728, 1024, 1456, 2048, 2904, 4096};
    std::vector<double> softness = {1};
    int frames = 2;
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
    // Errors and policies are those of the sun's one map.
    if (settings.scenes.empty())
        for (const renderer::SceneEntry& entry : renderer::builtInScenes())
            if (renderer::makeScene(entry.name).lamps.empty())
                settings.scenes.emplace_back(entry.name);
    for (const std::string& name : settings.scenes)
        if (!std::filesystem::exists(renderer::withoutOptions(name))) renderer::findScene(name);
    settings.softness = options.softness;
    settings.techniques = demo::parseSweptTechniques(
        options.techniques.empty() ? kSweptTechniques : options.techniques);
    settings.sizes = options.sizes;
    settings.frames = options.frames;
    if (options.rounds) settings.rounds = *options.rounds;
    settings.widthPx = options.width;
    settings.heightPx = options.height;
    settings.mostFrameMs = options.mostFrameMs;
    settings.shard = demo::parseShard(options.shard, "--shard");
    settings.slope = demo::loadSlope(options.slope);
    settings.folder = options.out;
    if (options.quick) {
        settings.sizes = {128, 256, 512, 1024};
        settings.widthPx /= 2;
        settings.heightPx /= 2;
        settings.frames = 1;
        settings.rounds = 1;
        settings.confirmsPolicies = false;
        settings.mostFrameMs = std::min(settings.mostFrameMs, 250.0);
    }
    return settings;
}

void printPolicies(const std::vector<demo::PolicyComparison>& comparisons) {
    for (const demo::PolicyComparison& comparison : comparisons)
        for (const auto& entry : comparison.entries) {
            std::printf("%-10s %-18s", comparison.technique.c_str(),
                        std::string(entry.policy->name).c_str());
            if (entry.result)
                std::printf(" %8.2f ms  %6.3f of ours  ripple %.3f  %d to %d  %s %.4g\n",
                            entry.result->geometricMeanMs, entry.timesOurs,
                            entry.result->ripple(comparison.over), entry.result->smallest,
                            entry.result->largest, std::string(entry.policy->parameter).c_str(),
                            entry.result->parameter);
            else if (entry.nearest)
                std::printf(" cannot keep to %.3f: ripple %.3f at least\n", comparison.bound,
                            entry.nearest->ripple(comparison.over));
            else
                std::printf(" has no parameter of which all sizes were measured\n");
        }
}

records::RunContext contextOf(const Options& options, const renderer::GlInfo& info, int widthPx,
                              int heightPx) {
    records::RunContext run = records::currentRunContext("shadow_bench", options.command);
    run.glRenderer = info.renderer;
    run.glVersion = info.version;
    run.softwareRasteriser = info.softwareRasteriser;
    run.viewportWidthPx = widthPx;
    run.viewportHeightPx = heightPx;
    return run;
}

// What growth is measured with where no techniques are named: a full kernel, taps, a blurred map.
const std::vector<std::string> kGrowthTechniques = {"pcf_disc", "pcf_taps", "vsm"};

void measureGrowth(const Options& options) {
    demo::GrowthSettings settings;
    if (options.scenes.size() > 1)
        throw std::invalid_argument("--growth takes one scene, not " +
                                    std::to_string(options.scenes.size()));
    if (!options.scenes.empty()) settings.scene = options.scenes.front();
    for (const std::string& name :
         options.techniques.empty() ? kGrowthTechniques : options.techniques)
        settings.techniques.push_back(&renderer::findTechnique(name));
    if (options.rounds) settings.rounds = *options.rounds;
    settings.widthPx = options.width;
    settings.heightPx = options.height;
    settings.folder = options.out;
    if (options.quick) {
        settings.rounds = 1;
        settings.reduction = 4;
    }
    settings.validate();
    records::createFolders(options.out);
    const renderer::HeadlessContext context;
    demo::measureGrowth(context.info(), settings,
                        contextOf(options, context.info(), settings.widthPx, settings.heightPx));
    const std::string table = demo::growthTable(demo::readGrowth(options.out));
    records::writeWholeFile(options.out / "growth_fits.tsv", table);
    std::printf("%s", table.c_str());
}

void sweep(const Options& options) {
    const demo::SweepSettings settings = sweepSettings(options);
    settings.validate();
    // Before an hour of measuring:
    if (options.stability) records::readWholeFile(*options.stability);
    const bool whole = settings.shard.count == 1;
    if (!options.reportAlone || options.direct || options.model) {
        records::createFolders(options.out);
        const renderer::HeadlessContext context;
        const records::RunContext run =
            contextOf(options, context.info(), settings.widthPx, settings.heightPx);
        if (!options.reportAlone) demo::runSweep(context.info(), settings, run);
        if (!whole) return;  // the last to come reports: --report
        if (options.direct || !options.reportAlone) demo::runDirect(context.info(), settings, run);
        if (!settings.confirmsPolicies)
            std::printf(
                "quick: one frame, one visit, sizes to %d, cells over %.0f ms skipped; the "
                "automatic "
                "size is drawn, other policies' frames are not drawn again to confirm the table\n",
                settings.sizes.back(), settings.mostFrameMs);
        if (options.model)
            demo::measureModelErrors(context.info(),
                                     {.scenes = settings.scenes,
                                      .techniques = settings.techniques,
                                      .widthPx = settings.widthPx / 2,
                                      .heightPx = settings.heightPx / 2,
                                      .folder = options.out},
                                     run);
    }
    const demo::SweepTable table = demo::readSweep(options.out);
    const auto report = demo::writeSweepReport(options.out, table, options.stability);
    std::printf("ripple within the bound in every scene:\n");
    printPolicies(demo::comparePolicies(table, demo::RippleOver::eachScene));
    std::printf("ripple within the bound over all scenes together:\n");
    printPolicies(demo::comparePolicies(table, demo::RippleOver::allTogether));
    for (const std::string& broken : demo::brokenTechniques(table))
        std::printf("BROKEN: %s\n", broken.c_str());
    std::printf("report: %s\n", report.string().c_str());
}

void compare(const Options& options) {
    const demo::SweepTable before = demo::readSweep(options.compare.at(0));
    const demo::SweepTable now = demo::readSweep(options.compare.at(1));
    for (const std::string& difference :
         demo::contextDifferences(before.context, now.context, {"build", "GL", "driver", "plan"}))
        std::printf("note: times may not compare: %s\n", difference.c_str());
    const auto differences = demo::slowerOrWorse(before, now);
    for (const demo::SweepDifference& difference : differences)
        std::printf("%s\t%d\t%s\t%d\t%s\t%.5g\t%.5g\n", difference.scene.c_str(), difference.frame,
                    difference.technique.c_str(), difference.resolution, difference.what.c_str(),
                    difference.before, difference.now);
    std::printf("%zu slower, worse or missing beyond noise\n", differences.size());
}

void recommend(const Options& options) {
    if (!options.wish.mostError && !options.wish.mostMs)
        throw std::invalid_argument("--recommend needs --max-error, --max-ms or both");
    for (const auto& [name, limit] : {std::pair{"--max-error", options.wish.mostError},
                                      std::pair{"--max-ms", options.wish.mostMs}})
        if (limit && !(*limit >= 0))
            throw std::invalid_argument(std::string(name) + " is " + demo::tsvNumber(*limit) +
                                        ", must be at least 0");
    const demo::SweepTable table = demo::readSweep(*options.recommendFrom);
    const std::string& scene = options.recommendScene;
    if (!scene.empty() &&
        std::find(table.scenes.begin(), table.scenes.end(), scene) == table.scenes.end()) {
        std::string known;
        for (const std::string& name : table.scenes) known += (known.empty() ? "" : ", ") + name;
        throw std::runtime_error(options.recommendFrom->string() + ": has no scene \"" + scene +
                                 "\"; it has: " + known);
    }
    const auto all = demo::speedAndErrors(table, scene);
    if (all.empty())
        throw std::runtime_error(options.recommendFrom->string() +
                                 ": no technique and size was measured in every frame of " +
                                 (scene.empty() ? "all scenes" : scene));
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
                                     .rounds = options.rounds.value_or(5),
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

    const records::RunContext run =
        contextOf(options, context.info(), settings.widthPx, settings.heightPx);
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
    app.add_option("--scenes", options.scenes,
                   "scenes or model files; default: all built-in ones without lamps")
        ->delimiter(',');
    app.add_option(
           "--techniques", options.techniques,
           "techniques; default: all with a kernel; a sweep also takes NAME:PARAMETER=NUMBER")
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
    app.add_option("--rounds", options.rounds,
                   "timed visits of each cell; default: 5, in a sweep 3");
    app.add_flag(
        "--quick", options.quick,
        "half the viewport's edges, three rounds; of a sweep one round, one frame, four sizes, "
        "and no frames drawn again to confirm the table: under two minutes");
    CLI::Option* const sweepFlag = app.add_flag(
        "--sweep", options.sweep,
        "measure a table of path frame x technique x size that sizing policies are compared "
        "from, or go on with the one in --out");
    app.add_flag("--report", options.reportAlone,
                 "with --sweep: measure nothing, write the report of what lies in --out")
        ->needs(sweepFlag);
    app.add_flag("--direct", options.direct,
                 "with --sweep --report: draw the calibrated policies' frames directly, as a sweep "
                 "without shards does at its end")
        ->needs(sweepFlag);
    app.add_flag("--growth", options.growth,
                 "measure how cost grows with N, taps, triangles, lights and pixels, into --out")
        ->excludes(sweepFlag);
    app.add_flag("--model", options.model,
                 "with --sweep: also the errors against an area light, by ray casting")
        ->needs(sweepFlag);
    app.add_option("--sizes", options.sizes, "sizes of the sweep, levels of the controller")
        ->delimiter(',')
        ->needs(sweepFlag)
        ->capture_default_str();
    app.add_option("--softness", options.softness,
                   "of the sweep, as factors of each scene's own softness")
        ->delimiter(',')
        ->needs(sweepFlag)
        ->capture_default_str();
    app.add_option("--frames", options.frames, "frames of each scene's path in the sweep")
        ->needs(sweepFlag)
        ->capture_default_str();
    app.add_option("--most-ms", options.mostFrameMs,
                   "cells of the sweep that are predicted to take longer are skipped")
        ->needs(sweepFlag)
        ->capture_default_str();
    app.add_option("--shard", options.shard, "INDEX/COUNT: this part of the sweep")
        ->needs(sweepFlag)
        ->capture_default_str();
    app.add_option("--stability", options.stability,
                   "with --sweep: table of technique_errors for the report")
        ->needs(sweepFlag);
    app.add_option("--compare", options.compare,
                   "OLD NEW: what of two sweeps' folders got slower or worse beyond noise")
        ->expected(2);
    CLI::Option* const recommendation = app.add_option(
        "--recommend", options.recommendFrom,
        "folder of a sweep: the cheapest technique and size that meet --max-error, or "
        "the most exact within --max-ms");
    app.add_option("--scene", options.recommendScene, "with --recommend: the scene; default: all")
        ->needs(recommendation);
    app.add_option("--max-error", options.wish.mostError, "with --recommend: RMSE")
        ->needs(recommendation);
    app.add_option("--max-ms", options.wish.mostMs, "with --recommend: milliseconds a frame")
        ->needs(recommendation);
    app.callback([&] {
        if (options.out.empty() && options.compare.empty() && !options.recommendFrom)
            throw CLI::RequiredError("--out");
    });
    return program::run(app, argc, argv, [&] {
        if (!options.compare.empty()) return compare(options);
        if (options.recommendFrom) return recommend(options);
        if (options.growth) return measureGrowth(options);
        options.sweep ? sweep(options) : measure(options);
    });
}

// SPDX-License-Identifier: MIT
#include <cstdio>

#include "demo/benchmark.h"
#include "demo/benchmark_report.h"
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
    std::vector<std::string> command;
};

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
    app.add_option("--scenes", options.scenes, "scenes; default: all")->delimiter(',');
    app.add_option("--techniques", options.techniques, "techniques; default: all with a kernel")
        ->delimiter(',');
    app.add_option("--resolutions", options.resolutions,
                   "auto and map edges in texels; the largest is the reference")
        ->delimiter(',')
        ->capture_default_str();
    app.add_option("--out", options.out, "folder of the report, the table and the pictures")
        ->required();
    demo::addSlopeOptions(app, options.slope);
    app.add_option("--fit", options.fit,
                   "folder of fit_slope whose slope and figures go into the report");
    app.add_option("--width", options.width, "viewport width in px")->capture_default_str();
    app.add_option("--height", options.height, "viewport height in px")->capture_default_str();
    app.add_option("--rounds", options.rounds, "timed visits of each cell")->capture_default_str();
    app.add_flag("--quick", options.quick, "half the viewport's edges, three rounds");
    return program::run(app, argc, argv, [&] { measure(options); });
}

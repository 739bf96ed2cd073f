// SPDX-License-Identifier: MIT
#include <cstdio>

#include "demo/demo_stats.h"
#include "demo/demo_window.h"
#include "demo/picture.h"
#include "demo/shadow_run.h"
#include "program/run_program.h"
#include "renderer/window.h"

namespace {

struct Options {
    std::string scene = "yard";
    std::string technique = "pcf_disc";
    std::vector<std::string> parameters;
    std::string resolution = "auto";
    std::optional<double> radiusM, radiusUv;
    demo::SlopeOptions slope;
    bool headless = false;
    std::optional<int> frames;
    int width = 1280, height = 720;
    int samples = 2;
    std::optional<std::filesystem::path> screenshot, stats;
    bool listTechniques = false, listScenes = false;
    std::vector<std::string> command;
};

constexpr int kHeadlessFrames = 10;

void listTechniques() {
    for (const renderer::Technique& technique : renderer::techniques()) {
        std::printf("%s\t%s; %s; map %s, prefilter %s; %s\n", std::string(technique.name).c_str(),
                    std::string(technique.title).c_str(), std::string(technique.paper).c_str(),
                    std::string(toText(technique.format)).c_str(),
                    std::string(toText(technique.prefilter)).c_str(),
                    std::string(technique.cost).c_str());
        for (const renderer::TechniqueParameter& parameter : technique.parameters)
            std::printf("  %s=%g\t%s, %g to %g\n", std::string(parameter.name).c_str(),
                        static_cast<double>(parameter.standard),
                        std::string(parameter.meaning).c_str(), static_cast<double>(parameter.low),
                        static_cast<double>(parameter.high));
        for (const renderer::Property property : technique.doNotHold)
            std::printf("  does not hold: %s (%s)\n", std::string(toText(property)).c_str(),
                        std::string(technique.doNotHoldBecause).c_str());
    }
}

void listScenes() {
    for (const renderer::SceneEntry& entry : renderer::builtInScenes())
        std::printf("%s\t%s\n", std::string(entry.name).c_str(),
                    std::string(entry.description).c_str());
}

renderer::ParameterValues parametersOf(const Options& options,
                                       const renderer::Technique& technique) {
    renderer::ParameterValues values = technique.standardParameters();
    for (const std::string& text : options.parameters) {
        const std::size_t equals = text.find('=');
        char* end = nullptr;
        const float value =
            equals == std::string::npos ? 0 : std::strtof(text.c_str() + equals + 1, &end);
        if (equals == std::string::npos || end == text.c_str() + equals + 1 || *end != '\0')
            throw std::invalid_argument("--parameter is \"" + text + "\", must be NAME=NUMBER");
        setParameter(technique, values, text.substr(0, equals), value);
    }
    return values;
}

/// Measures, and writes what was asked for.
void report(const Options& options, const renderer::GlInfo& info, renderer::Renderer& frame,
            demo::ShadowRun& run, const renderer::Technique& technique,
            const renderer::ParameterValues& parameters, const demo::LoadedSlope& slope,
            int settlingFrames) {
    const int frames = options.frames.value_or(kHeadlessFrames);
    demo::DemoStats stats;
    stats.context = records::currentRunContext("shadow_demo", options.command);
    stats.scene = frame.scene().name;
    stats.technique = &technique;
    stats.parameters = parameters;
    stats.softness = demo::chooseSoftness(frame, options.radiusM, options.radiusUv);
    stats.settlingFrames = settlingFrames;
    stats.slope = slope;
    stats.mapExtentM = frame.window().extentM;
    stats.context.glRenderer = info.renderer;
    stats.context.glVersion = info.version;
    stats.context.softwareRasteriser = info.softwareRasteriser;
    stats.context.viewportWidthPx = frame.widthPx();
    stats.context.viewportHeightPx = frame.heightPx();
    stats.timing = std::string(renderer::PassClock(info).method());
    stats.wholeFrameMs = run.timeWholeFrames(frames);
    stats.passesMs = run.timePasses(frames);
    stats.chosen = run.chosen();
    stats.mapBytes = frame.mapBytes();
    stats.targetBytes = frame.targetBytes();
    stats.triangles = frame.triangles();
    if (options.stats) writeStats(*options.stats, stats);
    if (options.screenshot) demo::writePng(*options.screenshot, run.picture(options.samples));
    std::printf("%s, %s: N = %d (%s%s), %.1f ms a frame [%.1f, %.1f]\n", stats.scene.c_str(),
                std::string(technique.name).c_str(), stats.chosen.resolution,
                stats.chosen.automatic ? "auto: " : "", stats.chosen.reason.c_str(),
                stats.wholeFrameMs.median, stats.wholeFrameMs.p25, stats.wholeFrameMs.p75);
}

void demonstrate(const Options& options) {
    if (options.listTechniques) return listTechniques();
    if (options.listScenes) return listScenes();
    if (options.frames && *options.frames < 1)
        throw std::invalid_argument("--frames is " + std::to_string(*options.frames) +
                                    ", must be at least 1");
    if (options.samples < 1 || options.samples > 8)
        throw std::invalid_argument("--samples is " + std::to_string(options.samples) +
                                    ", must be 1 to 8");

    const renderer::Technique& technique = renderer::findTechnique(options.technique);
    const renderer::ParameterValues parameters = parametersOf(options, technique);
    const demo::ResolutionOption resolution =
        demo::parseResolution(options.resolution, "--resolution");
    const renderer::Scene scene = renderer::makeScene(options.scene);
    const demo::LoadedSlope slope = demo::loadSlope(options.slope);
    if (options.slope.file)  // of the published default the stats say as much
        for (const std::string& note : slope.notes)
            std::fprintf(stderr, "shadow_demo: note: %s\n", note.c_str());

    if (options.headless) {
        const renderer::HeadlessContext context;
        renderer::Renderer frame(context.info(), scene, options.width, options.height);
        const demo::Softness softness =
            demo::chooseSoftness(frame, options.radiusM, options.radiusUv);
        demo::ShadowRun run(frame, context.info(),
                            {.technique = &technique,
                             .parameters = parameters,
                             .radiusUv = softness.radiusUv,
                             .resolution = resolution,
                             .slope = slope.slope});
        const int settlingFrames = run.settle();
        report(options, context.info(), frame, run, technique, parameters, slope, settlingFrames);
        return;
    }
    renderer::Window window("shadow_demo", options.width, options.height);
    std::printf("%s", demo::keyHelp().c_str());
    std::fflush(stdout);
    demo::ViewState state{
        .resolution = resolution, .radiusM = options.radiusM, .radiusUv = options.radiusUv};
    state.technique = static_cast<std::size_t>(&technique - renderer::techniques().data());
    while (renderer::builtInScenes()[state.scene].name != options.scene) ++state.scene;
    showWindow(window, state, slope.slope, parameters, options.width, options.height,
               options.frames.value_or(0), [&](renderer::Renderer& frame, demo::ShadowRun& run) {
                   if (!options.stats && !options.screenshot) return;
                   Options last = options;
                   last.frames = kHeadlessFrames;
                   report(last, window.info(), frame, run, *run.frameSettings().technique,
                          *run.frameSettings().parameters, slope, 0);
               });
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{
        "Shows a scene with shadows whose map is as small as the slope of the study "
        "allows.\n\nKeys in the "
        "window:\n" +
        demo::keyHelp()};
    Options options;
    options.command.assign(argv, argv + argc);
    app.add_option("--scene", options.scene, "built-in scene (see --list-scenes)")
        ->capture_default_str();
    app.add_option("--technique", options.technique, "shadow technique (see --list-techniques)")
        ->capture_default_str();
    app.add_option("--parameter", options.parameters,
                   "NAME=NUMBER, a parameter of the technique; may be repeated");
    app.add_option("--resolution", options.resolution, "map edge N in texels, or auto")
        ->capture_default_str();
    auto* radius = app.add_option("--radius", options.radiusM,
                                  "softness: radius of the blur in m; default: the scene's");
    app.add_option("--radius-uv", options.radiusUv, "the same as a fraction of the map's extent")
        ->excludes(radius);
    demo::addSlopeOptions(app, options.slope);
    app.add_flag("--headless", options.headless, "no window: render, measure, write, end");
    app.add_option("--frames", options.frames,
                   "headless: frames to time (default 10); window: frames after which to close");
    app.add_option("--width", options.width, "viewport width in px")->capture_default_str();
    app.add_option("--height", options.height, "viewport height in px")->capture_default_str();
    app.add_option("--screenshot", options.screenshot, "PNG file to write at the end");
    app.add_option("--samples", options.samples, "samples along a pixel's edge in the screenshot")
        ->capture_default_str();
    app.add_option("--stats", options.stats, "JSON file to write at the end");
    app.add_flag("--list-techniques", options.listTechniques,
                 "prints each technique: name first, then what it is");
    app.add_flag("--list-scenes", options.listScenes,
                 "prints each scene: name first, then what it is");
    return program::run(app, argc, argv, [&] { demonstrate(options); });
}

// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <span>

#include "demo/demo_stats.h"
#include "demo/frame_writer.h"
#include "demo/map_names.h"
#include "demo/picture.h"
#include "demo/viewer.h"
#include "demo/viewer_window.h"
#include "program/progress.h"
#include "program/run_program.h"
#include "records/whole_file.h"
#include "renderer/scene_file.h"
#include "renderer/window.h"

namespace {

/// What was given replaces what the state file says, which replaces the defaults.
struct Options {
    std::optional<std::string> scene, technique, resolution, view, path;
    std::vector<std::string> parameters;
    std::optional<double> radiusM, radiusUv, percentile;
    std::optional<int> compareWith, crossFade;
    std::optional<std::int64_t> budgetTexels;
    std::optional<float> gain, split;
    std::optional<int> viewMap;
    demo::SlopeOptions slope;
    std::optional<std::filesystem::path> state, shaders;
    bool headless = false;
    std::optional<int> frames;
    int width = 1280, height = 720;
    int samples = 2;
    std::optional<std::filesystem::path> screenshot, stats, sequence, writeFrames, trace, replay;
    std::optional<std::filesystem::path> windowPicture;
    int edge = 600;
    bool listTechniques = false, listScenes = false;
    std::vector<std::string> command;
};

constexpr int kHeadlessFrames = 10;
constexpr std::size_t kTraceBytes = 64U << 20U;  // a map takes some 400 bytes a frame

bool inWindow(const Options& options) {
    return !options.headless && !options.writeFrames;
}

void listTechniques() {
    for (const renderer::Technique& technique : renderer::techniques()) {
        std::printf("%s\t%s; %s; map %s, prefilter %s; %s\n", std::string(technique.name).c_str(),
                    std::string(technique.title).c_str(), std::string(technique.paper).c_str(),
                    std::string(toText(technique.format)).c_str(),
                    std::string(toText(technique.prefilter)).c_str(),
                    std::string(technique.cost).c_str());
        if (technique.planeDarkening > 0)
            std::printf("  a plane may darken itself by %.2g\n",
                        static_cast<double>(technique.planeDarkening));
        if (technique.steepDarkening > technique.planeDarkening)
            std::printf("  a steep plane under a wide kernel by up to %.2g\n",
                        static_cast<double>(technique.steepDarkening));
        for (const renderer::TechniqueParameter& parameter : technique.parameters)
            std::printf("  %s=%s\t%s, %s\n", std::string(parameter.name).c_str(),
                        valueText(parameter, parameter.standard).c_str(),
                        std::string(parameter.meaning).c_str(), rangeText(parameter).c_str());
        for (const renderer::Exemption& exemption : technique.doNotHold)
            std::printf("  does not hold: %s (%s)\n",
                        std::string(toText(exemption.property)).c_str(),
                        std::string(exemption.because).c_str());
    }
}

void listScenes() {
    for (const renderer::SceneEntry& entry : renderer::builtInScenes())
        std::printf("%s\t%s: %s\n", std::string(entry.name).c_str(),
                    std::string(entry.description).c_str(), std::string(entry.purpose).c_str());
}

void setParameters(const std::vector<std::string>& texts, demo::ViewerState& state) {
    if (texts.empty()) return;
    const renderer::Technique& technique = renderer::findTechnique(state.technique);
    renderer::ParameterValues values = parametersOf(state);
    for (const std::string& text : texts) {
        const std::size_t equals = text.find('=');
        char* end = nullptr;
        const std::string name = text.substr(0, equals);
        if (equals != std::string::npos && text.substr(equals + 1) == "auto") {
            const auto slot = technique.parameterSlot(name);
            if (slot && !technique.parameters[*slot].zeroIsAuto)
                throw std::invalid_argument("--parameter is \"" + text + "\", but " + name +
                                            " of technique " + std::string(technique.name) +
                                            " has no automatic choice; must be " +
                                            rangeText(technique.parameters[*slot]));
            setParameter(technique, values, name, 0);
            continue;
        }
        const float value =
            equals == std::string::npos ? 0 : std::strtof(text.c_str() + equals + 1, &end);
        if (equals == std::string::npos || end == text.c_str() + equals + 1 || *end != '\0')
            throw std::invalid_argument("--parameter is \"" + text +
                                        "\", must be NAME=NUMBER, or NAME=auto where that is "
                                        "offered");
        setParameter(technique, values, name, value);
    }
    state.parameters[state.technique] = values;
}

/// Where the window keeps its state without --state; absent where the environment names no place.
std::optional<std::filesystem::path> ownStateFile() {
    const auto folder = [](const char* variable) -> std::optional<std::filesystem::path> {
        const char* value = std::getenv(variable);
        if (value == nullptr || *value == '\0') return std::nullopt;
        return value;
    };
    const auto file = std::filesystem::path("stairwell") / "shadow_demo.json";
    if (const auto state = folder("XDG_STATE_HOME")) return *state / file;
    if (const auto home = folder("HOME")) return *home / ".local" / "state" / file;
    return std::nullopt;
}

/// That of the window's last time, which nobody asked for; absent where it is of no use.
std::optional<demo::ViewerState> keptState(const Options& options) {
    const auto own = ownStateFile();
    std::error_code unreadable;
    if (!inWindow(options) || options.state || !own || !std::filesystem::exists(*own, unreadable))
        return std::nullopt;
    try {
        demo::ViewerState state = demo::readViewerState(*own);
        if (options.slope.file) state.slopeFile.reset();
        if (state.slopeFile) {
            try {
                demo::loadSlope(state.slopeFile);
            } catch (const std::exception& error) {
                std::fprintf(stderr,
                             "shadow_demo: note: the slope of the last time cannot be used: %s; "
                             "beginning anew with the published one\n",
                             error.what());
                state.slopeFile.reset();
            }
        }
        return state;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "shadow_demo: note: %s; beginning anew\n", error.what());
        return std::nullopt;
    }
}

demo::ViewerState stateOf(const Options& options, const std::optional<demo::ViewerState>& kept) {
    demo::ViewerState state = kept.value_or(demo::ViewerState());
    if (options.state && std::filesystem::exists(*options.state))
        state = demo::readViewerState(*options.state);
    state.scene = options.scene.value_or(state.scene);
    state.technique = options.technique.value_or(state.technique);
    renderer::findTechnique(state.technique);  // before its parameters
    setParameters(options.parameters, state);
    if (options.resolution)
        state.resolution = demo::parseResolution(*options.resolution, "--resolution");
    if (options.radiusM || options.radiusUv) {
        state.radiusM = options.radiusM;
        state.radiusUv = options.radiusUv;
    }
    if (options.slope.file) state.slopeFile = options.slope.file;
    if (options.slope.detection) state.audience.detection = *options.slope.detection;
    if (options.slope.people) state.audience.people = *options.slope.people;
    state.percentile = options.percentile.value_or(state.percentile);
    state.crossFadeFrames = options.crossFade.value_or(state.crossFadeFrames);
    if (options.budgetTexels) state.budgetTexels = options.budgetTexels;
    if (options.view) state.view = demo::parseView(*options.view, "--view");
    if (options.path) state.path = demo::parsePath(*options.path, "--path");
    state.compareWith = options.compareWith.value_or(state.compareWith);
    state.viewMap = options.viewMap.value_or(state.viewMap);
    state.gain = options.gain.value_or(state.gain);
    state.splitAt = options.split.value_or(state.splitAt);
    return state;
}

/// Measures, and writes what was asked for.
void report(const Options& options, const renderer::GlInfo& info, demo::Viewer& viewer,
            int settlingFrames) {
    const int frames = options.frames.value_or(kHeadlessFrames);
    const renderer::Renderer& frame = viewer.frame();
    demo::DemoStats stats;
    stats.context = records::currentRunContext("shadow_demo", options.command);
    stats.scene = frame.scene().name;
    stats.technique = &renderer::findTechnique(viewer.state().technique);
    stats.parameters = parametersOf(viewer.state());
    stats.softness = viewer.softness();
    stats.settlingFrames = settlingFrames;
    stats.slope = viewer.slope();
    stats.mapExtentM = frame.window().extentM;
    stats.context.glRenderer = info.renderer;
    stats.context.glVersion = info.version;
    stats.context.softwareRasteriser = info.softwareRasteriser;
    stats.context.viewportWidthPx = frame.widthPx();
    stats.context.viewportHeightPx = frame.heightPx();
    stats.timing = std::string(renderer::PassClock(info).method());
    stats.wholeFrameMs = viewer.run().timeWholeFrames(frames);
    stats.passesMs = viewer.run().timePasses(frames);
    stats.chosen = viewer.run().chosen();
    stats.maps = viewer.run().maps();
    stats.mapNames = demo::mapNames(frame.lightViews());
    stats.budget = viewer.run().budget();
    stats.mapBytes = frame.mapBytes();
    stats.targetBytes = frame.targetBytes();
    stats.triangles = frame.triangles();
    if (options.stats) writeStats(*options.stats, stats);
    if (options.screenshot) demo::writePng(*options.screenshot, viewer.picture(options.samples));
    std::printf("%s, %s: N = %d (%s%s), %.1f ms a frame [%.1f, %.1f]\n", stats.scene.c_str(),
                std::string(stats.technique->name).c_str(), stats.chosen.resolution,
                stats.chosen.automatic ? "auto: " : "", stats.chosen.reason.c_str(),
                stats.wholeFrameMs.median, stats.wholeFrameMs.p25, stats.wholeFrameMs.p75);
    if (stats.maps.size() > 1 && stats.chosen.automatic)
        for (std::size_t map = 0; map < stats.maps.size(); ++map)
            std::printf("  %-16s N = %d (%s), artifact ratio %.2f\n", stats.mapNames[map].c_str(),
                        stats.maps[map].resolution, stats.maps[map].reason.c_str(),
                        stats.maps[map].artifactRatio);
    if (stats.budget)
        std::printf("  budget: %lld texels, used %llu, wanted %llu%s\n",
                    static_cast<long long>(stats.budget->texels),
                    static_cast<unsigned long long>(stats.budget->used),
                    static_cast<unsigned long long>(stats.budget->wanted),
                    stats.budget->feasible ? "" : "; even the smallest sizes take more");
}

void writeTrace(const Options& options, const demo::Viewer& viewer) {
    if (!options.trace) return;
    const resolution_controller::TraceWriter& trace = viewer.run().trace().value();
    if (trace.frames() == 0)
        throw std::invalid_argument("--trace: nothing was recorded, since no size was automatic");
    records::writeWholeFile(*options.trace, {reinterpret_cast<const char*>(trace.bytes().data()),
                                             trace.bytes().size()});
    if (trace.lost() > 0)
        std::fprintf(stderr,
                     "shadow_demo: note: %s holds the first %llu frames, not the last %llu\n",
                     options.trace->c_str(), static_cast<unsigned long long>(trace.frames()),
                     static_cast<unsigned long long>(trace.lost()));
}

void replayTrace(const std::filesystem::path& file) {
    const std::string bytes = records::readWholeFile(file);
    const resolution_controller::ReplayReport report =
        resolution_controller::replay(std::as_bytes(std::span(bytes)));
    if (!report.same) throw std::runtime_error(file.string() + ": " + report.problem);
    std::printf("%s: %llu frames, every decision the same\n", file.c_str(),
                static_cast<unsigned long long>(report.frames));
}

/// The path once round as numbered pictures.
void writeSequence(const Options& options, demo::Viewer& viewer) {
    const int frames = options.frames.value_or(kHeadlessFrames);
    records::createFolders(*options.sequence);
    if (viewer.state().path == demo::Path::still && frames > 1)
        std::fprintf(stderr,
                     "shadow_demo: note: --path is still, so all %d pictures are the same; camera "
                     "or sun goes round\n",
                     frames);
    for (int i = 0; i < frames; ++i) {
        demo::ViewerState state = viewer.state();
        state.pathPlace = static_cast<double>(i) / frames;
        viewer.show(state);
        viewer.settle();  // pictures are farther apart than the frames of a view in motion
        char name[32];
        std::snprintf(name, sizeof name, "frame-%04d.png", i + 1);
        demo::writePng(*options.sequence / name, viewer.picture(options.samples));
    }
    std::printf("%d pictures in %s\n", frames, options.sequence->string().c_str());
}

void tellNotes(const std::vector<std::string>& notes) {
    for (const std::string& note : notes)
        std::fprintf(stderr, "shadow_demo: note: %s\n", note.c_str());
}

void tellNotes(const demo::Viewer& viewer) {
    // Of the published default the stats say as much.
    if (viewer.state().slopeFile) tellNotes(viewer.slope().notes);
    tellNotes(viewer.frame().scene().notes);
}

/// Pairs of frames for a design of the study.
void writeStudyFrames(const Options& options, const demo::ViewerState& state) {
    const renderer::HeadlessContext context;
    renderer::Renderer frame(context.info(), renderer::openScene(state.scene), options.edge,
                             options.edge);
    tellNotes(frame.scene().notes);
    const demo::FramePlan plan{
        .technique = &renderer::findTechnique(state.technique),
        .parameters = parametersOf(state),
        .radiusUv = demo::chooseSoftness(frame, state.radiusM, state.radiusUv).radiusUv,
        .samples = options.samples};
    records::RunContext run = records::currentRunContext("shadow_demo", options.command);
    run.glRenderer = context.info().renderer;
    run.glVersion = context.info().version;
    run.softwareRasteriser = context.info().softwareRasteriser;
    run.viewportWidthPx = run.viewportHeightPx = options.edge;
    program::Progress progress("frames", static_cast<std::size_t>(demo::frameCount()));
    demo::writeFrames(*options.writeFrames, frame, context.info(), plan, run,
                      [&] { progress.advance(); });
    std::printf(
        "%s: pairs of frames with their manifest; a design shows them with \"frames\": "
        "\"FOLDER\"\n",
        options.writeFrames->string().c_str());
}

/// Where the scene is what cannot be shown, and a state file has named it. A read more: of a
/// failure.
void blameStateFile(const Options& options, const demo::ViewerState& state) {
    if (!options.state || options.scene || !std::filesystem::exists(*options.state)) return;
    try {
        renderer::openScene(state.scene);
    } catch (const std::exception& error) {
        throw std::runtime_error(options.state->string() + ": field scene: " + error.what());
    }
}

/// In a window, without one, or as a study's frames.
void show(const Options& options, const std::optional<demo::ViewerState>& kept,
          const demo::ViewerState& state) {
    if (options.writeFrames) return writeStudyFrames(options, state);

    const renderer::ShaderLibrary shaders =
        options.shaders ? renderer::ShaderLibrary::fromFolder(*options.shaders)
                        : renderer::ShaderLibrary::embedded();
    if (options.headless) {
        const renderer::HeadlessContext context;
        demo::Viewer viewer(context.info(), state, options.width, options.height, shaders);
        tellNotes(viewer);
        if (options.trace) viewer.run().startTrace(kTraceBytes);
        const int settlingFrames = viewer.settle();
        if (options.sequence)
            writeSequence(options, viewer);
        else
            report(options, context.info(), viewer, settlingFrames);
        writeTrace(options, viewer);
        if (options.state) demo::writeViewerState(*options.state, viewer.state());
        return;
    }
    renderer::Window window("shadow_demo", options.width, options.height);
    std::unique_ptr<demo::Viewer> opened;
    const auto open = [&](const demo::ViewerState& shown) {
        opened.reset();
        opened = std::make_unique<demo::Viewer>(window.info(), shown, options.width, options.height,
                                                shaders);
        opened->step();  // what the driver refuses comes out here
    };
    std::optional<std::string> refused;
    try {
        open(state);
    } catch (const std::exception& error) {
        if (!kept) throw;
        refused = error.what();
    }
    if (refused) {
        open(stateOf(options, std::nullopt));  // where that fails, too, it was not the kept state
        std::fprintf(stderr,
                     "shadow_demo: note: the state of the last time cannot be shown: %s; "
                     "beginning anew\n",
                     refused->c_str());
    }
    demo::Viewer& viewer = *opened;
    tellNotes(viewer);
    if (options.trace) viewer.run().startTrace(kTraceBytes);
    showViewer(window, viewer,
               {.frames = options.frames.value_or(0),
                .pictureFolder = ".",
                .windowPicture = options.windowPicture,
                .shaderFolder = options.shaders});
    writeTrace(options, viewer);
    if (options.stats || options.screenshot) {
        Options last = options;
        last.frames = kHeadlessFrames;
        report(last, window.info(), viewer, 0);
    }
    if (options.state) return demo::writeViewerState(*options.state, viewer.state());
    if (const auto own = ownStateFile()) {
        try {
            records::createFolders(own->parent_path());
            demo::writeViewerState(*own, viewer.state());
        } catch (const std::runtime_error& error) {
            std::fprintf(stderr, "shadow_demo: note: the state is not kept: %s\n", error.what());
        }
    }
}

void demonstrate(const Options& options) {
    if (options.listTechniques) return listTechniques();
    if (options.listScenes) return listScenes();
    if (options.replay) return replayTrace(*options.replay);
    if (options.frames && *options.frames < 1)
        throw std::invalid_argument("--frames is " + std::to_string(*options.frames) +
                                    ", must be at least 1");
    if (options.samples < 1 || options.samples > 8)
        throw std::invalid_argument("--samples is " + std::to_string(options.samples) +
                                    ", must be 1 to 8");
    if (options.sequence && !options.headless)
        throw std::invalid_argument("--sequence needs --headless");
    if (options.windowPicture && (options.headless || !options.frames))
        throw std::invalid_argument("--window-picture needs a window and --frames");
    if (options.edge < 16 || options.edge > 4096)
        throw std::invalid_argument("--edge is " + std::to_string(options.edge) +
                                    ", must be 16 to 4096");
    const std::optional<demo::ViewerState> kept = keptState(options);
    const demo::ViewerState state = stateOf(options, kept);
    try {
        show(options, kept, state);
    } catch (const std::exception&) {
        blameStateFile(options, state);
        throw;
    }
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
    app.add_option("--scene", options.scene,
                   "built-in scene (see --list-scenes) or model file (glTF, OBJ, PLY, ...); "
                   "SCENE:triangles=COUNT:cascades=COUNT:lamps=COUNT for one with more triangles, "
                   "several maps of the sun and more lamps; default: yard");
    app.add_option("--technique", options.technique,
                   "shadow technique (see --list-techniques); default: pcf_disc");
    app.add_option("--parameter", options.parameters,
                   "NAME=NUMBER, or NAME=auto where --list-techniques offers that: a parameter of "
                   "the technique; may be repeated");
    app.add_option("--resolution", options.resolution,
                   "map edge N in texels, or auto; default: auto");
    auto* radius = app.add_option("--radius", options.radiusM,
                                  "softness: radius of the blur in m; default: the scene's");
    app.add_option("--radius-uv", options.radiusUv, "the same as a fraction of the map's extent")
        ->excludes(radius);
    demo::addSlopeOptions(app, options.slope);
    app.add_option("--percentile", options.percentile,
                   "share of the shadows' edges whose demand the automatic size meets, 0.5 to "
                   "1; default: 0.98");
    app.add_option("--cross-fade", options.crossFade,
                   "frames over which a change of the automatic size is faded; default: 8");
    app.add_option("--budget-texels", options.budgetTexels,
                   "texels that the automatic sizes of all maps take together at most: lamps and "
                   "cascades share them so that the worst artifact is as small as it can be; "
                   "default: no budget");
    app.add_option("--view", options.view,
                   "picture, split, difference, demand, penumbra or texels; default: picture");
    app.add_option("--compare", options.compareWith,
                   "N of the other frame in split and difference; default: 4096");
    app.add_option("--view-map", options.viewMap,
                   "which of the frame's maps difference, demand, penumbra and texels are of, in "
                   "the order in which --stats names them, from 1; default: 1");
    app.add_option("--gain", options.gain, "of the difference, 1 to 64; default: 4");
    app.add_option("--split", options.split, "place of the line, 0 to 1; default: 0.5");
    app.add_option("--path", options.path, "what goes round: still, camera or sun");
    app.add_option("--state", options.state,
                   "JSON file: what the viewer shows, read at the start where it exists and "
                   "written at the end; other options go before it; default: none headless, in a "
                   "window stairwell/shadow_demo.json in XDG_STATE_HOME (~/.local/state)");
    app.add_option("--shaders", options.shaders,
                   "folder to read the shaders from, as renderer/shaders has them; L in the window "
                   "reads them again; default: those built in");
    app.add_flag("--headless", options.headless, "no window: render, measure, write, end");
    app.add_option("--frames", options.frames,
                   "headless: frames to time or to write (default 10); window: frames after which "
                   "to close");
    app.add_option("--width", options.width, "viewport width in px")->capture_default_str();
    app.add_option("--height", options.height, "viewport height in px")->capture_default_str();
    app.add_option("--screenshot", options.screenshot, "PNG file to write at the end");
    app.add_option("--window-picture", options.windowPicture,
                   "PNG file of the window with its panel, taken in the last of --frames");
    app.add_option("--sequence", options.sequence,
                   "headless: folder for --frames pictures of --path once round");
    app.add_option("--samples", options.samples, "samples along a pixel's edge in the screenshot")
        ->capture_default_str();
    app.add_option("--stats", options.stats, "JSON file to write at the end");
    app.add_option("--trace", options.trace,
                   "file for what the automatic sizes were chosen by, frame by frame, for a bug "
                   "report; --replay reads it");
    app.add_option("--replay", options.replay,
                   "trace whose decisions are made again; names the first that differs");
    app.add_option("--write-frames", options.writeFrames,
                   "folder for a study's frames of the scene, without a window: maps of many sizes "
                   "at one softness, each beside a converged one, and their manifest");
    app.add_option("--edge", options.edge, "of the frames of --write-frames in px")
        ->capture_default_str();
    app.add_flag("--list-techniques", options.listTechniques,
                 "prints each technique: name first, then what it is");
    app.add_flag("--list-scenes", options.listScenes,
                 "prints each scene: name first, then what it is");
    return program::run(app, argc, argv, [&] { demonstrate(options); });
}

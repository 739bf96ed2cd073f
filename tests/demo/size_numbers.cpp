// SPDX-License-Identifier: MIT
// Prints how the automatic size behaves over the scenes' paths, what it saves there and what the
// passes that choose it cost: docs/results/automatic-size.md. Without a scene: all of them.
//   size_numbers paths [SCENE]   no time is measured; any machine prints the same
//   size_numbers speed [SCENE]   wants a quiet machine, minutes for each scene
//   size_numbers cost [SCENE]    wants a quiet machine
//   size_numbers means < ROWS    of rows that `speed` printed, scene by scene
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <map>
#include <memory>
#include <numbers>
#include <numeric>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "demo/edge_ripple.h"
#include "demo/error_metrics.h"
#include "demo/map_places.h"
#include "demo/size_over_path.h"
#include "renderer/gl_context.h"
#include "renderer/scene.h"

namespace {

constexpr const char* kTechniques[] = {"pcf_disc", "pcss", "vsm"};
constexpr int kFadeFrames = 8;

/// Those that a command is for.
std::vector<renderer::SceneEntry> scenes(const char* onlyScene) {
    if (onlyScene != nullptr) return {renderer::findScene(onlyScene)};
    const auto all = renderer::builtInScenes();
    return {all.begin(), all.end()};
}

demo::ShadowRun::Settings automatic(const renderer::Renderer& frame, const char* technique) {
    demo::ShadowRun::Settings settings;
    settings.technique = &renderer::findTechnique(technique);
    settings.parameters = settings.technique->standardParameters();
    settings.radiusUv = demo::chooseSoftness(frame, {}, {}).radiusUv;
    return settings;
}

void printPaths(const renderer::GlInfo& info, const char* onlyScene) {
    constexpr int kFrames = 240;
    constexpr double kShare = 1.0 / 6;  // a path takes 24 s in the viewer, 60 frames a second
    std::printf(
        "%d frames of %.2f of each path at 320 x 180 px, a cross-fade of %d frames. jump: largest "
        "RMS change of\nvisibility from frame to frame while a change of size shows, over that of "
        "the maps before and after it,\nkept for the same two frames; over 2048: over that of the "
        "fixed 2048 map; between: the same in every 16th other\nframe, in which no size "
        "changes.\n\n"
        "| scene | technique | path | sizes | raises | lowerings | frames between lowerings | jump "
        "| without fade | over 2048 | between |\n|---|---|---|---|---|---|---|---|---|---|---|\n",
        kFrames, kShare, kFadeFrames);
    for (const renderer::SceneEntry& scene : scenes(onlyScene)) {
        for (const char* technique : kTechniques)
            for (const demo::Path path : {demo::Path::camera, demo::Path::sun}) {
                const auto walked = [&](int fadeFrames) {
                    renderer::Renderer frame(info, renderer::makeScene(scene.name), 320, 180);
                    demo::PathSettings settings{.run = automatic(frame, technique),
                                                .path = path,
                                                .frames = kFrames,
                                                .share = kShare};
                    settings.run.sizing.crossFadeFrames = fadeFrames;
                    return demo::sizeOverPath(frame, info, settings);
                };
                const demo::SizeOverPath faded = walked(kFadeFrames);
                const bool changed = faded.raises + faded.lowerings > 0;
                const double hard = changed ? walked(0).worstJumpOverOwn : 0;
                const auto [least, most] =
                    std::minmax_element(faded.sizes.begin(), faded.sizes.end());
                std::printf(
                    "| %s | %s | %s | %d to %d | %d | %d | %s | %.2f | %.2f | %.2f | %.2f |\n",
                    std::string(scene.name).c_str(), technique,
                    path == demo::Path::camera ? "camera" : "sun", *least, *most, faded.raises,
                    faded.lowerings,
                    faded.leastFramesBetweenLowerings == 0
                        ? "-"
                        : std::to_string(faded.leastFramesBetweenLowerings).c_str(),
                    faded.worstJumpOverOwn, hard, faded.worstJump, faded.worstBetween);
                std::fflush(stdout);
            }
    }
}

/// One size of a frame, measured in turn with the others.
struct Timed {
    std::unique_ptr<renderer::Renderer> frame;
    std::unique_ptr<demo::ShadowRun> run;
    std::vector<double> ms;

    Timed(const renderer::GlInfo& info, const renderer::Scene& scene, const char* technique,
          demo::ResolutionOption resolution)
        : frame(std::make_unique<renderer::Renderer>(info, scene, 640, 360)) {
        demo::ShadowRun::Settings settings = automatic(*frame, technique);
        settings.resolution = resolution;
        run = std::make_unique<demo::ShadowRun>(*frame, info, settings);
        run->settle();
    }
    double medianMs() const { return demo::spreadOf(ms).median; }
};

void printSpeed(const renderer::GlInfo& info, const char* onlyScene) {
    constexpr double kPlace = 0.3;  // how far along each path; by no criterion
    constexpr int kRounds = 5, kLeastRounds = 2;
    constexpr double kMostSeconds = 20;  // of a row's rounds
    std::printf(
        "640 x 360 px, whole frames of the automatic size and of two fixed ones in turn, medians "
        "of up to %d; %.1f of the way\nalong each path. Errors of the automatic size against "
        "4096.\n\n| scene | technique | path | N | auto, ms | 2048, ms | 4096, ms | x of 4096 | x "
        "of 2048 | RMSE | ripple p95 | ripple most |\n|---|---|---|---|---|---|---|---|---|---|---|"
        "---|\n",
        kRounds, kPlace);
    for (const renderer::SceneEntry& entry : scenes(onlyScene)) {
        renderer::Scene scene = renderer::makeScene(entry.name);
        if (!scene.lamps.empty()) continue;  // errors and ripple are the sun's
        const renderer::OrbitCamera camera = scene.camera;
        const renderer::Sun sun = scene.sun;
        for (const char* technique : kTechniques)
            for (const bool cameraMoves : {true, false}) {
                scene.camera =
                    cameraMoves ? renderer::along(scene.cameraPath, camera, kPlace) : camera;
                scene.sun = cameraMoves ? sun : renderer::along(scene.sunPath, sun, kPlace);
                std::vector<Timed> sizes;
                for (const demo::ResolutionOption& n :
                     {demo::ResolutionOption(), demo::ResolutionOption(2048),
                      demo::ResolutionOption(4096)})
                    sizes.emplace_back(info, scene, technique, n);
                const auto start = std::chrono::steady_clock::now();
                for (int round = 0; round < kRounds; ++round) {
                    const std::chrono::duration<double> spent =
                        std::chrono::steady_clock::now() - start;
                    if (round >= kLeastRounds && spent.count() > kMostSeconds) break;
                    for (Timed& size : sizes)
                        size.ms.push_back(size.run->timeWholeFrames(1).median);
                }
                const auto shown = sizes[0].frame->readVisibility();
                const auto truth = sizes[2].frame->readVisibility();
                const int n = sizes[0].run->chosen().resolution;
                const demo::EdgeRipple ripple = demo::summarised(
                    demo::edgeRipples(shown, truth, demo::mapPlaces(*sizes[2].frame), n));
                const double ms = sizes[0].medianMs();
                std::printf(
                    "| %s | %s | %s | %d | %.1f | %.1f | %.1f | %.2f | %.2f | %.4f | %.3f | %.3f "
                    "|\n",
                    std::string(entry.name).c_str(), technique, cameraMoves ? "camera" : "sun", n,
                    ms, sizes[1].medianMs(), sizes[2].medianMs(), sizes[2].medianMs() / ms,
                    sizes[1].medianMs() / ms, demo::compareVisibility(shown, truth).rmse,
                    ripple.p95, ripple.most);
                std::fflush(stdout);
            }
    }
}

int printMeans(std::istream& rows) {
    struct Means {
        int count = 0;
        double logOf4096 = 0, logOf2048 = 0, rmse = 0, rippleP95 = 0, rippleMost = 0;
    };
    std::map<std::string, Means> means;
    for (std::string line; std::getline(rows, line);) {
        std::istringstream cells(line);
        std::vector<std::string> row;
        for (std::string cell; std::getline(cells, cell, '|');) row.push_back(cell);
        if (row.size() < 13 || row[4].find_first_of("0123456789") == std::string::npos) continue;
        Means& own = means[row[2]];
        ++own.count;
        own.logOf4096 += std::log(std::stod(row[8]));
        own.logOf2048 += std::log(std::stod(row[9]));
        own.rmse = std::max(own.rmse, std::stod(row[10]));
        own.rippleP95 = std::max(own.rippleP95, std::stod(row[11]));
        own.rippleMost = std::max(own.rippleMost, std::stod(row[12]));
    }
    if (means.empty()) {
        std::fprintf(stderr, "size_numbers means: standard input has no row of `speed`\n");
        return 1;
    }
    std::printf(
        "| technique | rows | x of 4096 | x of 2048 | largest RMSE | largest ripple p95 | largest "
        "ripple |\n|---|---|---|---|---|---|---|\n");
    for (const auto& [technique, own] : means)
        std::printf("|%s| %d | %.2f | %.2f | %.4f | %.3f | %.3f |\n", technique.c_str(), own.count,
                    std::exp(own.logOf4096 / own.count), std::exp(own.logOf2048 / own.count),
                    own.rmse, own.rippleP95, own.rippleMost);
    std::printf("Ripple may be 1.05 x 2 / (pi c) = %.3f at most, at c = 3.47.\n",
                1.05 * 2 / (std::numbers::pi * 3.47));
    return 0;
}

void printCost(const renderer::GlInfo& info, const char* onlyScene) {
    constexpr int kFrames = 32;  // several turns of the detail probe
    std::printf(
        "1280 x 720 px, %d frames, means: the detail probe works in every eighth frame. Passes by "
        "%s.\n\n| scene | technique | N | demand pass and read-back, ms | frame, ms | share |\n"
        "|---|---|---|---|---|---|\n",
        kFrames, std::string(renderer::PassClock(info).method()).c_str());
    for (const renderer::SceneEntry& scene : scenes(onlyScene))
        for (const char* technique : {"pcf_disc", "pcss"}) {
            renderer::Renderer frame(info, renderer::makeScene(scene.name), 1280, 720);
            demo::ShadowRun run(frame, info, automatic(frame, technique));
            run.settle();
            double demand = 0, all = 0;
            for (int i = 0; i < kFrames; ++i) {
                const auto passes = run.timePasses(1).passes;
                for (const demo::Spread& pass : passes) all += pass.median;
                demand += passes[static_cast<std::size_t>(renderer::Pass::demand)].median;
            }
            std::printf("| %s | %s | %d | %.2f | %.1f | %.1f %% |\n",
                        std::string(scene.name).c_str(), technique, run.chosen().resolution,
                        demand / kFrames, all / kFrames, 100 * demand / all);
            std::fflush(stdout);
        }
}

}  // namespace

int main(int argc, char** argv) {
    const std::string what = argc > 1 ? argv[1] : "";
    const char* scene = argc > 2 ? argv[2] : nullptr;
    if (what == "means") return printMeans(std::cin);
    if (what != "paths" && what != "speed" && what != "cost") {
        std::fprintf(stderr,
                     "usage: size_numbers paths [SCENE] | speed [SCENE] | cost [SCENE] | means\n");
        return 2;
    }
    try {
        const renderer::HeadlessContext context;
        if (what == "paths") printPaths(context.info(), scene);
        if (what == "speed") printSpeed(context.info(), scene);
        if (what == "cost") printCost(context.info(), scene);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "size_numbers: %s\n", error.what());
        return 1;
    }
    return 0;
}

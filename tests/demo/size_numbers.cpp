// SPDX-License-Identifier: MIT
// Prints how the automatic size behaves over the scenes' paths and what the passes that choose it
// cost: docs/results/automatic-size.md. Without a scene: all of them.
//   size_numbers paths [SCENE]   no time is measured; any machine prints the same
//   size_numbers cost [SCENE]    wants a quiet machine
#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

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

/// Smallest and largest, where a frame has several maps.
std::string sizesOf(const demo::ShadowRun& run) {
    const auto [least, most] =
        std::ranges::minmax(run.maps(), {}, &demo::ChosenResolution::resolution);
    const std::string smallest = std::to_string(least.resolution);
    return run.maps().size() == 1 ? smallest : smallest + " to " + std::to_string(most.resolution);
}

void printCost(const renderer::GlInfo& info, const char* onlyScene) {
    constexpr int kFrames = 32;  // several turns of the detail probe
    std::printf(
        "1280 x 720 px, %d frames, means: the detail probe works in every tenth frame. Passes by "
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
            std::printf("| %s | %s | %s | %.2f | %.1f | %.1f %% |\n",
                        std::string(scene.name).c_str(), technique, sizesOf(run).c_str(),
                        demand / kFrames, all / kFrames, 100 * demand / all);
            std::fflush(stdout);
        }
}

}  // namespace

int main(int argc, char** argv) {
    const std::string what = argc > 1 ? argv[1] : "";
    const char* scene = argc > 2 ? argv[2] : nullptr;
    if (what != "paths" && what != "cost") {
        std::fprintf(stderr, "usage: size_numbers paths [SCENE] | cost [SCENE]\n");
        return 2;
    }
    try {
        const renderer::HeadlessContext context;
        if (what == "paths") printPaths(context.info(), scene);
        if (what == "cost") printCost(context.info(), scene);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "size_numbers: %s\n", error.what());
        return 1;
    }
    return 0;
}

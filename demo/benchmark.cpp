// SPDX-License-Identifier: MIT
#include "demo/benchmark.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <stdexcept>

#include "program/progress.h"

namespace demo {
namespace {

// A detail of the picture in its own proportions, large enough to show a few stair-steps.
constexpr int kDetailShare = 6;
constexpr int kPictureSamples = 2;
constexpr int kLeastRounds = 3;

/// A cell with a renderer of its own: switching one renderer between sizes would time the
/// allocation of maps.
struct Running {
    std::unique_ptr<renderer::Renderer> frame;
    std::unique_ptr<ShadowRun> run;
    std::vector<double> frameMs;
    std::array<std::vector<double>, renderer::kPasses> passMs;
    double seconds = 0;
};

double secondsSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void visit(Running& cell) {
    const auto start = std::chrono::steady_clock::now();
    cell.frameMs.push_back(cell.run->timeWholeFrames(1).median);
    const ShadowRun::PassSpreads passes = cell.run->timePasses(1);
    for (std::size_t pass = 0; pass < renderer::kPasses; ++pass)
        if (passes.passes[pass].count > 0) cell.passMs[pass].push_back(passes.passes[pass].median);
    cell.seconds += secondsSince(start);
}

void measureErrors(BenchmarkGroup& group) {
    const BenchmarkCell& reference = group.reference();
    const auto smallest = std::min_element(
        group.cells.begin(), group.cells.end(),
        [](const auto& a, const auto& b) { return a.chosen.resolution < b.chosen.resolution; });
    for (BenchmarkCell& cell : group.cells) {
        cell.isReference = &cell == &reference;
        cell.error = compareVisibility(cell.visibility, reference.visibility);
    }
    group.detail = worstPart(smallest->visibility, reference.visibility,
                             reference.visibility.width / kDetailShare,
                             reference.visibility.height / kDetailShare);
}

BenchmarkGroup runGroup(const renderer::GlInfo& info, const BenchmarkSettings& settings,
                        const renderer::Scene& scene, const renderer::Technique& technique,
                        program::Progress& progress) {
    BenchmarkGroup group;
    group.scene = scene.name;
    group.technique = &technique;
    std::vector<Running> running;
    for (const ResolutionOption& resolution : settings.resolutions) {
        Running cell;
        cell.frame =
            std::make_unique<renderer::Renderer>(info, scene, settings.widthPx, settings.heightPx);
        group.softness = chooseSoftness(*cell.frame, std::nullopt, std::nullopt);
        cell.run = std::make_unique<ShadowRun>(
            *cell.frame, info,
            ShadowRun::Settings{.technique = &technique,
                                .parameters = technique.standardParameters(),
                                .radiusUv = group.softness.radiusUv,
                                .resolution = resolution,
                                .slope = settings.slope.slope});
        cell.run->settle();
        running.push_back(std::move(cell));
    }
    for (int round = 0; round < settings.rounds; ++round)
        for (Running& cell : running) {
            if (round < kLeastRounds || cell.seconds < settings.mostSecondsPerCell) visit(cell);
            progress.advance();
        }
    for (Running& cell : running) {
        BenchmarkCell result;
        result.technique = &technique;
        result.scene = scene.name;
        result.softness = group.softness;
        result.chosen = cell.run->chosen();
        result.frameMs = spreadOf(cell.frameMs);
        for (std::size_t pass = 0; pass < renderer::kPasses; ++pass)
            result.passesMs.passes[pass] = spreadOf(cell.passMs[pass]);
        result.mapBytes = cell.frame->mapBytes();
        result.visibility = cell.frame->readVisibility();
        result.picture = cell.run->picture(kPictureSamples);
        group.cells.push_back(std::move(result));
        progress.advance();
    }
    group.mapExtentM = running.front().frame->window().extentM;
    group.triangles = running.front().frame->triangles();
    measureErrors(group);
    return group;
}

std::vector<const renderer::Technique*> chosenTechniques(const BenchmarkSettings& settings) {
    std::vector<const renderer::Technique*> chosen;
    for (const std::string& name : settings.techniques)
        chosen.push_back(&renderer::findTechnique(name));
    if (settings.techniques.empty())
        for (const renderer::Technique& technique : renderer::techniques())
            if (technique.soft) chosen.push_back(&technique);
    return chosen;
}

std::vector<renderer::Scene> chosenScenes(const BenchmarkSettings& settings) {
    std::vector<renderer::Scene> chosen;
    for (const std::string& name : settings.scenes) chosen.push_back(renderer::makeScene(name));
    if (settings.scenes.empty())
        for (const renderer::SceneEntry& entry : renderer::builtInScenes())
            chosen.push_back(entry.make());
    return chosen;
}

}  // namespace

const BenchmarkCell& BenchmarkGroup::reference() const {
    const BenchmarkCell* largest = nullptr;
    for (const BenchmarkCell& cell : cells)
        if (!cell.chosen.automatic &&
            (largest == nullptr || cell.chosen.resolution > largest->chosen.resolution))
            largest = &cell;
    if (largest == nullptr) throw std::logic_error("benchmark group without a fixed size");
    return *largest;
}

const BenchmarkCell* BenchmarkGroup::automatic() const {
    const auto found = std::find_if(cells.begin(), cells.end(), [](const BenchmarkCell& cell) {
        return cell.chosen.automatic;
    });
    return found == cells.end() ? nullptr : &*found;
}

BenchmarkResult runBenchmark(const renderer::GlInfo& info, const BenchmarkSettings& settings) {
    if (settings.rounds < 1)
        throw std::invalid_argument("rounds is " + std::to_string(settings.rounds) +
                                    ", must be at least 1");
    if (std::all_of(settings.resolutions.begin(), settings.resolutions.end(),
                    [](const ResolutionOption& resolution) { return !resolution; }))
        throw std::invalid_argument(
            "no fixed size was asked for; errors are measured against the largest one");
    const auto techniques = chosenTechniques(settings);
    const auto scenes = chosenScenes(settings);
    const std::size_t perGroup =
        settings.resolutions.size() * static_cast<std::size_t>(settings.rounds + 1);
    program::Progress progress("measuring", perGroup * scenes.size() * techniques.size());

    BenchmarkResult result;
    result.timing = std::string(renderer::PassClock(info).method());
    for (const renderer::Technique* technique : techniques)
        for (const renderer::Scene& scene : scenes)
            result.groups.push_back(runGroup(info, settings, scene, *technique, progress));
    return result;
}

std::vector<Headline> headlines(const BenchmarkResult& result) {
    std::vector<Headline> all;
    std::vector<const renderer::Technique*> done;
    for (const BenchmarkGroup& first : result.groups) {
        if (std::find(done.begin(), done.end(), first.technique) != done.end()) continue;
        done.push_back(first.technique);
        double logRatio = 0;
        double worstRmse = 0;
        int scenes = 0;
        std::string sizes;
        for (const BenchmarkGroup& group : result.groups) {
            const BenchmarkCell* automatic = group.automatic();
            if (group.technique != first.technique || automatic == nullptr) continue;
            logRatio += std::log(group.reference().frameMs.median / automatic->frameMs.median);
            worstRmse = std::max(worstRmse, automatic->error.rmse);
            ++scenes;
            sizes += (sizes.empty() ? "" : ", ") + std::to_string(automatic->chosen.resolution) +
                     " in " + group.scene;
        }
        if (scenes == 0) continue;
        const double ratio = std::exp(logRatio / scenes);
        char number[64];
        char error[64];
        std::snprintf(number, sizeof number, "%.1fx %s", ratio >= 1 ? ratio : 1 / ratio,
                      ratio >= 1 ? "faster" : "slower");
        std::snprintf(error, sizeof error, "%.4f", worstRmse);
        all.push_back({number, "whole frame, automatic size against the fixed " +
                                   std::to_string(first.reference().chosen.resolution) +
                                   " map at the same softness (" +
                                   std::string(first.technique->title) + "; automatic N " + sizes +
                                   "; geometric mean over " + std::to_string(scenes) +
                                   (scenes == 1 ? " scene" : " scenes") +
                                   "), with a resolution error of at most " + error +
                                   " RMSE in visibility over penumbra pixels"});
    }
    return all;
}

}  // namespace demo

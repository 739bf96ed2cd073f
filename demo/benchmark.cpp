// SPDX-License-Identifier: MIT
#include "demo/benchmark.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <stdexcept>

#include "program/progress.h"
#include "renderer/scene_file.h"

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
    for (const std::string& name : settings.scenes) {
        chosen.push_back(renderer::openScene(name));
        for (const std::string& note : chosen.back().notes)
            std::fprintf(stderr, "shadow_bench: note: %s\n", note.c_str());
    }
    if (settings.scenes.empty())
        for (const renderer::SceneEntry& entry : renderer::builtInScenes()) {
            // Errors are those of the sun's shadows, so lamps would only be paid for.
            renderer::Scene scene = renderer::makeScene(entry.name);
            if (scene.lamps.empty()) chosen.push_back(std::move(scene));
        }
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

namespace {

/// Geometric mean over a technique's scenes of (time of a fixed size) / (time of the automatic
/// one); 0 without both.
double speedAgainst(const BenchmarkResult& result, const renderer::Technique* technique,
                    int resolution) {
    double sum = 0;
    int scenes = 0;
    for (const BenchmarkGroup& group : result.groups)
        for (const BenchmarkCell& cell : group.cells) {
            if (group.technique != technique || cell.chosen.automatic ||
                cell.chosen.resolution != resolution)
                continue;
            const BenchmarkCell* automatic = group.automatic();
            if (automatic == nullptr) continue;
            sum += std::log(cell.frameMs.median / automatic->frameMs.median);
            ++scenes;
        }
    return scenes == 0 ? 0 : std::exp(sum / scenes);
}

std::string formatted(const char* format, double value) {
    char text[48];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

Headline headlineOf(const BenchmarkResult& result, const BenchmarkGroup& first) {
    double worstRmse = 0;
    std::string sizes, finer;
    std::size_t scenes = 0;
    for (const BenchmarkGroup& group : result.groups) {
        const BenchmarkCell* automatic = group.automatic();
        if (group.technique != first.technique || automatic == nullptr) continue;
        ++scenes;
        // Against a coarser reference a finer map is not wrong by what the two differ in.
        if (automatic->chosen.resolution > group.reference().chosen.resolution)
            finer += (finer.empty() ? ", but for maps finer than that one: " : ", ") + group.scene;
        else
            worstRmse = std::max(worstRmse, automatic->error.rmse);
        sizes += (sizes.empty() ? "" : ", ") + std::to_string(automatic->chosen.resolution) +
                 " in " + group.scene;
    }
    std::string others;
    for (const BenchmarkCell& cell : first.cells)
        if (!cell.chosen.automatic && &cell != &first.reference())
            others +=
                (others.empty() ? "; " : ", ") +
                formatted("%.1fx", speedAgainst(result, first.technique, cell.chosen.resolution)) +
                " against " + std::to_string(cell.chosen.resolution);
    const int reference = first.reference().chosen.resolution;
    const double speed = speedAgainst(result, first.technique, reference);
    return {formatted("%.1fx", speed) + " the speed",
            "of the fixed " + std::to_string(reference) +
                " map, whole frame at the same softness, by automatic size (" +
                std::string(first.technique->title) + "; N = " + sizes +
                (scenes > 1 ? "; geometric mean over " + std::to_string(scenes) + " scenes" : "") +
                others + "), with a resolution error of at most " + formatted("%.4f", worstRmse) +
                " RMSE in visibility over penumbra pixels" + finer};
}

}  // namespace

std::vector<Headline> headlines(const BenchmarkResult& result) {
    std::vector<Headline> all;
    std::vector<const renderer::Technique*> done;
    for (const BenchmarkGroup& group : result.groups) {
        if (group.automatic() == nullptr ||
            std::find(done.begin(), done.end(), group.technique) != done.end())
            continue;
        done.push_back(group.technique);
        all.push_back(headlineOf(result, group));
    }
    return all;
}

}  // namespace demo

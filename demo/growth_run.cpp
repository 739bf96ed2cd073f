// SPDX-License-Identifier: MIT
#include "demo/growth_run.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>
#include <tuple>

#include "demo/shadow_run.h"
#include "demo/tsv_journal.h"
#include "program/progress.h"
#include "renderer/renderer.h"
#include "renderer/scene.h"

namespace demo {
namespace {

constexpr const char* kJournal = "growth_times.tsv";
// Of the map, where it is not what grows.
constexpr int kMapSize = 1024;
constexpr int kMapSizes[] = {512, 728, 1024, 1456, 2048, 2904};
constexpr int kTaps[] = {8, 16, 24, 32, 48, 64};
constexpr int kTriangles[] = {4'000, 16'000, 64'000, 256'000, 1'000'000};
// The sun, and spots around it; of smaller maps, since there are as many.
constexpr int kLights[] = {1, 2, 4, 8, 16, 32, 64};
constexpr int kMapSizeOfLights = 256;
// A quarter to two million pixels, 16 : 9.
constexpr int kWidths[] = {688, 960, 1280, 1600, 1920};

struct Visit {
    GrowthAxis axis = GrowthAxis::mapSize;
    const renderer::Technique* technique = nullptr;
    int value = 0;  // as asked for; what it came to is in the journal
};

std::vector<Visit> visitsOf(const GrowthSettings& settings) {
    std::vector<Visit> visits;
    const auto add = [&](GrowthAxis axis, auto& values, int reduction) {
        // Values outside, since a change of triangles or of the viewport is what takes time.
        for (const int value : values)
            for (const renderer::Technique* technique : settings.techniques)
                if (axis != GrowthAxis::taps || technique->parameterSlot("taps"))
                    visits.push_back({axis, technique, std::max(1, value / reduction)});
    };
    add(GrowthAxis::mapSize, kMapSizes, settings.reduction);
    add(GrowthAxis::taps, kTaps, 1);
    add(GrowthAxis::triangles, kTriangles, settings.reduction);
    add(GrowthAxis::lights, kLights, 1);
    add(GrowthAxis::pixels, kWidths, settings.reduction);
    return visits;
}

using Key = std::tuple<std::string, std::string, std::string, std::string>;
Key keyOf(const std::string& axis, const std::string& technique, const std::string& value,
          const std::string& round) {
    return {axis, technique, value, round};
}

/// The scene with as many triangles as were asked for, or with its own.
std::string sourceOf(const GrowthSettings& settings, std::size_t own, const Visit& visit) {
    const auto asked = static_cast<std::size_t>(visit.value);
    if (visit.axis != GrowthAxis::triangles || asked <= own) return settings.scene;
    return settings.scene + ":triangles=" + std::to_string(asked);
}

class GrowthRun {
  public:
    GrowthRun(const renderer::GlInfo& info, const GrowthSettings& settings,
              const records::RunContext& context)
        : info_(info),
          settings_(settings),
          own_(renderer::casterTriangles(renderer::makeScene(settings.scene))),
          journal_(settings.folder / kJournal, kGrowthColumns, records::contextText(context)) {
        for (const TsvRow& row : journal_.table().rows())
            done_.insert(keyOf(row.text("axis"), row.text("technique"), row.text("value"),
                               row.text("round")));
    }

    void run() {
        const std::vector<Visit> visits = visitsOf(settings_);
        program::Progress progress("growth",
                                   visits.size() * static_cast<std::size_t>(settings_.rounds));
        for (int round = 0; round < settings_.rounds; ++round)
            for (const Visit& visit : visits) {
                make(visit, round);
                progress.advance();
            }
    }

  private:
    /// The renderer with the visit's scene and viewport.
    renderer::Renderer& show(const Visit& visit) {
        const std::string source = sourceOf(settings_, own_, visit);
        const int width = visit.axis == GrowthAxis::pixels ? visit.value : settings_.widthPx;
        const int height =
            visit.axis == GrowthAxis::pixels ? visit.value * 9 / 16 : settings_.heightPx;
        if (!frame_) {
            frame_ = std::make_unique<renderer::Renderer>(info_, renderer::makeScene(source), width,
                                                          height);
            frame_->setWindowFit(renderer::WindowFit::casters);
        } else if (frame_->scene().source != source) {
            frame_->setScene(renderer::makeScene(source));
        }
        if (frame_->widthPx() != width || frame_->heightPx() != height)
            frame_->resize(width, height);
        const std::size_t lamps =
            visit.axis == GrowthAxis::lights ? static_cast<std::size_t>(visit.value) - 1 : 0;
        if (frame_->lights() != lamps + 1)
            frame_->setLamps(renderer::ringOfSpots(lamps, frame_->scene().casters));
        return *frame_;
    }

    std::string valueOf(const Visit& visit, const renderer::Renderer& frame) const {
        if (visit.axis == GrowthAxis::pixels)
            return std::to_string(frame.widthPx() * frame.heightPx());
        if (visit.axis == GrowthAxis::triangles)
            return std::to_string(renderer::casterTriangles(frame.scene()));
        return std::to_string(visit.value);
    }

    int mapSizeOf(const Visit& visit) const {
        if (visit.axis == GrowthAxis::mapSize) return visit.value;
        const int size = visit.axis == GrowthAxis::lights ? kMapSizeOfLights : kMapSize;
        return std::max(1, size / settings_.reduction);
    }

    void make(const Visit& visit, int round) {
        renderer::Renderer& frame = show(visit);
        const std::vector<std::string> head = {std::string(toText(visit.axis)), settings_.scene,
                                               std::string(visit.technique->name),
                                               valueOf(visit, frame), std::to_string(round)};
        if (done_.contains(keyOf(head[0], head[2], head[3], head[4]))) return;
        ShadowRun::Settings settings{
            .technique = visit.technique,
            .parameters = visit.technique->standardParameters(),
            .radiusUv = chooseSoftness(frame, std::nullopt, std::nullopt).radiusUv,
            .resolution = mapSizeOf(visit),
            .slope = {}};
        if (visit.axis == GrowthAxis::taps)
            renderer::setParameter(*visit.technique, settings.parameters, "taps",
                                   static_cast<float>(visit.value));
        ShadowRun run(frame, info_, settings);
        run.step();  // compiles and makes the maps
        const Spread whole = run.timeWholeFrames(1);
        const ShadowRun::PassSpreads passes = run.timePasses(1);
        std::vector<std::string> row = head;
        row.push_back(tsvNumber(whole.median));
        for (const renderer::Pass pass :
             {renderer::Pass::depth, renderer::Pass::prefilter, renderer::Pass::prepass,
              renderer::Pass::lookup, renderer::Pass::lit}) {
            const Spread& spread = passes.passes[static_cast<std::size_t>(pass)];
            row.push_back(spread.count > 0 ? tsvNumber(spread.median) : "n/a");
        }
        journal_.add(row);
        done_.insert(keyOf(head[0], head[2], head[3], head[4]));
    }

    const renderer::GlInfo& info_;
    const GrowthSettings& settings_;
    std::size_t own_;  // triangles of the scene
    TsvJournal journal_;
    std::set<Key> done_;
    std::unique_ptr<renderer::Renderer> frame_;
};

}  // namespace

std::string_view toText(GrowthAxis axis) {
    switch (axis) {
        case GrowthAxis::mapSize:
            return "N";
        case GrowthAxis::taps:
            return "taps";
        case GrowthAxis::triangles:
            return "triangles";
        case GrowthAxis::lights:
            return "lights";
        case GrowthAxis::pixels:
            return "pixels";
    }
    return "";
}

void GrowthSettings::validate() const {
    if (rounds < 1)
        throw std::invalid_argument("rounds is " + std::to_string(rounds) + ", must be at least 1");
    if (techniques.empty()) throw std::invalid_argument("techniques must not be empty");
    if (reduction < 1)
        throw std::invalid_argument("reduction is " + std::to_string(reduction) +
                                    ", must be at least 1");
    renderer::findScene(scene);
    if (scene.find(':') != std::string::npos)
        throw std::invalid_argument("scene is \"" + scene +
                                    "\", must have its own triangles: they are what grows");
    const std::size_t own = renderer::casterTriangles(renderer::makeScene(scene));
    if (!renderer::makeScene(scene).lamps.empty())
        throw std::invalid_argument("scene \"" + scene + "\" has lamps, must have none: they grow");
    if (own > static_cast<std::size_t>(kTriangles[0]))
        throw std::invalid_argument("scene \"" + scene + "\" has " + std::to_string(own) +
                                    " triangles, must have at most " +
                                    std::to_string(kTriangles[0]) + ": they are split");
}

void measureGrowth(const renderer::GlInfo& info, const GrowthSettings& settings,
                   const records::RunContext& context) {
    settings.validate();
    GrowthRun(info, settings, context).run();
}

bool hasGrowth(const std::filesystem::path& folder) {
    return std::filesystem::exists(folder / kJournal);
}

std::vector<Growth> readGrowth(const std::filesystem::path& folder) {
    const TsvTable table = readTsv(folder / kJournal);
    std::vector<Growth> all;
    std::vector<std::map<double, std::vector<double>>> times;
    for (const TsvRow& row : table.rows())
        for (const char* pass : {"frame_ms", "depth_ms", "prefilter_ms", "lookup_ms", "lit_ms"}) {
            const double ms = row.number(pass);
            if (std::isnan(ms)) continue;
            const auto found = std::find_if(all.begin(), all.end(), [&](const Growth& growth) {
                return growth.axis == row.text("axis") && growth.scene == row.text("scene") &&
                       growth.technique == row.text("technique") && growth.pass == pass;
            });
            const auto index = static_cast<std::size_t>(found - all.begin());
            if (found == all.end()) {
                all.push_back(
                    {row.text("axis"), row.text("scene"), row.text("technique"), pass, {}, {}});
                times.emplace_back();
            }
            times[index][row.number("value")].push_back(ms);
        }
    for (std::size_t i = 0; i < all.size(); ++i) {
        for (const auto& [value, ms] : times[i])
            all[i].medians.emplace_back(value, spreadOf(ms).median);
        all[i].exponent = growthExponent(all[i].medians);
    }
    return all;
}

std::string growthTable(const std::vector<Growth>& all) {
    TsvTable table("growth_fits", {"axis", "scene", "technique", "pass", "from", "to", "ms_from",
                                   "ms_to", "exponent", "ci95_low", "ci95_high", "off_by"});
    for (const Growth& growth : all) {
        const auto& [from, msFrom] = growth.medians.front();
        const auto& [to, msTo] = growth.medians.back();
        const GrowthExponent& fit = growth.exponent;
        const bool fitted = fit.points > 0;
        table.add({growth.axis, growth.scene, growth.technique, growth.pass, tsvNumber(from),
                   tsvNumber(to), tsvNumber(msFrom), tsvNumber(msTo),
                   fitted ? tsvNumber(fit.exponent) : "n/a",
                   fitted ? tsvNumber(fit.exponent - fit.halfWidth95) : "n/a",
                   fitted ? tsvNumber(fit.exponent + fit.halfWidth95) : "n/a",
                   fitted ? tsvNumber(fit.residual) : "n/a"});
    }
    return table.toText();
}

}  // namespace demo

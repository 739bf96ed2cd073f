// SPDX-License-Identifier: MIT
#include "demo/sweep.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>
#include <stdexcept>

#include "demo/edge_ripple.h"
#include "demo/edge_width.h"
#include "demo/error_metrics.h"
#include "demo/frame_facts.h"
#include "demo/map_places.h"
#include "demo/ripple_counts.h"
#include "demo/shadow_run.h"
#include "demo/sizing_policy.h"
#include "demo/sweep_context.h"
#include "demo/swept_view.h"
#include "demo/thin_detail.h"
#include "demo/tsv_journal.h"
#include "program/progress.h"
#include "renderer/renderer.h"

namespace demo {
namespace {

constexpr int kMostViewportPx = 16384;

// After this long, a cell that has been visited twice is visited no more.
constexpr double kMostCellMs = 6000;
// The time of a frame at the next size, at least and at most, as a factor: between no growth and
// N^3 for steps of sqrt 2.
constexpr double kLeastGrowth = 1, kMostGrowth = 2.9;
// A shadow moves by this much of a map's texel at N = 1024 and less at smaller ones; chosen so that
// it is under a texel in all built-in scenes.
constexpr float kLightStepDeg = 0.05F;
constexpr float kOrbitStepDeg = 1;

struct Unit {
    std::string source;
    double softness = 1;  ///< times the scene's own
    int frame = 0;
    const SweptTechnique* technique = nullptr;

    std::vector<std::string> key() const {
        return {sweptScene(source, softness), std::to_string(frame), technique->name};
    }
};

std::string joined(const std::vector<std::string>& parts) {
    std::string text;
    for (const std::string& part : parts) text += part + "\t";
    return text;
}

std::string keyOf(const TsvRow& row, const std::vector<std::string>& columns) {
    std::string text;
    for (const std::string& column : columns) text += row.text(column) + "\t";
    return text;
}

/// What one size of a unit gave in its first visit.
struct Measured {
    int resolution = 0;
    std::string status = "ok";
    double frameMs = NAN;
    ShadowRun::PassSpreads passes;
    std::size_t mapBytes = 0;
    renderer::FloatImage visibility;
    renderer::FloatImage lightMoved, orbited;
};

class Sweep {
  public:
    Sweep(const renderer::GlInfo& info, const SweepSettings& settings,
          const records::RunContext& context)
        : info_(info),
          settings_(settings),
          times_(fileOf("sweep_times"), kSweepTimeColumns, contextOf(context)),
          errors_(fileOf("sweep_errors"), kSweepErrorColumns, contextOf(context)),
          policies_(fileOf("sweep_policies"), kSweepPolicyColumns, contextOf(context)),
          view_(info, settings.widthPx, settings.heightPx, settings.frames) {
        for (const TsvJournal* journal : {&times_, &errors_, &policies_})
            if (journal->table().context().find(settings.plan()) == std::string::npos)
                throw std::runtime_error(settings.folder.string() +
                                         ": holds a sweep of another plan than \"" +
                                         settings.plan() + "\"; name another folder");
        // Part of the numbers will be those of before, and the report's context too.
        for (const std::string& difference :
             contextDifferences(times_.table().context(), contextOf(context),
                                {"revision", "build", "GL", "driver"}))
            std::fprintf(stderr, "shadow_bench: notice: the sweep goes on from another run: %s\n",
                         difference.c_str());
    }

    void run() {
        const std::vector<Unit> units = shardOfUnits();
        const std::set<std::string> measured = measuredUnits(), asked = askedUnits();
        program::Progress progress("sweeping",
                                   units.size() * static_cast<std::size_t>(settings_.rounds));
        for (int round = 0; round < settings_.rounds; ++round)
            for (const Unit& unit : units) {
                const std::string key = joined(unit.key());
                if (round > 0)
                    revisit(unit, round);
                else if (!measured.contains(key))
                    measure(unit);
                else if (!asked.contains(key))
                    askPolicies(unit);
                progress.advance();
            }
    }

  private:
    std::filesystem::path fileOf(const std::string& name) const {
        const Shard shard = settings_.shard;
        const std::string part = shard.count == 1 ? ""
                                                  : "." + std::to_string(shard.index) + "of" +
                                                        std::to_string(shard.count);
        return settings_.folder / (name + part + ".tsv");
    }
    std::string contextOf(const records::RunContext& context) const {
        return records::contextText(context) + "\n" + settings_.plan();
    }

    std::vector<Unit> shardOfUnits() const {
        std::vector<Unit> mine;
        int number = 0;
        for (const std::string& scene : settings_.scenes)
            for (const double softness : settings_.softness)
                for (int frame = 0; frame < settings_.frames; ++frame)
                    for (const SweptTechnique& technique : settings_.techniques)
                        if (number++ % settings_.shard.count == settings_.shard.index - 1)
                            mine.push_back({scene, softness, frame, &technique});
        return mine;
    }

    /// Units whose first round is in the journals of times and errors: the times of the largest
    /// size are written last.
    std::set<std::string> measuredUnits() const {
        std::set<std::string> done;
        for (const TsvRow& row : times_.table().rows())
            if (row.whole("round") == 0 && row.whole("resolution") == settings_.sizes.back())
                done.insert(keyOf(row, {"scene", "frame", "technique"}));
        return done;
    }
    /// Units of which every policy was asked for every step of its parameter.
    std::set<std::string> askedUnits() const {
        std::set<std::string> done;
        const std::string last(sizingPolicies().back().name);
        for (const TsvRow& row : policies_.table().rows())
            if (row.text("policy") == last && row.wholes("sizes").size() == 2 * kPolicySteps + 1)
                done.insert(keyOf(row, {"scene", "frame", "technique"}));
        return done;
    }

    void show(const Unit& unit) {
        view_.show(unit.source, unit.softness, unit.frame);
        frame_ = &view_.renderer();
        softness_ = view_.softness();
    }

    ShadowRun::Settings runSettings(const Unit& unit, int resolution) const {
        return {.technique = unit.technique->technique,
                .parameters = unit.technique->parameters,
                .radiusUv = softness_.radiusUv,
                .resolution = resolution,
                .slope = settings_.slope.slope};
    }

    /// The time of a frame after one that is not timed, since it makes its maps.
    double timedFrame(ShadowRun& run, const Unit& unit, int resolution) const {
        run.change(runSettings(unit, resolution));
        run.step();
        return run.timeWholeFrames(1).median;
    }

    void measure(const Unit& unit) {
        show(unit);
        ShadowRun run(*frame_, info_, runSettings(unit, settings_.sizes.front()));
        run.step();  // compiles the technique's programs
        std::vector<Measured> sizes;
        double last = 0;
        double growth = kMostGrowth;
        for (const int resolution : settings_.sizes) {
            Measured measured;
            measured.resolution = resolution;
            // A frame that something else held up must not leave out all larger sizes: the last one
            // is timed again before it is believed.
            if (last * growth > settings_.mostFrameMs && !sizes.empty() &&
                sizes.back().status == "ok")
                last = std::min(last, timedFrame(run, unit, sizes.back().resolution));
            if (last * growth > settings_.mostFrameMs) {
                measured.status = "skipped: predicted " + tsvNumber(last * growth) + " ms a frame";
                last *= growth;
                sizes.push_back(std::move(measured));
                continue;
            }
            try {
                measured.frameMs = timedFrame(run, unit, resolution);
                measured.passes = run.timePasses(1);
                measured.mapBytes = frame_->mapBytes();
                measured.visibility = frame_->readVisibility();
                if (last > 0)
                    growth = std::clamp(measured.frameMs / last, kLeastGrowth, kMostGrowth);
                last = measured.frameMs;
            } catch (const std::runtime_error& error) {
                measured.status = std::string("failed: ") + error.what();
            }
            sizes.push_back(std::move(measured));
        }
        writeErrors(unit, sizes);
        for (const Measured& measured : sizes) writeTime(unit, 0, measured);
        writePolicies(unit);
    }

    /// Of a unit that was measured before, by its reference.
    void askPolicies(const Unit& unit) {
        int reference = 0;
        for (const TsvRow& row : errors_.table().rows())
            if (keyOf(row, {"scene", "frame", "technique"}) == joined(unit.key()))
                reference = row.whole("reference");
        if (reference == 0) return;  // no size could be drawn
        show(unit);
        drawReference(unit, reference);
        writePolicies(unit);
    }

    void drawReference(const Unit& unit, int resolution) {
        frame_->render({.technique = unit.technique->technique,
                        .parameters = unit.technique->parameters,
                        .resolution = resolution,
                        .radiusUv = static_cast<float>(softness_.radiusUv)});
    }

    void revisit(const Unit& unit, int round) {
        const std::vector<int> sizes = sizesToRevisit(unit, round);
        if (sizes.empty()) return;
        show(unit);
        ShadowRun run(*frame_, info_, runSettings(unit, sizes.front()));
        run.step();
        for (const int resolution : sizes) {
            Measured measured;
            measured.resolution = resolution;
            try {
                measured.frameMs = timedFrame(run, unit, resolution);
                measured.mapBytes = frame_->mapBytes();
            } catch (const std::runtime_error& error) {
                measured.status = std::string("failed: ") + error.what();
            }
            writeTime(unit, round, measured);
        }
    }

    /// Those that were measured, are not too slow, and were not visited in this round before a
    /// kill.
    std::vector<int> sizesToRevisit(const Unit& unit, int round) const {
        std::map<int, double> spentMs;
        std::set<int> visited;
        const std::string key = joined(unit.key());
        for (const TsvRow& row : times_.table().rows()) {
            if (keyOf(row, {"scene", "frame", "technique"}) != key) continue;
            const int resolution = row.whole("resolution");
            if (row.whole("round") == round) visited.insert(resolution);
            if (row.text("status") == "ok") spentMs[resolution] += 2 * row.number("frame_ms");
        }
        std::vector<int> sizes;
        for (const auto& [resolution, ms] : spentMs)
            if (!visited.contains(resolution) && (round == 1 || ms <= kMostCellMs))
                sizes.push_back(resolution);
        return sizes;
    }

    void writeTime(const Unit& unit, int round, const Measured& measured) {
        const auto pass = [&](renderer::Pass which) {
            const Spread& spread = measured.passes.passes[static_cast<std::size_t>(which)];
            return spread.count > 0 ? tsvNumber(spread.median) : "n/a";
        };
        std::vector<std::string> row = unit.key();
        for (const std::string& cell :
             {std::to_string(measured.resolution), std::to_string(round), measured.status,
              tsvNumber(measured.frameMs), pass(renderer::Pass::depth),
              pass(renderer::Pass::prefilter), pass(renderer::Pass::prepass),
              pass(renderer::Pass::lookup), pass(renderer::Pass::lit),
              std::to_string(measured.mapBytes)})
            row.push_back(cell);
        times_.add(row);
    }

    void writeErrors(const Unit& unit, std::vector<Measured>& sizes) {
        const auto usable = [](const Measured& m) { return m.status == "ok"; };
        const auto largest = std::find_if(sizes.rbegin(), sizes.rend(), usable);
        if (largest == sizes.rend()) return;
        const Measured& reference = *largest;
        addMoved(unit, sizes);
        drawReference(unit, reference.resolution);
        const renderer::FloatImage places = mapPlaces(*frame_);
        const std::vector<Contour> contours = shadowContours(reference.visibility, places);
        const std::vector<bool> thin =
            behindThinCasters(frame_->readShadowMap(), places, softness_.radiusUv);
        const Measured* smaller = nullptr;
        for (const Measured& measured : sizes) {
            if (!usable(measured)) continue;
            writeErrorsOf(unit, measured, reference, smaller, places, contours, thin);
            smaller = &measured;
        }
    }

    void writeErrorsOf(const Unit& unit, const Measured& measured, const Measured& reference,
                       const Measured* smaller, const renderer::FloatImage& places,
                       const std::vector<Contour>& contours, const std::vector<bool>& thin) {
        const VisibilityError error = compareVisibility(measured.visibility, reference.visibility);
        const std::vector<float> ripples = edgeRipples(measured.visibility, reference.visibility,
                                                       places, contours, measured.resolution);
        const EdgeRipple ripple = summarised(ripples);
        const EdgeWidth width = edgeWidth(measured.visibility, reference.visibility, places);
        const ThinDetail detail = thinDetail(measured.visibility, reference.visibility, thin);
        const auto flicker = [&](const renderer::FloatImage& now,
                                 const renderer::FloatImage& truthNow) {
            return now.values.empty()
                       ? NAN
                       : temporalError({measured.visibility, now, reference.visibility, truthNow});
        };
        const double size = smaller == nullptr
                                ? NAN
                                : temporalError({smaller->visibility, measured.visibility,
                                                 reference.visibility, reference.visibility});
        std::vector<std::string> row = unit.key();
        for (const double number : {static_cast<double>(measured.resolution),
                                    static_cast<double>(reference.resolution),
                                    softness_.radiusUv,
                                    static_cast<double>(error.penumbraPixels),
                                    error.rmse,
                                    error.most,
                                    error.p95,
                                    error.bias,
                                    error.shareBeyondLevel,
                                    error.shareBeyond2Percent,
                                    error.shareBeyond5Percent,
                                    structuralSimilarity(measured.visibility, reference.visibility),
                                    static_cast<double>(ripple.contourPixels),
                                    ripple.p95,
                                    ripple.most,
                                    width.widthPx,
                                    width.truthWidthPx,
                                    width.ratio,
                                    static_cast<double>(detail.pixels),
                                    detail.rmse,
                                    detail.lost,
                                    flicker(measured.lightMoved, reference.lightMoved),
                                    flicker(measured.orbited, reference.orbited),
                                    size})
            row.push_back(tsvNumber(number));
        row.push_back(rippleCountsText(ripples));
        errors_.add(row);
    }

    /// The same sizes after a small step of the light, and of the camera.
    void addMoved(const Unit& unit, std::vector<Measured>& sizes) {
        const PathView view = view_.path();
        const auto draw = [&](renderer::FloatImage Measured::*image) {
            const double radiusUv = view_.softness().radiusUv;
            for (Measured& measured : sizes) {
                if (measured.status != "ok") continue;
                frame_->render({.technique = unit.technique->technique,
                                .parameters = unit.technique->parameters,
                                .resolution = measured.resolution,
                                .radiusUv = static_cast<float>(radiusUv),
                                .lit = false});
                measured.*image = frame_->readVisibility();
            }
        };
        renderer::Sun moved = view.sun;
        moved.azimuthDeg += kLightStepDeg;
        frame_->setSun(moved);
        draw(&Measured::lightMoved);
        frame_->setSun(view.sun);
        renderer::OrbitCamera orbited = view.camera;
        orbited.yawDeg += kOrbitStepDeg;
        frame_->setCamera(orbited);
        draw(&Measured::orbited);
        frame_->setCamera(view.camera);
    }

    /// Asked of the last frame: the reference where there is one.
    void writePolicies(const Unit& unit) {
        const FrameFacts facts = frameFacts(*frame_, settings_.slope.slope);
        for (const SizingPolicy& policy : sizingPolicies()) {
            std::vector<double> parameters;
            for (int step = -kPolicySteps; step <= kPolicySteps; ++step)
                parameters.push_back(policyParameter(policy.standard, step));
            std::string sizes;
            for (const int size : chosenSizes(policy, facts, parameters, settings_.sizes))
                sizes += (sizes.empty() ? "" : ",") + std::to_string(size);
            std::vector<std::string> row = unit.key();
            row.emplace_back(policy.name);
            row.push_back(sizes);
            policies_.add(row);
        }
    }

    const renderer::GlInfo& info_;
    const SweepSettings& settings_;
    TsvJournal times_, errors_, policies_;
    SweptView view_;
    renderer::Renderer* frame_ = nullptr;  // of view_
    Softness softness_;
};

}  // namespace

Shard parseShard(const std::string& text, const std::string& option) {
    Shard shard;
    const char* const end = text.data() + text.size();
    const auto [slash, first] = std::from_chars(text.data(), end, shard.index);
    const bool halves = first == std::errc() && slash != end && *slash == '/';
    const auto [rest, second] =
        halves ? std::from_chars(slash + 1, end, shard.count)
               : std::from_chars_result{text.data(), std::errc::invalid_argument};
    if (second != std::errc() || rest != end || shard.index < 1 || shard.index > shard.count)
        throw std::invalid_argument(option + " is \"" + text +
                                    "\", must be INDEX/COUNT with 1 <= INDEX <= COUNT");
    return shard;
}

void SweepSettings::validate() const {
    const auto atLeastOne = [](const char* name, int value) {
        if (value < 1)
            throw std::invalid_argument(std::string(name) + " is " + std::to_string(value) +
                                        ", must be at least 1");
    };
    atLeastOne("frames", frames);
    atLeastOne("rounds", rounds);
    // Before the journals are begun, which only sweeps of the same plan go on with.
    for (const auto& [name, edge] : {std::pair{"width", widthPx}, std::pair{"height", heightPx}})
        if (edge < 1 || edge > kMostViewportPx)
            throw std::invalid_argument(std::string(name) + " is " + std::to_string(edge) +
                                        " px, must be in [1, " + std::to_string(kMostViewportPx) +
                                        "]");
    for (const double factor : softness)
        if (!(factor > 0 && factor <= 100))
            throw std::invalid_argument("softness has " + tsvNumber(factor) +
                                        ", must be above 0 and at most 100");
    if (scenes.empty() || techniques.empty() || softness.empty())
        throw std::invalid_argument("scenes, techniques and softness must not be empty");
    if (sizes.size() < 2 || !std::is_sorted(sizes.begin(), sizes.end()))
        throw std::invalid_argument("sizes has " + std::to_string(sizes.size()) +
                                    " entries, must be at least two, ascending");
    for (const int size : sizes)
        if (std::find(resolution_controller::kLevels.begin(), resolution_controller::kLevels.end(),
                      size) == resolution_controller::kLevels.end())
            throw std::invalid_argument("sizes has " + std::to_string(size) +
                                        ", must be a level of the controller (128, 184, 256, 368, "
                                        "512, 728, 1024, ...)");
    if (!(mostFrameMs > 0))
        throw std::invalid_argument("most milliseconds per frame is " +
                                    std::to_string(mostFrameMs) + ", must be greater than 0");
}

std::string SweepSettings::plan() const {
    std::string text = "plan      " + std::to_string(widthPx) + " x " + std::to_string(heightPx) +
                       " px, " + std::to_string(frames) + " frames, sizes";
    for (const int size : sizes) text += " " + std::to_string(size);
    return text + ", " + slope.text;
}

double policyParameter(double standard, int step) {
    return standard * std::exp2(step / 8.0);
}

void runSweep(const renderer::GlInfo& info, const SweepSettings& settings,
              const records::RunContext& context) {
    settings.validate();
    Sweep(info, settings, context).run();
}

}  // namespace demo

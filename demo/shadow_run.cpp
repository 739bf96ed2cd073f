// SPDX-License-Identifier: MIT
#include "demo/shadow_run.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "demo/demand_glsl.h"
#include "demo/gpu_demand.h"
#include "demo/picture.h"

namespace demo {
namespace {

namespace rc = resolution_controller;

rc::Settings sizingOf(const ShadowRun::Settings& settings, const renderer::GlInfo& info) {
    rc::Settings sizing = settings.sizing;
    sizing.slope = settings.slope;
    sizing.driverMaxSize = info.maxResolution;
    return sizing;
}

// The controller lowers after 45 frames by default; an orbiting camera is not waited for.
constexpr int kMostSettlingFrames = 64;
// Frames from one tile of the detail probe to the next, of one map: a tile costs about 4 % of a
// frame that has one.
constexpr std::size_t kFramesPerTile = 10;
// What one of several maps is kept at without a budget while no penumbra of it is in view. A shadow
// that comes into view must show on it to ask for more: what is too wide for the detail probe
// covers half a texel or more.
constexpr int kUnseenTexels = 256;
static_assert(2 * kUnseenTexels * renderer::DetailProbe::kWidestTexels >=
              renderer::DetailProbe::kFineEdge);

/// What a map asks for of which nothing is in view: one reading, data of the same kind as of a map
/// that is seen, so that falls in vain stay in mind where the two take turns. Without a budget its
/// bin ends at 216 texels: enough for kUnseenTexels, which are taken at a cut and risen to; a fall
/// goes to the next level above (lowerBelowPercent). Under a budget the texels are for the others,
/// so it is the smallest size, of which it needs no more than 60 % with its bin.
rc::DemandHistogram unseenDemand(const rc::Settings& sizing, bool hasBudget) {
    rc::DemandHistogram demand;
    demand.add(hasBudget ? 0.5F * static_cast<float>(std::min(kUnseenTexels, sizing.minSize))
                         : 0.78F * static_cast<float>(kUnseenTexels));
    return demand;
}

std::string numberText(double number) {
    char text[32];
    std::snprintf(text, sizeof text, "%.10g", number);
    return text;
}

ChosenResolution chosenFrom(const rc::Decision& choice, const rc::Frame& about) {
    return {.resolution = choice.size,
            .automatic = true,
            .reason = rc::text(choice.reason),
            .need = choice.need,
            .minRadiusUv = choice.minRadiusUv,
            .shareAbove = choice.shareAbove,
            .artifactRatio = choice.artifactRatio,
            .detailTexels = about.detailTexels,
            .fadeWeight = choice.fadeWeight};
}

}  // namespace

ResolutionOption parseResolution(const std::string& text, const std::string& option) {
    if (text == "auto") return std::nullopt;
    int resolution = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), resolution);
    if (error != std::errc() || end != text.data() + text.size() || resolution < 1)
        throw std::invalid_argument(option + " is \"" + text +
                                    "\", must be auto or a whole number of texels from 1");
    return resolution;
}

Softness chooseSoftness(const renderer::Renderer& frame, std::optional<double> radiusM,
                        std::optional<double> radiusUv) {
    const double extent = frame.window().extentM;
    Softness softness;
    softness.radiusM = radiusUv ? *radiusUv * extent : radiusM.value_or(frame.scene().softnessM);
    softness.radiusUv = radiusUv.value_or(softness.radiusM / extent);
    if (!(softness.radiusUv >= 0 && softness.radiusUv <= 1))
        throw std::invalid_argument(
            "radius is " + numberText(softness.radiusM) + " m, " + numberText(softness.radiusUv) +
            " of the shadow map's extent of " + numberText(extent) + " m in scene " +
            frame.scene().name + "; must be at least 0 and no wider than the map");
    return softness;
}

ShadowRun::ShadowRun(renderer::Renderer& frame, const renderer::GlInfo& info,
                     const Settings& settings)
    : frame_(frame),
      info_(info),
      controller_(sizingOf(settings, info)),
      demand_(frame.shaders(), kDemandGlsl),
      detail_(frame.shaders(), kDemandGlsl) {
    change(settings);
}

void ShadowRun::change(const Settings& settings) {
    if (settings.budgetTexels && *settings.budgetTexels < 1)
        throw std::invalid_argument("budget is " + std::to_string(*settings.budgetTexels) +
                                    " texels, must be at least 1");
    renderer::FrameSettings next = frameSettings_;
    next.maps.clear();
    next.technique = settings.technique;
    next.parameters = settings.parameters;
    next.radiusUv = static_cast<float>(settings.radiusUv);
    if (settings.resolution) {
        next.resolution = *settings.resolution;
        next.minRadiusUv = 0;
        next.fadeWeight = 1;
    }
    next.validate(info_);
    const rc::Settings sizing = sizingOf(settings, info_);
    if (const std::string problem = rc::validate(sizing); !problem.empty())
        throw std::invalid_argument(problem);
    if (settings.technique != nullptr)
        demand_.prepare(*settings.technique, gpuRule(rc::demandRule(sizing)));
    controller_.reconfigure(sizing);
    if (lights_)
        for (std::size_t map = 0; map < lights_->count(); ++map) {
            if (lights_->light(map).settings() == controller_.settings()) continue;
            lights_->reconfigure(map, controller_.settings());
            if (trace_) trace_->reconfigured(map, controller_.settings());
        }
    // What was asked by other rules, or while nothing followed it. Not for another radius: the
    // map's extent, and with it radiusUv, changes with every step of the sun.
    if (settings.technique != settings_.technique || settings.slope != settings_.slope ||
        settings.resolution.has_value() != settings_.resolution.has_value())
        forgetDemand();
    settings_ = settings;
    frameSettings_ = next;
    if (settings.resolution)
        chosen_.assign(1, {.resolution = *settings.resolution, .reason = "fixed"});
}

void ShadowRun::reload(const renderer::ShaderLibrary& shaders) {
    const renderer::ShaderLibrary last = frame_.shaders();
    try {
        demand_.reload(shaders);
        detail_.reload(shaders);
        frame_.reload(shaders);
    } catch (const std::runtime_error&) {
        demand_.reload(last);
        detail_.reload(last);
        throw;
    }
}

void ShadowRun::startTrace(std::size_t bytes) {
    traceBytes_.assign(bytes, {});
    trace_.emplace(traceBytes_);
    if (lights_) trace_->begin(*lights_);
}

renderer::DemandRule ShadowRun::demandRule() const {
    return gpuRule(rc::demandRule(controller_.settings()));
}

void ShadowRun::step(renderer::PassClock* clock, bool cut) {
    draw(clock, cut ? View::another : View::goesOn);
}

void ShadowRun::draw(renderer::PassClock* clock, View view) {
    const std::size_t maps = frame_.lightViews().size();
    if (view == View::another) {
        forgetDemand();
        detail_.forget();
        hurriedTiles_ = renderer::DetailProbe::kTiles * maps;
    }
    fitRecent();
    frameSettings_.maps.clear();
    budget_.reset();
    if (settings_.resolution)
        chosen_.assign(maps, {.resolution = *settings_.resolution, .reason = "fixed"});
    else if (maps > 1 || settings_.budgetTexels || trace_)
        chooseTogether(view);
    else
        chooseAlone(view);
    frame_.render(frameSettings_, clock);
    if (!settings_.resolution) ask(clock);
}

const rc::DemandHistogram* ShadowRun::hear(std::size_t map) {
    const rc::DemandHistogram* recent = nullptr;
    while (const auto counters = demand_.next(map))
        recent = &recent_[map].add(histogramOf(*counters));
    return recent;
}

void ShadowRun::chooseAlone(View view) {
    if (lights_) {
        controller_ = rc::ResolutionController(controller_.settings(), lights_->light(0).state());
        lights_.reset();
    }
    // What joins renderer and controller (docs/engines.md shows these lines): an earlier frame's
    // demand chooses this frame's size.
    const rc::DemandHistogram* recent = hear(0);
    const rc::Frame about{.cameraCut = view != View::goesOn,
                          .detailTexels = detail_.detailTexels()};
    const rc::Decision choice =
        recent ? controller_.update(*recent, about) : controller_.hold(about);
    frameSettings_.resolution = choice.size;
    frameSettings_.minRadiusUv = static_cast<float>(std::min(choice.minRadiusUv, 1.0));
    frameSettings_.fadeFrom = choice.fadeFromSize;
    frameSettings_.fadeWeight = static_cast<float>(choice.fadeWeight);
    chosen_.assign(1, chosenFrom(choice, about));
}

void ShadowRun::chooseTogether(View view) {
    const std::size_t maps = frame_.lightViews().size();
    if (!lights_ || lights_->count() != maps) {
        const rc::ControllerState sun = lights_ ? lights_->light(0).state() : controller_.state();
        lights_.emplace(std::vector<rc::Settings>(maps, controller_.settings()));
        lights_->restore(0, sun, {.texels = sun.last.need});
        if (trace_) trace_->begin(*lights_);
    }
    std::vector<rc::LightData> data(maps);
    const rc::DemandHistogram unseen =
        unseenDemand(controller_.settings(), settings_.budgetTexels.has_value());
    for (std::size_t map = 0; map < maps; ++map) {
        rc::Frame& about = data[map].frame;
        about = {.cameraCut = view != View::goesOn, .detailTexels = detail_.detailTexels(map)};
        const rc::DemandHistogram* recent = hear(map);
        if (!recent) continue;
        unseen_[map] = maps > 1 && recent->total() == 0 && recent->rejected == 0;
        // In every frame, whatever the map's size: the budget is shared by the need last heard of.
        data[map].kind = rc::LightData::Kind::histogram;
        data[map].histogram = unseen_[map] ? &unseen : recent;
    }
    std::vector<rc::Decision> choices(maps);
    const rc::LightSummary summary =
        lights_->update(data, choices, {.texels = settings_.budgetTexels});
    if (trace_) trace_->frame(data, {.texels = settings_.budgetTexels}, choices);
    if (settings_.budgetTexels)
        budget_ = {.texels = *settings_.budgetTexels,
                   .wanted = summary.budget.wanted,
                   .used = summary.budget.used,
                   .feasible = summary.budget.feasible};

    frameSettings_.resolution = choices.front().size;
    frameSettings_.minRadiusUv = 0;
    frameSettings_.fadeWeight = 1;
    std::vector<renderer::MapSettings> settings(maps);
    chosen_.clear();
    for (std::size_t map = 0; map < maps; ++map) {
        const rc::Decision& choice = choices[map];
        settings[map] = {.resolution = choice.size,
                         .radiusUv = frame_.mapSettings(frameSettings_, map).radiusUv,
                         .minRadiusUv = static_cast<float>(std::min(choice.minRadiusUv, 1.0)),
                         .fadeWeight = static_cast<float>(choice.fadeWeight),
                         .fadeFrom = choice.fadeFromSize};
        ChosenResolution& chosen = chosen_.emplace_back(chosenFrom(choice, data[map].frame));
        // Thin casters that the probe finds, and the map has lost, are in view.
        if (!unseen_[map] || chosen.detailTexels > 0) continue;
        chosen.need = 0;
        chosen.artifactRatio = chosen.shareAbove = 0;
        if (choice.reason == rc::Reason::demandMet || choice.reason == rc::Reason::atMinimum ||
            choice.reason == rc::Reason::waitingToLower ||
            choice.reason == rc::Reason::heldWithoutData)
            chosen.reason = "no penumbra of it in view";
    }
    frameSettings_.maps = std::move(settings);
}

void ShadowRun::ask(renderer::PassClock* clock) {
    if (clock != nullptr) clock->begin(renderer::Pass::demand);
    if (detailOf_ != frame_.scene().source) {
        detail_.forget();
        forgetDemand();
        detailOf_ = frame_.scene().source;
    }
    const std::size_t maps = frame_.lightViews().size();
    if (hurriedTiles_ > 0) {
        --hurriedTiles_;
        framesToDetail_ = 0;
    }
    if (settings_.sizing.texelsPerCaster > 0 && framesToDetail_-- <= 0) {
        detail_.submit(frame_, demandRule(), detailTurn_++ % maps);
        framesToDetail_ = static_cast<int>(std::max<std::size_t>(kFramesPerTile / maps, 1)) - 1;
    }
    demand_.submit(frame_, demandRule());
    for (std::size_t map = 1; map < maps; ++map) demand_.submit(frame_, demandRule(), nullptr, map);
    if (clock != nullptr) clock->end(renderer::Pass::demand);
}

void ShadowRun::askTheRest() {
    for (std::size_t map = 0; map < frame_.lightViews().size(); ++map)
        for (int turn = 1; turn < recent_[map].frames(); ++turn) {
            glFinish();
            hear(map);
            demand_.submit(frame_, demandRule(), nullptr, map);
        }
}

void ShadowRun::forgetDemand() {
    demand_.forget();
    for (rc::RecentDemand& recent : recent_) recent.clear();
    unseen_.assign(recent_.size(), false);
}

void ShadowRun::fitRecent() {
    const int edge = renderer::DemandPass::cellEdge(frame_.widthPx(), frame_.heightPx());
    const std::size_t maps = frame_.lightViews().size();
    const glm::ivec2 size(frame_.widthPx(), frame_.heightPx());
    if (recent_.size() == maps && askedPx_ == size) return;
    demand_.forget();  // other pixels, or other maps
    askedPx_ = size;
    recent_.assign(maps, rc::RecentDemand(edge * edge));
    unseen_.assign(maps, false);
}

int ShadowRun::settle() {
    draw(nullptr, View::another);
    if (settings_.resolution) return 1;
    for (std::size_t map = 0; map < chosen_.size(); ++map)
        detail_.submitAll(frame_, demandRule(), map);
    hurriedTiles_ = 0;
    const auto asksForNothing = [&] {
        return std::ranges::all_of(chosen_, [](const auto& map) { return map.need == 0; });
    };
    // The map's first sizes are the way to the right one, not sizes that were shown, so nothing
    // waits to be lowered from them.
    constexpr int kUnseenFrames = 4, kQuietFrames = 2;
    int frames = 1;
    for (int quiet = 0; quiet < kQuietFrames && frames < kMostSettlingFrames; ++frames) {
        const std::vector<ChosenResolution> before = chosen_;
        askTheRest();
        glFinish();  // so that every frame has the demand of the one before, on any machine
        draw(nullptr, frames < kUnseenFrames ? View::sameUnseen : View::goesOn);
        const bool same =
            std::ranges::equal(chosen_, before, {}, &ChosenResolution::resolution,
                               &ChosenResolution::resolution) &&
            std::ranges::all_of(chosen_, [](const auto& map) { return map.fadeWeight == 1; });
        quiet = same && !asksForNothing() ? quiet + 1 : 0;
        if (asksForNothing() && frames > 2) break;  // nothing to go by in this view
    }
    return frames;
}

Spread ShadowRun::timeWholeFrames(int frames) {
    std::vector<double> times;
    for (int i = 0; i < frames; ++i) {
        glFinish();
        const auto start = std::chrono::steady_clock::now();
        step();
        glFinish();
        times.push_back(
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
                .count());
    }
    return spreadOf(std::move(times));
}

ShadowRun::PassSpreads ShadowRun::timePasses(int frames) {
    renderer::PassClock clock(info_);
    std::array<std::vector<double>, renderer::kPasses> times;
    for (int i = 0; i < frames; ++i) {
        step(&clock);
        const renderer::PassTimesMs frame = clock.collectMs();
        for (std::size_t pass = 0; pass < renderer::kPasses; ++pass)
            if (frame[pass] > 0) times[pass].push_back(frame[pass]);
    }
    PassSpreads spreads;
    for (std::size_t pass = 0; pass < renderer::kPasses; ++pass)
        spreads.passes[pass] = spreadOf(times[pass]);
    return spreads;
}

renderer::ByteImage ShadowRun::picture(int samplesPerPixelEdge) {
    const int width = frame_.widthPx();
    const int height = frame_.heightPx();
    frame_.resize(width * samplesPerPixelEdge, height * samplesPerPixelEdge);
    renderer::FrameSettings settings = frameSettings_;
    settings.samplesPerPixelEdge = samplesPerPixelEdge;
    frame_.render(settings);
    const renderer::ByteImage large = frame_.readLit();
    frame_.resize(width, height);
    frame_.render(frameSettings_);
    return averagedInLight(large, samplesPerPixelEdge);
}

}  // namespace demo

// SPDX-License-Identifier: MIT
#include "demo/shadow_run.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include "demo/demand_glsl.h"
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
// Frames from one tile of the detail probe to the next: a tile costs about 4 % of a frame.
constexpr int kFramesPerTile = 8;

rc::DemandHistogram histogramOf(const renderer::DemandPass::Reading& reading) {
    static_assert(sizeof reading.counters == sizeof(rc::DemandHistogram));
    rc::DemandHistogram histogram;
    std::copy_n(reading.counters.begin(), histogram.counts.size(), histogram.counts.begin());
    histogram.rejected = reading.counters.back();
    return histogram;
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
        throw std::invalid_argument("radius is " + std::to_string(softness.radiusM) + " m, " +
                                    std::to_string(softness.radiusUv) +
                                    " of the shadow map's extent of " + std::to_string(extent) +
                                    " m in scene " + frame.scene().name +
                                    "; must be at least 0 and no wider than the map");
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
    renderer::FrameSettings next = frameSettings_;
    next.technique = settings.technique;
    next.parameters = settings.parameters;
    next.radiusUv = static_cast<float>(settings.radiusUv);
    if (settings.resolution) {
        next.resolution = *settings.resolution;
        next.minRadiusUv = 0;
        next.fadeWeight = 1;
    }
    next.validate(info_);
    if (const std::string problem = controller_.reconfigure(sizingOf(settings, info_));
        !problem.empty())
        throw std::invalid_argument(problem);
    settings_ = settings;
    frameSettings_ = next;
    if (settings.resolution) chosen_ = {.resolution = *settings.resolution, .reason = "fixed"};
}

renderer::DemandRule ShadowRun::demandRule() const {
    const rc::DemandRule rule = rc::demandRule(controller_.settings());
    return {rule.c, rule.pixelBound, rule.contrastExponent, rule.texelsPerCaster};
}

void ShadowRun::step(renderer::PassClock* clock, bool cut) {
    draw(clock, cut ? View::another : View::goesOn);
}

void ShadowRun::draw(renderer::PassClock* clock, View view) {
    if (!settings_.resolution) {
        // What joins renderer and controller (docs/engines.md shows these lines): an earlier
        // frame's demand chooses this frame's size.
        const auto reading = demand_.newest();
        rc::Frame about{.cameraCut = view != View::goesOn, .detailTexels = detail_.detailTexels()};
        if (reading && view != View::sameUnseen) about.dataAgeFrames = reading->ageFrames + 1;
        const rc::Decision choice =
            reading ? controller_.update(histogramOf(*reading), about) : controller_.hold(about);
        frameSettings_.resolution = choice.size;
        frameSettings_.minRadiusUv = static_cast<float>(std::min(choice.minRadiusUv, 1.0));
        frameSettings_.fadeFrom = choice.fadeFromSize;
        frameSettings_.fadeWeight = static_cast<float>(choice.fadeWeight);

        chosen_ = {.resolution = choice.size,
                   .automatic = true,
                   .reason = rc::text(choice.reason),
                   .need = choice.need,
                   .minRadiusUv = choice.minRadiusUv,
                   .shareAbove = choice.shareAbove,
                   .artifactRatio = choice.artifactRatio,
                   .detailTexels = about.detailTexels,
                   .fadeWeight = choice.fadeWeight};
    }
    frame_.render(frameSettings_, clock);
    if (!settings_.resolution) ask(clock);
}

void ShadowRun::ask(renderer::PassClock* clock) {
    if (clock != nullptr) clock->begin(renderer::Pass::demand);
    if (detailOf_ != frame_.scene().name) {
        detail_.forget();
        detailOf_ = frame_.scene().name;
    }
    if (framesToDetail_-- == 0) {
        detail_.submit(frame_, demandRule());
        framesToDetail_ = kFramesPerTile - 1;
    }
    demand_.submit(frame_, demandRule());
    if (clock != nullptr) clock->end(renderer::Pass::demand);
}

int ShadowRun::settle() {
    draw(nullptr, View::another);
    if (settings_.resolution) return 1;
    detail_.submitAll(frame_, demandRule());
    // The map's first sizes are the way to the right one, not sizes that were shown, so nothing
    // waits to be lowered from them.
    constexpr int kUnseenFrames = 4, kQuietFrames = 4;
    int frames = 1;
    for (int quiet = 0; quiet < kQuietFrames && frames < kMostSettlingFrames; ++frames) {
        const int before = chosen_.resolution;
        glFinish();  // so that every frame has the demand of the one before, on any machine
        draw(nullptr, frames < kUnseenFrames ? View::sameUnseen : View::goesOn);
        quiet = chosen_.resolution == before && chosen_.need > 0 ? quiet + 1 : 0;
        if (chosen_.need == 0 && frames > 2) break;  // nothing to go by in this view
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

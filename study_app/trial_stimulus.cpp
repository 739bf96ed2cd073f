// SPDX-License-Identifier: MIT
#include "study_app/trial_stimulus.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "records/quoted_text.h"
#include "stimulus/stimulus_image.h"
#include "study_app/frame_images.h"

namespace study_app {
namespace {

using records::Trial;

[[noreturn]] void fail(const Trial& trial, const std::string& sentence) {
    throw std::invalid_argument("trial " + std::to_string(trial.number) + ": " + sentence);
}

stimulus::Pattern patternOf(const Trial& trial) {
    switch (trial.pattern) {
        case records::Pattern::stair:
            return stimulus::Pattern::stair;
        case records::Pattern::step:
            return stimulus::Pattern::step;
        case records::Pattern::line:
            return stimulus::Pattern::line;
        case records::Pattern::frame:
            break;
    }
    fail(trial, "pattern: frame: has no computed stimulus");
}

stimulus::SilhouetteOptions silhouetteOf(const Trial& trial, int windowPx) {
    stimulus::SilhouetteOptions o{.pattern = patternOf(trial),
                                  .artifactPx = trial.artifactPx,
                                  .riserSpacingPx = static_cast<double>(windowPx)};
    if (trial.pattern == records::Pattern::line) o.angleDeg = trial.angleDeg.value_or(45);
    return o;
}

void setKernel(stimulus::StimulusOptions& o, const Trial& trial) {
    o.kernel.radiusPx = trial.filterRadiusPx;
    o.taps = stimulus::tapKernelFromText(trial.kernel);
    if (o.taps) return;
    const auto shape = stimulus::kernelShapeFromText(trial.kernel);
    if (!shape) {
        fail(trial, "kernel: " + records::quotedText(trial.kernel) +
                        ": must be disc, box, gaussian or poisson with a number of taps");
    }
    o.kernel.shape = *shape;
}

void setNoise(stimulus::StimulusOptions& o, const Trial& trial) {
    o.noiseLevels = trial.noiseLevels.value_or(0);
    o.dither = trial.dither.value_or(false);
    if ((o.taps || o.noiseLevels > 0 || o.dither) && !trial.imageSeed) {
        fail(trial, "image_seed: n/a: turned taps, noise and dither cannot be redrawn without it");
    }
    o.seed = static_cast<std::uint64_t>(trial.imageSeed.value_or(0));
}

stimulus::StimulusOptions stimulusOf(const Trial& trial, int windowPx) {
    stimulus::StimulusOptions o;
    o.silhouette = silhouetteOf(trial, windowPx);
    setKernel(o, trial);
    setNoise(o, trial);
    o.windowPx = windowPx;
    o.litLevel = trial.litLevel;
    o.encoding = trial.encoding == records::Encoding::code ? stimulus::Encoding::code
                                                           : stimulus::Encoding::srgb;
    if (trial.tiltDeg.value_or(0) != 0) o.roving.straightTiltDeg = trial.tiltDeg;
    o.roving.shiftPx = trial.shiftPx.value_or(0);
    o.roving.mirror = trial.mirror.value_or(false);
    o.roving.quarterTurns = trial.orientationQuarter.value_or(0);
    return o;
}

/// Both on the sides that the row names; in yes/no the one that it shows.
template <typename Artifact, typename Straight>
TrialImages inPlace(const Trial& trial, Artifact artifact, Straight straight) {
    if (trial.task == records::Task::yesNo) {
        return {trial.type == records::TrialType::artifact ? artifact() : straight(), {}};
    }
    if (trial.side == "left") return {artifact(), straight()};
    return {straight(), artifact()};
}

bool sameCodes(const cv::Mat& a, const cv::Mat& b) {
    if (a.size() != b.size()) return false;
    return a.empty() || cv::countNonZero(a != b) == 0;
}

/// The frame of the row and its converged partner.
TrialImages frameImages(const Trial& trial, const Design& design) {
    if (!design.frames || !trial.frame) {
        fail(trial, "pattern: frame: the design has no frames, or the row names none");
    }
    const std::vector<records::FramePair>& pairs = design.frames->pairs;
    const auto pair = std::ranges::find(pairs, *trial.frame, &records::FramePair::artifact);
    if (pair == pairs.end()) {
        fail(trial, "frame: " + records::quotedText(*trial.frame) + ": is not in the design");
    }
    const auto read = [&](const std::string& name) {
        cv::Mat codes = readFrame(*design.frames, name, design.windowPx);
        if (trial.mirror.value_or(false)) cv::flip(codes, codes, 1);
        return codes;
    };
    return inPlace(
        trial, [&] { return read(pair->artifact); }, [&] { return read(pair->converged); });
}

}  // namespace

bool TrialImages::operator==(const TrialImages& other) const {
    return sameCodes(left, other.left) && sameCodes(right, other.right);
}

TrialImages trialImages(const Trial& trial, const Design& design) {
    if (trial.pattern == records::Pattern::frame) return frameImages(trial, design);
    const stimulus::StimulusOptions o = stimulusOf(trial, design.windowPx);
    return inPlace(
        trial, [&] { return stimulus::artifactImage(o); },
        [&] { return stimulus::straightImage(o); });
}

std::optional<double> clickDistancePx(const Trial& trial, int windowPx, double clickXPx,
                                      double clickYPx) {
    if (trial.type != records::TrialType::artifact || trial.pattern == records::Pattern::frame) {
        return {};
    }
    // Back through turns, mirror and shift to the silhouette's own axes, y up.
    double x = clickXPx, y = clickYPx;
    for (int turn = 0; turn < trial.orientationQuarter.value_or(0); ++turn) {
        x = std::exchange(y, x);
        x = windowPx - x;
    }
    if (trial.mirror.value_or(false)) x = windowPx - x;
    const int origin = windowPx / 2;
    x -= origin;
    y = windowPx - y - origin - trial.shiftPx.value_or(0);

    const stimulus::Silhouette silhouette(silhouetteOf(trial, windowPx));
    std::optional<double> nearest;
    for (std::int64_t k = silhouette.texelAt(-origin) + 1; silhouette.riser(k) < windowPx - origin;
         ++k) {
        const double low = silhouette.height(k - 1), high = silhouette.height(k);
        if (low == high) continue;  // between two texels of a flat line
        const double beside = std::hypot(x - silhouette.riser(k), y - std::clamp(y, low, high));
        nearest = std::min(nearest.value_or(beside), beside);
    }
    return nearest;
}

}  // namespace study_app

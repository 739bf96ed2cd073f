// SPDX-License-Identifier: MIT
#include "study_app/frame_design.h"

#include <algorithm>
#include <cmath>

#include "records/number_rule.h"
#include "records/quoted_text.h"
#include "stimulus/silhouette.h"

namespace study_app {
namespace {

using records::exactText;
using records::FramePair;

double ratioOf(const FramePair& pair) {
    return pair.radiusPx / pair.artifactPx;
}

std::string indexed(std::size_t i) {
    return "frames[" + std::to_string(i) + "]";
}

/// The filter is the kernel of these trials, and a slope stands for one kernel.
std::string checkTechnique(const std::vector<FramePair>& pairs) {
    for (std::size_t i = 1; i < pairs.size(); ++i) {
        if (pairs[i].technique == pairs[0].technique) continue;
        return indexed(i) + ".technique: " + records::quotedText(pairs[i].technique) +
               ": must be that of frames[0], " + records::quotedText(pairs[0].technique) +
               ": a slope stands for one filter; put others into folders of their own";
    }
    return {};
}

std::string checkRoving(const Roving& roving) {
    for (const auto& [field, on] :
         {std::pair("shift", roving.shift), std::pair("quarter_turn", roving.quarterTurn),
          std::pair("tilt", roving.tilt)}) {
        if (on) {
            return "roving." + std::string(field) +
                   ": true: must be false with frames, which can be mirrored alone";
        }
    }
    return {};
}

std::string checkLevels(const Design& design, const Condition& condition) {
    const std::string place = "scene " + records::quotedText(condition.frames.front().scene) +
                              " at radius_px " + exactText(condition.frames.front().radiusPx);
    if (condition.frames.size() < 2) {
        return "frames: " + place +
               " has one artifact size: must have at least two for a staircase to choose from";
    }
    const double least = ratioOf(condition.frames.front()), most = ratioOf(condition.frames.back());
    if (design.guessRatio < least || design.guessRatio > most) {
        return "quest.guess_ratio: " + exactText(design.guessRatio) +
               ": must lie among the r / a of " + place + ", " + exactText(least) + " to " +
               exactText(most);
    }
    return {};
}

}  // namespace

std::string validateFrames(const Design& design) {
    const std::vector<FramePair>& pairs = design.frames->pairs;
    if (pairs.empty()) return "frames: empty: must hold at least two pairs of frames";
    if (!design.artifactPx.empty() || !design.patterns.empty()) {
        return "frames: given: must not stand beside artifact_px or patterns";
    }
    if (design.localise) {
        return "localise: true: must be false with frames, whose risers are unknown";
    }
    if (design.encoding != records::Encoding::srgb) {
        return "encoding: \"code\": must be srgb with frames: a renderer filters light";
    }
    if (auto found = checkTechnique(pairs); !found.empty()) return found;
    if (auto found = checkRoving(design.roving); !found.empty()) return found;
    for (const Condition& condition : frameConditions(design)) {
        if (auto found = checkLevels(design, condition); !found.empty()) return found;
    }
    return {};
}

std::vector<Condition> frameConditions(const Design& design) {
    std::vector<Condition> result;
    for (const FramePair& pair : design.frames->pairs) {
        const std::string name = pair.scene + "-r" + exactText(pair.radiusPx);
        auto condition = std::ranges::find(result, name, &Condition::name);
        if (condition == result.end()) {
            result.push_back({.name = name,
                              .silhouette = {.pattern = records::Pattern::frame},
                              .angleDeg = 0,
                              .artifactPx = 0,
                              .litLevel = 1,
                              .kernel = pair.technique,
                              .noiseLevels = 0,
                              .frames = {}});
            condition = std::prev(result.end());
        }
        condition->frames.push_back(pair);
    }
    for (Condition& condition : result) std::ranges::sort(condition.frames, {}, ratioOf);
    return result;
}

void show(records::Trial& trial, const FramePair& frame) {
    trial.artifactPx = frame.artifactPx;
    trial.filterRadiusPx = frame.radiusPx;
    trial.frame = frame.artifact;
}

const FramePair& nearestFrame(const Condition& condition, double ratio) {
    return *std::ranges::min_element(condition.frames, {}, [&](const FramePair& pair) {
        return std::pair(std::abs(std::log(ratioOf(pair) / ratio)), -ratioOf(pair));
    });
}

}  // namespace study_app

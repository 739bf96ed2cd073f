// SPDX-License-Identifier: MIT
#include "demo/sizing_policy.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "resolution_controller/resolution_controller.h"

namespace demo {
namespace {

namespace rc = resolution_controller;

// Larger than any demand, so that the bound never holds.
constexpr float kNoPixelBound = 1e9F;

double fixedSize(const FrameFacts&, double texels) {
    return texels;
}

double coveredScreen(const FrameFacts& facts, double factor) {
    return factor * std::sqrt(facts.coveredPx);
}

double texelsPerPixel(const FrameFacts& facts, double texels) {
    return texels * 2 * std::min(facts.casterRadiusPx, facts.screenEdgePx);
}

double byDistance(const FrameFacts& facts, double texelsPerRadian) {
    return texelsPerRadian * facts.mapExtentM / facts.distanceM;
}

constexpr double kPublishedSlope = 3.47;

/// The controller's rule, under which no texel is finer than a pixel. Who asks for more than the
/// study does has to ask for finer texels too, or no c would help a shadow as sharp as the pixels.
float pixelBound(double c) {
    return static_cast<float>(std::max(1.0, c / kPublishedSlope));
}

/// What the controller would take, before limits.
double byDemand(const FrameFacts& facts, rc::Settings settings, double contrastExponent, double c) {
    rc::DemandRule rule = rc::demandRule(settings);
    rule.c = static_cast<float>(c);
    rule.contrastExponent = static_cast<float>(contrastExponent);
    settings.slope = facts.slope;
    settings.minSize = rc::kSmallestLevel;
    settings.maxSize = settings.driverMaxSize = rc::kLargestLevel;
    rc::ResolutionController controller(settings);
    const rc::Decision decision = controller.update(facts.demand(rule), {.cameraCut = true});
    return decision.need;
}

double paper(const FrameFacts& facts, double c) {
    return byDemand(facts, {.percentile = rc::kMaximumRule, .pixelBound = kNoPixelBound}, 0, c);
}

double bounded(const FrameFacts& facts, double c) {
    return byDemand(facts, {.percentile = rc::kMaximumRule, .pixelBound = pixelBound(c)}, 0, c);
}

double percentile(const FrameFacts& facts, double c) {
    return byDemand(facts, {.pixelBound = pixelBound(c)}, 0, c);
}

double contrast(const FrameFacts& facts, double c) {
    return byDemand(facts, {.pixelBound = pixelBound(c)}, facts.slope.contrastExponent, c);
}

constexpr SizingPolicy kPolicies[] = {
    {.name = "fixed",
     .title = "Fixed size",
     .source = "most engines' quality settings",
     .parameter = "texels",
     .standard = 4096,
     .texels = fixedSize},
    {.name = "coverage",
     .title = "Screen coverage",
     .source = "engines that round a light's coverage of the screen up to a power of two",
     .parameter = "texels per root of the covered pixels",
     .standard = 2,
     .levels = rc::LevelRatio::two,
     .texels = coveredScreen},
    {.name = "texels_per_pixel",
     .title = "Texels per pixel",
     .source = "engines that give a caster so many texels for each pixel that it is wide; 4/pi is "
               "the documented default of a large one",
     .parameter = "texels per pixel",
     .standard = 4 / std::numbers::pi,
     .texels = texelsPerPixel},
    {.name = "distance",
     .title = "Distance",
     .source = "engines that shrink maps with the distance from the eye",
     .parameter = "texels per radian of the map's extent",
     .standard = 1024,
     .texels = byDistance},
    {.name = "paper",
     .title = "Published rule",
     .source = "Kreuzer, section 6: constant radius, or the maximum over all visible points in "
               "penumbra",
     .parameter = "c",
     .standard = kPublishedSlope,
     .texels = paper},
    {.name = "bounded",
     .title = "Published rule, no finer than pixels",
     .source = "N(p) = min(c / r, k / sigma)",
     .parameter = "c, with c / 3.47 texels per pixel above it",
     .standard = kPublishedSlope,
     .ours = true,
     .texels = bounded},
    {.name = "percentile",
     .title = "Automatic: pixel bound and percentile",
     .source = "98 % of the length of the shadows' edges",
     .parameter = "c, with c / 3.47 texels per pixel above it",
     .standard = kPublishedSlope,
     .ours = true,
     .texels = percentile},
    {.name = "contrast",
     .title = "Automatic, with contrast",
     .source = "c falls with the contrast of the edge as the slope file says",
     .parameter = "c, with c / 3.47 texels per pixel above it",
     .standard = kPublishedSlope,
     .ours = true,
     .texels = contrast},
};

}  // namespace

std::span<const SizingPolicy> sizingPolicies() {
    return kPolicies;
}

const SizingPolicy& findSizingPolicy(std::string_view name) {
    std::string known;
    for (const SizingPolicy& policy : kPolicies) {
        if (policy.name == name) return policy;
        known += (known.empty() ? "" : ", ") + std::string(policy.name);
    }
    throw std::invalid_argument("sizing policy \"" + std::string(name) +
                                "\" is not known; known are: " + known);
}

const SizingPolicy& automaticPolicy() {
    return findSizingPolicy("percentile");
}

int chosenSize(const SizingPolicy& policy, const FrameFacts& facts, double parameter,
               std::span<const int> sizes) {
    const double texels =
        std::clamp(policy.texels(facts, parameter), static_cast<double>(rc::kSmallestLevel),
                   static_cast<double>(rc::kLargestLevel));
    const auto need = static_cast<std::int64_t>(std::ceil(texels));
    const int level = rc::levelAtLeast(need, policy.levels).value_or(rc::kLargestLevel);
    const auto found = std::lower_bound(sizes.begin(), sizes.end(), level);
    return found == sizes.end() ? sizes.back() : *found;
}

std::vector<int> chosenSizes(const SizingPolicy& policy, const FrameFacts& facts,
                             std::span<const double> parameters, std::span<const int> sizes) {
    std::vector<int> chosen(parameters.size());
    if (parameters.empty()) return chosen;
    const auto ask = [&](std::size_t i) {
        chosen[i] = chosenSize(policy, facts, parameters[i], sizes);
    };
    ask(0);
    if (parameters.size() > 1) ask(parameters.size() - 1);
    const std::function<void(std::size_t, std::size_t)> fillBetween = [&](std::size_t first,
                                                                          std::size_t last) {
        if (last - first < 2) return;
        if (chosen[first] == chosen[last])
            return std::fill(&chosen[first + 1], &chosen[last], chosen[first]);
        const std::size_t middle = (first + last) / 2;
        ask(middle);
        fillBetween(first, middle);
        fillBetween(middle, last);
    };
    fillBetween(0, parameters.size() - 1);
    return chosen;
}

}  // namespace demo

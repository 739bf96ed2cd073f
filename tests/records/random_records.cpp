// SPDX-License-Identifier: MIT
#include "tests/records/random_records.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>

namespace tests {

using namespace records;

namespace {

std::uint64_t below(std::mt19937_64& random, std::uint64_t bound) {
    return random() % bound;
}
bool coin(std::mt19937_64& random) {
    return below(random, 2) == 1;
}

// Any finite double: half of them random bit patterns, so every exponent comes up.
double anyNumber(std::mt19937_64& random) {
    if (coin(random)) return static_cast<double>(below(random, 2'000'001)) / 1000 - 1000;
    const auto value = std::bit_cast<double>(random());
    return std::isfinite(value) ? value : 0.1;
}
double positive(std::mt19937_64& random) {
    const double value = std::abs(anyNumber(random));
    return value > 0 ? value : 1;
}
double share(std::mt19937_64& random) {
    return static_cast<double>(random() >> 11) / 9007199254740992.0;
}
double angle(std::mt19937_64& random) {
    return 720 * share(random) - 360;
}

std::string text(std::mt19937_64& random) {
    static const std::string kPieces[] = {"a",    "Z",  "7",  " ", "-",   "\"", "'",
                                          ",",    ";",  "\\", "é", "ß",   "λ",  "日本",
                                          "🙂", "n/", "%",  "#", "<b>", "&"};
    std::string result = "t";
    for (std::uint64_t i = below(random, 8); i > 0; --i)
        result += kPieces[below(random, std::size(kPieces))];
    return result;
}

template <typename Make>
auto maybe(std::mt19937_64& random, Make make) -> std::optional<decltype(make(random))> {
    if (coin(random)) return std::nullopt;
    return make(random);
}

template <typename Words>
auto oneOf(std::mt19937_64& random, const Words& words) {
    return words[below(random, std::size(words))].second;
}

void answer(std::mt19937_64& random, Trial& trial) {
    trial.correct = coin(random);
    if (trial.status != TrialStatus::ok && coin(random)) {
        trial.correct = false;
    } else if (trial.task == Task::twoAfc) {
        trial.response = coin(random) ? Response::left : Response::right;
        if (coin(random))
            trial.side = trial.correct == (trial.response == Response::left) ? "left" : "right";
    } else {
        const bool seen = trial.correct == (trial.type == TrialType::artifact);
        trial.response = seen ? Response::seen : Response::notSeen;
    }
}

Estimate estimate(std::mt19937_64& random) {
    const double value = positive(random);
    Estimate result{.estimate = value, .ci95 = {}};
    if (coin(random)) result.ci95 = Interval{.low = value / 2, .high = value};
    return result;
}

}  // namespace

Trial randomTrial(std::mt19937_64& random, int number, std::size_t extraCells) {
    Trial trial;
    trial.number = number;
    trial.type = oneOf(random, kTrialTypeWords);
    trial.condition = text(random);
    trial.pattern = oneOf(random, kPatternWords);
    trial.angleDeg = maybe(random, angle);
    if (trial.pattern == Pattern::line) trial.angleDeg = angle(random);
    trial.artifactPx = positive(random);
    trial.litLevel = share(random);
    trial.kernel = text(random);
    trial.task = oneOf(random, kTaskWords);
    trial.proposedRadiusPx = maybe(random, positive);
    trial.filterRadiusPx = positive(random);
    trial.status = oneOf(random, kTrialStatusWords);
    answer(random, trial);
    trial.responseTimeS = maybe(random, positive);
    trial.staircase = maybe(random, text);
    trial.encoding = maybe(random, [](auto& r) { return oneOf(r, kEncodingWords); });
    trial.orientationQuarter = maybe(random, [](auto& r) { return static_cast<int>(below(r, 4)); });
    trial.mirror = maybe(random, coin);
    trial.shiftPx = maybe(random, [](auto& r) { return static_cast<int>(below(r, 61)) - 30; });
    trial.tiltDeg = maybe(random, angle);
    trial.onsetS = maybe(random, anyNumber);
    trial.thresholdMean = maybe(random, anyNumber);
    trial.thresholdSd = maybe(random, positive);
    trial.noiseLevels = maybe(random, positive);
    trial.dither = maybe(random, coin);
    trial.imageSeed = maybe(random, [](auto& r) { return static_cast<int>(r() >> 33); });
    trial.frame = maybe(random, text);
    if (coin(random)) trial.clickXPx = trial.clickYPx = positive(random);
    trial.clickDistancePx = maybe(random, positive);
    for (std::size_t i = 0; i < extraCells; ++i)
        trial.extra.push_back(coin(random) ? text(random) : coin(random) ? "n/a" : "");
    return trial;
}

std::vector<Trial> randomTrials(std::mt19937_64& random, int count, std::size_t extraCells) {
    std::vector<Trial> trials;
    for (int number = 1; static_cast<int>(trials.size()) < count;
         number += 1 + static_cast<int>(below(random, 2)))
        trials.push_back(randomTrial(random, number, extraCells));
    return trials;
}

std::string tableText(const std::vector<Trial>& trials,
                      const std::vector<std::string>& extraColumns) {
    std::string table = trialTableHeader(extraColumns) + "\n";
    for (const Trial& trial : trials) table += trialTableRow(trial) + "\n";
    return table;
}

RunContext randomContext(std::mt19937_64& random) {
    RunContext context = currentRunContext(text(random), {text(random), "", text(random)});
    context.seed = maybe(random, [](auto& r) { return std::uint64_t{r()}; });
    context.glRenderer = maybe(random, text);
    context.glVersion = maybe(random, text);
    context.softwareRasteriser = maybe(random, coin);
    context.viewportWidthPx =
        maybe(random, [](auto& r) { return 1 + static_cast<int>(below(r, 4000)); });
    context.viewportHeightPx = context.viewportWidthPx;
    return context;
}

Slope randomSlope(std::mt19937_64& random) {
    Slope slope;
    slope.c = estimate(random);
    slope.cOverall = estimate(random);
    slope.c90 = estimate(random);
    slope.criterion = 0.01 + 0.98 * share(random);
    slope.percentCorrect = 100 * share(random);
    slope.task = oneOf(random, kTaskWords);
    slope.kernel = text(random);
    slope.encoding = maybe(random, [](auto& r) { return oneOf(r, kEncodingWords); });
    slope.beta = positive(random);
    slope.observerSd = share(random);
    slope.observerConditionSd = share(random);
    slope.kappa = estimate(random);
    slope.kappaPValue = maybe(random, share);
    slope.contrastExponent = maybe(random, estimate);
    for (std::uint64_t i = below(random, 5); i > 0; --i)
        slope.groups.push_back({.name = text(random),
                                .pattern = oneOf(random, kPatternWords),
                                .angleDeg = maybe(random, angle),
                                .litLevel = share(random),
                                .c = estimate(random),
                                .trials = static_cast<int>(below(random, 10000))});
    slope.worstGroup = slope.groups.empty() ? text(random) : slope.groups.front().name;
    slope.observers = 1 + static_cast<int>(below(random, 100));
    slope.trials = 1 + static_cast<int>(below(random, 100000));
    slope.pxPerDeg = maybe(random, positive);
    slope.method = text(random) + "\n" + text(random);
    slope.context = randomContext(random);
    return slope;
}

SessionSidecar randomSidecar(std::mt19937_64& random) {
    SessionSidecar sidecar;
    sidecar.context = randomContext(random);
    sidecar.participant = text(random);
    sidecar.session = maybe(random, text);
    sidecar.observer = text(random);
    sidecar.design = {{"name", text(random)},
                      {"sizes", {positive(random), positive(random)}},
                      {"quest", {{"beta", positive(random)}, {"flag", true}, {"none", nullptr}}}};
    sidecar.seed = random();
    sidecar.kernel = text(random);
    sidecar.task = oneOf(random, kTaskWords);
    sidecar.encoding = oneOf(random, kEncodingWords);
    sidecar.beta = positive(random);
    sidecar.criterion = 0.01 + 0.98 * share(random);
    sidecar.displayWidthPx = 1 + static_cast<int>(below(random, 8000));
    sidecar.displayHeightPx = 1 + static_cast<int>(below(random, 8000));
    sidecar.pxPerDeg = maybe(random, positive);
    sidecar.displayGamma = maybe(random, positive);
    sidecar.luminance.black = maybe(random, share);
    sidecar.luminance.grey = maybe(random, [](std::mt19937_64& r) { return 1.5 + 50 * share(r); });
    sidecar.luminance.white = maybe(random, [](std::mt19937_64& r) { return 60 + 500 * share(r); });
    return sidecar;
}

}  // namespace tests

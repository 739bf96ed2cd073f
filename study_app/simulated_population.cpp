// SPDX-License-Identifier: MIT
#include "study_app/simulated_population.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <span>
#include <stdexcept>
#include <string_view>

#include "quest/random.h"
#include "records/number_rule.h"
#include "records/quoted_text.h"
#include "study_app/random_stream.h"

namespace study_app {
namespace {

constexpr std::string_view kName = "simulated";
constexpr double kLeastContrast = 0.02;  // as in the law that the slope file states

// Times of a patient observer, chosen by eye.
constexpr double kPauseS = 0.7, kFastestS = 0.3, kMedianS = 0.6, kSpread = 0.4;

constexpr records::NumberRule kBelowOne{.low = 0, .high = 1, .highIncluded = false};
// Far beyond any observer; more is a slip of the keyboard, and numbers stay readable.
constexpr records::NumberRule kFactor = records::between(0.001, 1000);
constexpr records::NumberRule kExponent = records::between(-10, 10);
constexpr records::NumberRule kSd = records::between(0, 10);
constexpr records::NumberRule kSlope = records::between(0.1, 100);

// Of a simulated click around the place where the artifact is seen, px. Chosen by eye.
constexpr double kClickSdPx = 8;

struct Key {
    std::string_view name;
    double SimulatedPopulation::*member;
    records::NumberRule rule;
    std::string_view meaning;
};

constexpr Key kKeys[] = {
    {"c", &SimulatedPopulation::c, kFactor,
     "slope of r = c a of the mean observer at the criterion"},
    {"kappa", &SimulatedPopulation::kappa, kExponent, "exponent of the artifact size"},
    {"criterion", &SimulatedPopulation::criterion, records::kInsideShare,
     "detection probability F* that c stands for"},
    {"beta", &SimulatedPopulation::beta, kSlope, "psychometric slope"},
    {"lapse", &SimulatedPopulation::lapse, kBelowOne, "share of blind answers"},
    {"false_alarms", &SimulatedPopulation::falseAlarms, kBelowOne,
     "share of \"seen\" without an artifact (yes_no)"},
    {"observer_sd", &SimulatedPopulation::observerSd, kSd, "sd between observers, log10 units"},
    {"condition_sd", &SimulatedPopulation::conditionSd, kSd,
     "sd of observer x condition, log10 units"},
    {"stair", &SimulatedPopulation::stair, kFactor, "factor on c for stairs"},
    {"step", &SimulatedPopulation::step, kFactor, "factor on c for steps"},
    {"line", &SimulatedPopulation::line, kFactor, "factor on c for lines"},
    {"frame", &SimulatedPopulation::frame, kFactor, "factor on c for rendered frames"},
    {"contrast_exponent", &SimulatedPopulation::contrastExponent, kExponent,
     "e of the factor (lit level)^e on c"},
};

[[noreturn]] void fail(const std::string& what, const std::string& rule) {
    throw std::invalid_argument("--observer: " + what + ": " + rule);
}

std::string knownKeys() {
    std::string list;
    for (const Key& key : kKeys) list += (list.empty() ? "" : ", ") + std::string(key.name);
    return list;
}

const Key& keyNamed(std::string_view name) {
    const auto found = std::ranges::find(kKeys, name, &Key::name);
    if (found == std::end(kKeys)) fail(records::quotedText(name), "must be one of " + knownKeys());
    return *found;
}

void readPair(std::string_view pair, SimulatedPopulation& population, std::set<std::string>& seen) {
    const std::size_t equals = pair.find('=');
    if (equals == pair.npos) fail(records::quotedText(pair), "must be key=value");
    const std::string_view name = pair.substr(0, equals), text = pair.substr(equals + 1);
    const Key& key = keyNamed(name);
    if (!seen.insert(std::string(name)).second) fail(std::string(name), "stands twice");
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !key.rule.holds(value)) {
        fail(std::string(name) + ": " + records::quotedText(text), key.rule.text());
    }
    population.*(key.member) = value;
}

double patternFactor(const SimulatedPopulation& population, records::Pattern pattern) {
    switch (pattern) {
        case records::Pattern::stair:
            return population.stair;
        case records::Pattern::step:
            return population.step;
        case records::Pattern::line:
            return population.line;
        case records::Pattern::frame:
            return population.frame;
    }
    throw std::logic_error("study_app: no simulated observer for this pattern");
}

double log10GeometricMean(std::span<const int> sizes) {
    double sum = 0;
    for (const int a : sizes) sum += std::log10(a);
    return sum / static_cast<double>(sizes.size());
}

/// The silhouette passes through the middle of the image, and with it the artifact.
void click(Answer& answer, int windowPx, bool artifact, std::mt19937_64& rng) {
    const auto place = [&] {
        const double px = artifact ? windowPx / 2.0 + kClickSdPx * quest::standardNormal(rng)
                                   : windowPx * quest::uniform01(rng);
        return std::round(std::clamp(px, 0.0, static_cast<double>(windowPx)));
    };
    answer.clickXPx = place();
    answer.clickYPx = place();
}

double wholeMilliseconds(double seconds) {
    return std::round(seconds * 1000) / 1000;
}

}  // namespace

SimulatedPopulation populationFromText(const std::string& text) {
    SimulatedPopulation population;
    std::string_view rest = text;
    if (rest == kName) return population;
    if (!rest.starts_with(std::string(kName) + ":")) {
        fail(records::quotedText(text), "must be simulated or simulated:key=value,...");
    }
    rest.remove_prefix(kName.size() + 1);
    std::set<std::string> seen;
    while (true) {
        const std::size_t comma = rest.find(',');
        readPair(rest.substr(0, comma), population, seen);
        if (comma == rest.npos) return population;
        rest.remove_prefix(comma + 1);
    }
}

std::string toText(const SimulatedPopulation& population) {
    std::string text(kName);
    char separator = ':';
    for (const Key& key : kKeys) {
        text +=
            separator + std::string(key.name) + '=' + records::exactText(population.*key.member);
        separator = ',';
    }
    return text;
}

std::string describeKeys() {
    std::string text;
    for (const Key& key : kKeys) {
        std::string line = "  " + std::string(key.name) + "=" +
                           records::exactText(SimulatedPopulation{}.*key.member);
        line.resize(std::max<std::size_t>(line.size() + 2, 32), ' ');
        text += line + std::string(key.meaning) + "\n";
    }
    return text;
}

SimulatedParticipant drawParticipant(const SimulatedPopulation& population, const Design& design,
                                     std::uint64_t sessionSeed) {
    const bool twoAfc = design.task == records::Task::twoAfc;
    SimulatedParticipant participant{
        .threshold = {},
        .criterion = population.criterion,
        .beta = population.beta,
        .response = {.gamma = twoAfc ? 0.5 : population.falseAlarms, .lapse = population.lapse},
        .seed = sessionSeed};
    std::mt19937_64 rng = engineAt(sessionSeed, Purpose::observer, 0);
    // Frames are met at one size: only r / a is the same at every place of a perspective view.
    const double log10a0 = design.frames ? 0 : log10GeometricMean(design.artifactPx);
    const double u = population.observerSd * quest::standardNormal(rng);
    for (const Condition& condition : conditions(design)) {
        const double v = population.conditionSd * quest::standardNormal(rng);
        const double log10a = design.frames ? 0 : std::log10(condition.artifactPx);
        const double log10c =
            std::log10(population.c * patternFactor(population, condition.silhouette.pattern)) +
            population.contrastExponent * std::log10(std::max(condition.litLevel, kLeastContrast));
        const double log10r0 = log10c + log10a0 + population.kappa * (log10a - log10a0) + u + v;
        participant.threshold.push_back(log10a - log10r0);
    }
    return participant;
}

Answer simulatedAnswer(const SimulatedParticipant& participant, const Session& session,
                       const std::optional<records::Trial>& lastRow) {
    const records::Trial& trial = session.next();
    std::mt19937_64 rng = engineAt(participant.seed, Purpose::answer, session.rows());
    const quest::SimulatedObserver observer{
        .threshold = participant.threshold.at(session.nextCondition()),
        .criterion = participant.criterion,
        .beta = participant.beta,
        .response = participant.response};
    const bool hasArtifact = trial.type == records::TrialType::artifact;
    const std::optional<double> x =
        hasArtifact ? std::optional(quest::strength(trial.artifactPx, trial.filterRadiusPx))
                    : std::nullopt;
    const bool yes = quest::answer(observer, x, rng);

    Answer answer;
    if (trial.task == records::Task::yesNo) {
        answer.response = yes ? records::Response::seen : records::Response::notSeen;
    } else {
        const bool left = (trial.side == "left") == yes;
        answer.response = left ? records::Response::left : records::Response::right;
    }
    const double lastAnswerS =
        lastRow ? lastRow->onsetS.value_or(0) + lastRow->responseTimeS.value_or(0) : 0;
    answer.onsetS = wholeMilliseconds(lastAnswerS + kPauseS);
    answer.responseTimeS =
        wholeMilliseconds(kFastestS + kMedianS * std::exp(kSpread * quest::standardNormal(rng)));
    if (session.design().localise && answer.response == records::Response::seen) {
        click(answer, session.design().windowPx, hasArtifact, rng);
    }
    return answer;
}

double trueSlope(const SimulatedParticipant& participant, std::size_t condition) {
    return quest::radiusAt(1.0, participant.threshold.at(condition));
}

}  // namespace study_app

// SPDX-License-Identifier: MIT
// Simulated observers: a population to draw them from, one drawn observer, and the answers that it
// gives. Together with a design and a seed they make a whole session that is the same every time.
//
// The population is the model that fit_slope estimates (one formula for both tasks): observer i
// reaches the criterion in condition k at the strength x0 = log10 a - log10 r0 with
//
//     log10 r0 = log10(c f_k a0) + kappa log10(a / a0) + u_i + v_ik,
//
// a0 the geometric mean of the design's artifact sizes, f_k = (pattern's factor) max(C, .02)^e at
// lit level C, u_i ~ N(0, observer_sd^2), v_ik ~ N(0, condition_sd^2).
//
// As text, on the command line and in a session's sidecar: "simulated:c=3.47,observer_sd=0.1".
#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "quest/simulated_observer.h"
#include "records/trial_table.h"
#include "study_app/design.h"
#include "study_app/session.h"

namespace study_app {

struct SimulatedPopulation {
    /// Slope of r = c a for the mean observer at the criterion, factor 1. [K] eq. 1.
    double c = 3.47;
    double kappa = 1;                           ///< exponent of the size
    double criterion = quest::kPaperCriterion;  ///< F* that c stands for, (0, 1)
    double beta = 3.5;                          ///< psychometric slope, > 0
    double lapse = 0.02;                        ///< share of blind answers, [0, 1)
    double falseAlarms = 0.03;                  ///< P(seen) without artifact in yes/no, [0, 1)
    double observerSd = 0.10;                   ///< of u, log10 units, >= 0
    double conditionSd = 0.05;                  ///< of v, log10 units, >= 0
    /// Factors on c. [K] hides a stair of a = 10 px at about 25 px: 2.5 / 3.47.
    double stair = 0.72, step = 1, line = 1, frame = 1;
    /// e. "Slightly harder to spot" at half the contrast [K]: 5 %, chosen by eye.
    double contrastExponent = 0.07;

    bool operator==(const SimulatedPopulation&) const = default;
};

/// Reads "simulated" or "simulated:key=value,..."; keys as describeKeys() lists them. Throws
/// std::invalid_argument naming key, value and rule; an unknown or repeated key, other observers.
SimulatedPopulation populationFromText(const std::string& text);

/// All keys with their values, in fixed order; populationFromText reads it back exactly.
std::string toText(const SimulatedPopulation& population);

/// One line per key: name, default, meaning; for --help.
std::string describeKeys();

/// One observer: what a person would bring along.
struct SimulatedParticipant {
    std::vector<double> threshold;  ///< x0 of each condition
    double criterion = quest::kPaperCriterion;
    double beta = 3.5;
    quest::ResponseModel response;
    std::uint64_t seed = 0;
};

/// The observer who sits in the session of this seed.
SimulatedParticipant drawParticipant(const SimulatedPopulation& population, const Design& design,
                                     std::uint64_t sessionSeed);

/// The answer to session.next(). `lastRow` is the row before it (nothing at the start): times go on
/// from there, in whole milliseconds, as if a person sat there: 0.7 s until the first stimulus and
/// from an answer to the next, answers after 0.3 s + a log-normal time around 0.6 s. The times
/// carry no information; they depend on the seed alone. Where the design localises, "seen" comes
/// with a click: near the middle of the image where the artifact was seen, anywhere for a guess.
Answer simulatedAnswer(const SimulatedParticipant& participant, const Session& session,
                       const std::optional<records::Trial>& lastRow);

/// c of the participant in a condition, at the criterion of the population.
double trueSlope(const SimulatedParticipant& participant, std::size_t condition);

}  // namespace study_app

// SPDX-License-Identifier: MIT
// Studies whose truth is known: simulated observers under QUEST staircases, as tables. Independent
// of study_app, so that fit and study program can be tested apart.
#pragma once

#include <cstdint>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "analysis/study.h"
#include "records/trial_table.h"

namespace tests {

struct SimulatedGroup {
    records::Pattern pattern = records::Pattern::stair;
    double litLevel = 1;
    double log10c = 0.54;  ///< of the mean observer, at a = 10 where kappa is not 1
};

struct StudyPlan {
    std::string name = {};
    int observers = 10;
    std::vector<SimulatedGroup> groups = {{}};
    std::vector<double> sizes = {5, 10, 20, 30};
    int trials = 40;  ///< per condition
    double tau = 0.1, omega = 0.05;
    double beta = 3.5, lapse = 0.02;
    double kappa = 1;
    bool yesNo = false;
    double falseAlarms = 0.04;  ///< yes/no: every observer's rate
    int references = 40;        ///< yes/no: artifact-free trials of each observer
    int guessing = 0;           ///< the first so many observers press at random
    int catchTrials = 0;        ///< 2AFC: of each observer, in the first condition
};

/// Stair and step at two lit levels, 16 conditions.
std::vector<SimulatedGroup> fourGroups(double stair, double stairHalf, double step,
                                       double stepHalf);

std::vector<records::TrialTable> simulateTables(const StudyPlan& plan, std::mt19937_64& rng);
analysis::Study simulateStudy(const StudyPlan& plan, std::uint64_t seed);

/// One flat file per observer.
void writeTables(const std::vector<records::TrialTable>& tables,
                 const std::filesystem::path& folder);

}  // namespace tests

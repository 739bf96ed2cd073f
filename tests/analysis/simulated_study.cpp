// SPDX-License-Identifier: MIT
#include "tests/analysis/simulated_study.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "quest/quest.h"
#include "quest/random.h"
#include "quest/simulated_observer.h"
#include "records/whole_file.h"

namespace tests {
namespace {

using records::Trial;
using records::TrialTable;

Trial artifactTrial(const StudyPlan& plan, const SimulatedGroup& group, double size, double radius,
                    bool yes) {
    Trial trial;
    trial.condition = std::string(records::toText(group.pattern)) + "-a" +
                      std::to_string(static_cast<int>(size)) + "-lit" +
                      std::to_string(static_cast<int>(100 * group.litLevel));
    trial.pattern = group.pattern;
    trial.artifactPx = size;
    trial.litLevel = group.litLevel;
    trial.kernel = "disc";
    trial.task = plan.yesNo ? records::Task::yesNo : records::Task::twoAfc;
    trial.filterRadiusPx = radius;
    trial.encoding = records::Encoding::srgb;
    if (plan.yesNo) {
        trial.response = yes ? records::Response::seen : records::Response::notSeen;
    } else {
        trial.response = records::Response::left;
        trial.side = yes ? "left" : "right";
    }
    trial.correct = yes;
    return trial;
}

void runStaircase(const StudyPlan& plan, const SimulatedGroup& group, double size,
                  const quest::SimulatedObserver& observer, std::mt19937_64& rng,
                  TrialTable& table) {
    quest::QuestParameters parameters = quest::kDefaultParameters;
    if (plan.yesNo) parameters = quest::forYesNo(parameters, plan.falseAlarms);
    quest::Quest staircase(parameters);
    for (int t = 0; t < plan.trials; ++t) {
        const double proposed = quest::radiusAt(size, staircase.quantile());
        const double radius = std::max(1.0, std::round(proposed * 4) / 4);
        const bool yes = quest::answer(observer, quest::strength(size, radius), rng);
        staircase.update(quest::strength(size, radius), yes ? 1 : 0);
        Trial trial = artifactTrial(plan, group, size, radius, yes);
        trial.proposedRadiusPx = proposed;
        trial.staircase = trial.condition;
        table.trials.push_back(trial);
    }
}

void addCatchTrials(const StudyPlan& plan, const quest::SimulatedObserver& observer,
                    std::mt19937_64& rng, TrialTable& table) {
    const double size = plan.sizes.back();
    for (int t = 0; !plan.yesNo && t < plan.catchTrials; ++t) {
        const bool yes = quest::answer(observer, quest::strength(size, 1.0), rng);
        table.trials.push_back(artifactTrial(plan, plan.groups.front(), size, 1.0, yes));
    }
    for (int t = 0; plan.yesNo && t < plan.references; ++t) {
        const bool seen = quest::answer(observer, std::nullopt, rng);
        Trial trial = artifactTrial(plan, plan.groups.front(), size, 20.0, seen);
        trial.type = records::TrialType::reference;
        trial.correct = !seen;
        table.trials.push_back(trial);
    }
}

}  // namespace

std::vector<SimulatedGroup> fourGroups(double stair, double stairHalf, double step,
                                       double stepHalf) {
    return {{records::Pattern::stair, 1.0, stair},
            {records::Pattern::stair, 0.5, stairHalf},
            {records::Pattern::step, 1.0, step},
            {records::Pattern::step, 0.5, stepHalf}};
}

std::vector<TrialTable> simulateTables(const StudyPlan& plan, std::mt19937_64& rng) {
    std::vector<TrialTable> tables;
    for (int i = 0; i < plan.observers; ++i) {
        TrialTable table;
        char id[16];
        std::snprintf(id, sizeof id, "%03d", i + 1);
        table.participant = id;
        table.file = "sub-" + table.participant + "_task-hideartifact_beh.tsv";
        const double u = plan.tau * quest::standardNormal(rng);
        const double gamma = plan.yesNo ? plan.falseAlarms : 0.5;
        quest::SimulatedObserver observer{.beta = plan.beta,
                                          .response = {gamma, plan.lapse, gamma}};
        if (i < plan.guessing) observer.response = {0.5, 0.999999, 0.5};
        for (const SimulatedGroup& group : plan.groups) {
            for (const double size : plan.sizes) {
                const double v = plan.omega * quest::standardNormal(rng);
                const double bend = (plan.kappa - 1) * std::log10(size / 10);
                observer.threshold = -(group.log10c + bend + u + v);
                runStaircase(plan, group, size, observer, rng, table);
            }
        }
        addCatchTrials(plan, observer, rng, table);
        for (std::size_t t = 0; t < table.trials.size(); ++t) {
            table.trials[t].number = static_cast<int>(t) + 1;
        }
        tables.push_back(std::move(table));
    }
    return tables;
}

analysis::Study simulateStudy(const StudyPlan& plan, std::uint64_t seed) {
    std::mt19937_64 rng(seed);
    return analysis::studyOf(simulateTables(plan, rng));
}

void writeTables(const std::vector<TrialTable>& tables, const std::filesystem::path& folder) {
    for (const TrialTable& table : tables) {
        std::string text = records::trialTableHeader(table.extraColumns) + "\n";
        for (const Trial& trial : table.trials) text += records::trialTableRow(trial) + "\n";
        records::writeWholeFile(folder / table.file.filename(), text);
    }
}

}  // namespace tests

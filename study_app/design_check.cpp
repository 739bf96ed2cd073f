// SPDX-License-Identifier: MIT
#include "study_app/design_check.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <stdexcept>

#include "quest/psychometric.h"
#include "quest/quest.h"
#include "study_app/session.h"
#include "study_app/session_report.h"
#include "study_app/simulated_study.h"

namespace study_app {
namespace {

/// Mean and deviation of numbers that come one by one (B. P. Welford 1962).
class Spread {
  public:
    void add(double value) {
        ++count_;
        const double step = value - mean_;
        mean_ += step / count_;
        squares_ += step * (value - mean_);
    }
    double mean() const { return mean_; }
    double sd() const { return count_ > 1 ? std::sqrt(squares_ / (count_ - 1)) : 0; }

  private:
    int count_ = 0;
    double mean_ = 0, squares_ = 0;
};

/// The condition's name without its size.
std::string groupOf(const Condition& condition) {
    std::string name = condition.name;
    if (!condition.frames.empty()) return name;
    const std::string size = "-a" + std::to_string(condition.artifactPx);
    return name.erase(name.find(size), size.size());
}

bool beyond(const records::Trial& trial, const StrengthRange& range) {
    if (!trial.proposedRadiusPx) return false;
    const double x = quest::strength(trial.artifactPx, *trial.proposedRadiusPx);
    return x < range.weakest || x > range.strongest;
}

struct Tally {
    Spread log10c, error;
    int proposals = 0, beyondLimits = 0;
};

/// One simulated session, into the tallies; returns log10 c of each condition.
std::vector<double> simulate(const Design& design, const SimulatedPopulation& population,
                             std::uint64_t seed, std::vector<Tally>& tallies) {
    Session session(design, seed);
    const SimulatedParticipant observer = drawParticipant(population, design, seed);
    std::optional<records::Trial> last;
    while (!session.finished()) {
        const std::size_t k = session.nextCondition();
        if (!session.nextIsCatch()) {
            ++tallies[k].proposals;
            const StrengthRange range = strengthRange(design, session.conditions()[k]);
            if (beyond(session.next(), range)) ++tallies[k].beyondLimits;
        }
        last = session.answer(simulatedAnswer(observer, session, last));
    }
    // The staircase's threshold is where its own criterion is met, the observer's where theirs is.
    const quest::QuestParameters q = staircaseParameters(design);
    const double shift = quest::criterionOffset(quest::criterion(q), observer.beta) -
                         quest::criterionOffset(observer.criterion, observer.beta);
    std::vector<double> log10c;
    for (std::size_t k = 0; k < tallies.size(); ++k) {
        const double x0 = session.staircase(k).mean();
        log10c.push_back(-x0);
        tallies[k].log10c.add(-x0);
        tallies[k].error.add(x0 - (observer.threshold[k] + shift));
    }
    return log10c;
}

template <typename... Values>
std::string formatted(const char* format, Values... values) {
    char text[200];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

/// A deviation in log10 units as a share of the value.
double percent(double log10Sd) {
    return 100 * std::numbers::ln10 * log10Sd;
}

}  // namespace

DesignCheck checkDesign(const Design& design, const SimulatedPopulation& population,
                        std::uint64_t seed, const std::function<void()>& onSession) {
    const std::vector<Condition> all = conditions(design);
    std::vector<Tally> tallies(all.size());
    std::map<std::string, Spread> groups;
    for (int i = 0; i < kCheckSessions; ++i) {
        const auto log10c = simulate(design, population,
                                     participantSeed(seed, static_cast<std::size_t>(i)), tallies);
        std::map<std::string, Spread> means;
        for (std::size_t k = 0; k < all.size(); ++k) means[groupOf(all[k])].add(log10c[k]);
        for (const auto& [name, mean] : means) groups[name].add(mean.mean());
        if (onSession) onSession();
    }
    DesignCheck check;
    int proposals = 0, beyondLimits = 0;
    for (std::size_t k = 0; k < all.size(); ++k) {
        const Tally& t = tallies[k];
        const StrengthRange range = strengthRange(design, all[k]);
        check.conditions.push_back(
            {.name = all[k].name,
             .c = std::pow(10, t.log10c.mean()),
             .errorSd = t.error.sd(),
             .spreadSd = t.log10c.sd(),
             .beyondLimits = static_cast<double>(t.beyondLimits) / t.proposals,
             .leastC = quest::radiusAt(1, range.strongest),
             .mostC = quest::radiusAt(1, range.weakest)});
        proposals += t.proposals;
        beyondLimits += t.beyondLimits;
    }
    check.beyondLimits = static_cast<double>(beyondLimits) / proposals;
    for (const Condition& condition : all) {
        const std::string name = groupOf(condition);
        if (std::ranges::find(check.groups, name, &GroupCheck::name) != check.groups.end())
            continue;
        const Spread& spread = groups[name];
        check.groups.push_back(
            {.name = name, .c = std::pow(10, spread.mean()), .spreadSd = spread.sd()});
    }
    return check;
}

std::string checkText(const DesignCheck& check, const Design& design, int observers) {
    const quest::QuestParameters q = staircaseParameters(design);
    std::string text =
        design.name + formatted(": %zu %s, %d trials (%d of them catch trials), about %d min\n",
                                check.conditions.size(),
                                check.conditions.size() == 1 ? "condition" : "conditions",
                                totalTrials(design), catchTrials(design), expectedMinutes(design));
    text += formatted("%d sessions simulated; c = r / a at criterion F* = %.4g\n\n", kCheckSessions,
                      quest::criterion(q));
    std::vector<std::vector<std::string>> rows{
        {"condition", "c", "sd of a threshold", "beyond limits", "shows c"}};
    for (const ConditionCheck& c : check.conditions) {
        rows.push_back({c.name, formatted("%.2f", c.c),
                        formatted("%.3f log10, %.0f %%", c.errorSd, percent(c.errorSd)),
                        formatted("%.0f %%", 100 * c.beyondLimits),
                        formatted("%.3g to %.3g", c.leastC, c.mostC)});
    }
    text += aligned(rows) + "\n";
    rows = {{"slope", "c", formatted("sd with %d observers", observers), "95 % interval"}};
    for (const GroupCheck& g : check.groups) {
        const double sd = g.spreadSd / std::sqrt(observers);
        rows.push_back({g.name, formatted("%.2f", g.c),
                        formatted("%.3f, %.1f %%", g.c * std::numbers::ln10 * sd, percent(sd)),
                        formatted("%.2f to %.2f", g.c * std::pow(10, -1.96 * sd),
                                  g.c * std::pow(10, 1.96 * sd))});
    }
    text += aligned(rows);
    for (const ConditionCheck& c : check.conditions) {
        if (c.beyondLimits <= kLimitShare) continue;
        text += "warning: " + c.name +
                formatted(
                    ": %.0f %% of the proposals cannot be shown, more than %.0f %%: the "
                    "threshold will be a bound\n",
                    100 * c.beyondLimits, 100 * kLimitShare);
    }
    return text;
}

std::string visibleRangeText(const Design& design, double pxPerDeg) {
    const double arcMinutesPerPx = 60 / pxPerDeg;
    std::string text = formatted(
        "At %.1f px per degree a pixel is %.2f arc minutes, a stimulus %.1f degrees wide.\n",
        pxPerDeg, arcMinutesPerPx, design.windowPx / pxPerDeg);
    if (design.frames) return text;
    text += formatted("Radii of %g to %g px are %.1f arc minutes to %.1f degrees.\n",
                      design.radius.min, design.radius.max, design.radius.min * arcMinutesPerPx,
                      design.radius.max / pxPerDeg);
    for (const int a : design.artifactPx) {
        text += formatted("Steps of %d px are %.1f arc minutes.\n", a, a * arcMinutesPerPx);
    }
    return text;
}

}  // namespace study_app

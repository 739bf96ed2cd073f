// SPDX-License-Identifier: MIT
#include "analysis/study.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <tuple>

#include "analysis/factors.h"
#include "records/json_fields.h"
#include "records/session_sidecar.h"

namespace analysis {
namespace {

using records::Pattern;
using records::Task;
using records::Trial;
using records::TrialTable;
using records::TrialType;

bool isFactor(const std::vector<std::string>& factors, const std::string& name) {
    return std::find(factors.begin(), factors.end(), name) != factors.end();
}

std::string numberText(double value) {
    std::ostringstream out;
    out << std::setprecision(6) << value;
    return out.str();
}

std::string where(const TrialTable& table, const Trial& trial) {
    return table.file.string() + ", trial " + std::to_string(trial.number);
}

// Groups in the order of reports: stair, step, lines by angle, frames; then falling lit level.
// Frames: one group per condition, which is a scene at one radius; its artifact size varies from
// trial to trial and is found when all are there (meanArtifact).
struct GroupKey {
    Pattern pattern;
    double angle, negativeLit;  // of a line, else -1
    std::string frames;
    std::vector<std::string> levels;  // of the factors asked for
    auto operator<=>(const GroupKey&) const = default;
};
using ConditionKey = std::pair<GroupKey, double>;

ConditionKey keyOf(const Trial& trial, std::vector<std::string> levels) {
    if (trial.pattern == Pattern::frame)
        return {{trial.pattern, -1.0, -trial.litLevel, trial.condition, std::move(levels)}, 0.0};
    const double angle = trial.pattern == Pattern::line ? trial.angleDeg.value_or(-1.0) : -1.0;
    return {{trial.pattern, angle, -trial.litLevel, "", std::move(levels)}, trial.artifactPx};
}

// Without the factors' levels.
std::string kindName(const GroupKey& key) {
    const auto& [pattern, angle, negativeLit, frames, levels] = key;
    std::string name(records::toText(pattern));
    if (!frames.empty()) name.append(" ").append(frames);
    if (angle >= 0) name.append(" ").append(numberText(angle)).append(" deg");
    return name.append(", lit ").append(numberText(-negativeLit));
}

std::string groupName(const GroupKey& key, const std::vector<std::string>& factors) {
    std::string name = kindName(key);
    for (std::size_t f = 0; f < factors.size(); ++f) {
        name.append(", ").append(factors[f]).append(" ").append(key.levels[f]);
    }
    return name;
}

// What every trial of one fit must share.
struct Shared {
    std::string property, value, where;
    bool divided = false;  // by a factor asked for

    void require(const std::string& found, const std::string& place) {
        if (divided) return;
        if (where.empty()) {
            value = found;
            where = place;
        } else if (found != value) {
            throw std::runtime_error(place + ": " + property + " " + found + ", but " + where +
                                     " has " + value + ": a slope stands for one " + property +
                                     (property == "task" ? "; fit the tables apart"
                                                         : "; fit the tables apart, or divide "
                                                           "the groups by it: --by " +
                                                               property));
        }
    }
};

// Counts of what is left out of a table, by reason.
class LeftOut {
  public:
    void add(const std::string& reason) { ++counts_[reason]; }
    void report(const std::string& file, std::vector<std::string>& notices) const {
        for (const auto& [reason, count] : counts_) {
            notices.push_back(file + ": " + std::to_string(count) +
                              (count == 1 ? " trial" : " trials") + " left out: " + reason);
        }
    }

  private:
    std::map<std::string, int> counts_;
};

// Trials by observer and condition, before indices are given.
struct Gathered {
    struct Person {
        std::map<ConditionKey, std::vector<StudyTrial>> cells;
        // Last posterior means of x0 by staircase (of a session).
        std::map<ConditionKey, std::map<std::string, double>> staircases;
        int references = 0, falseAlarms = 0, catchTrials = 0, catchFailures = 0;
    };
    std::map<std::string, Person> people;
    std::map<ConditionKey, std::set<double>> angles;         // as its trials give them
    std::map<ConditionKey, std::vector<double>> frameSizes;  // artifact of every trial, px
    struct Shown {
        std::string kernel;
        std::optional<records::Encoding> encoding;
    };
    std::map<GroupKey, Shown> shown;
    Shared task{"task", {}, {}}, kernel{"kernel", {}, {}}, encoding{"encoding", {}, {}};
};

// Of frames the law's r / a is kept, and lengths follow once the condition's size is known.
double unitOf(const Trial& trial) {
    return trial.pattern == Pattern::frame ? trial.artifactPx : 1;
}

std::optional<double> proposedIn(double unit, const Trial& trial) {
    if (!trial.proposedRadiusPx) return std::nullopt;
    return *trial.proposedRadiusPx / unit;
}

// Conditions of frames get the geometric mean of the sizes that were shown, and the radii that make
// the same r / a there.
std::map<ConditionKey, double> settleFrameSizes(Gathered& gathered) {
    std::map<ConditionKey, double> sizes;
    for (const auto& [key, all] : gathered.frameSizes) {
        double sum = 0;
        for (const double a : all) sum += std::log(a);
        sizes[key] = std::exp(sum / static_cast<double>(all.size()));
    }
    for (auto& [id, person] : gathered.people) {
        for (auto& [key, trials] : person.cells) {
            if (!sizes.contains(key)) continue;
            for (StudyTrial& trial : trials) {
                trial.radiusPx *= sizes[key];
                if (trial.proposedPx) *trial.proposedPx *= sizes[key];
            }
        }
    }
    return sizes;
}

constexpr double kMostLog10Ratio = 4;  // |log10(r/a)|: a slip of the pen, not a stimulus

void gather(const TrialTable& table, const std::vector<std::string>& factors, Gathered& into,
            std::vector<std::string>& notices) {
    LeftOut leftOut;
    const FactorReader reader(table, factors);
    const bool noiseDivides = isFactor(factors, "noise_levels");
    const bool staircases =
        std::any_of(table.trials.begin(), table.trials.end(),
                    [](const Trial& trial) { return trial.staircase.has_value(); });
    Gathered::Person& person = into.people[table.participant];
    for (const Trial& trial : table.trials) {
        if (trial.status != records::TrialStatus::ok) {
            leftOut.add("status " + std::string(records::toText(trial.status)));
            continue;
        }
        if (!noiseDivides && trial.noiseLevels.value_or(0) > 0) {
            leftOut.add("image noise was added (noise_levels > 0; --by noise keeps them)");
            continue;
        }
        const std::string place = where(table, trial);
        into.task.require(std::string(records::toText(trial.task)), place);
        into.kernel.require(trial.kernel, place);
        into.encoding.require(
            trial.encoding ? std::string(records::toText(*trial.encoding)) : "n/a", place);
        const bool yesNo = trial.task == Task::yesNo;
        if (trial.type == TrialType::reference) {
            if (!yesNo) {
                leftOut.add("a reference trial in 2AFC tests nothing");
                continue;
            }
            ++person.references;
            person.falseAlarms += trial.response == records::Response::seen ? 1 : 0;
            continue;
        }
        if (!(trial.litLevel > 0)) {
            leftOut.add("lit level 0 shows no edge");
            continue;
        }
        if (!(std::abs(std::log10(trial.filterRadiusPx / trial.artifactPx)) <= kMostLog10Ratio)) {
            leftOut.add("no display shows such a radius beside such an artifact (r/a beyond 1e4)");
            continue;
        }
        const bool catchTrial = !yesNo && staircases && !trial.staircase;
        const bool yes = yesNo ? trial.response == records::Response::seen : trial.correct;
        if (catchTrial) {
            ++person.catchTrials;
            person.catchFailures += yes ? 0 : 1;
        }
        const ConditionKey key = keyOf(trial, reader.levels(trial));
        into.shown[key.first] = {trial.kernel, trial.encoding};
        if (trial.pattern == Pattern::frame) into.frameSizes[key].push_back(trial.artifactPx);
        person.cells[key].push_back({.radiusPx = trial.filterRadiusPx / unitOf(trial),
                                     .proposedPx = proposedIn(unitOf(trial), trial),
                                     .yes = yes,
                                     .catchTrial = catchTrial});
        if (trial.staircase && trial.thresholdMean) {
            person.staircases[key][table.session.value_or("") + "/" + *trial.staircase] =
                *trial.thresholdMean;
        }
        if (trial.angleDeg) into.angles[key].insert(*trial.angleDeg);
    }
    leftOut.report(table.file.string(), notices);
}

void refuseTwice(std::span<const TrialTable> tables) {
    std::map<std::pair<std::string, std::string>, std::filesystem::path> seen;
    for (const TrialTable& table : tables) {
        const auto [at, isNew] =
            seen.insert({{table.participant, table.session.value_or("")}, table.file});
        if (!isNew) {
            throw std::runtime_error(table.file.string() + ": participant " + table.participant +
                                     (table.session ? ", session " + *table.session : "") +
                                     " is also in " + at->second.string() +
                                     ": two observers must not share an id");
        }
    }
}

std::optional<double> meanSlope(const std::map<std::string, double>& thresholds) {
    if (thresholds.empty()) return std::nullopt;
    double sum = 0;
    for (const auto& [staircase, threshold] : thresholds) sum -= threshold;
    return sum / static_cast<double>(thresholds.size());
}

Study indexed(Gathered&& gathered, const std::vector<std::string>& factors) {
    Study study;
    study.factors = factors;
    const std::map<ConditionKey, double> frameSizes = settleFrameSizes(gathered);
    std::map<ConditionKey, std::size_t> conditionIndex;
    for (const auto& [id, person] : gathered.people) {
        for (const auto& [key, trials] : person.cells) conditionIndex[key] = 0;
    }
    const auto only = [](const std::set<double>& angles) {
        return angles.size() == 1 ? std::optional(*angles.begin()) : std::nullopt;
    };
    std::map<GroupKey, std::size_t> groupIndex;
    std::vector<std::set<double>> groupAngles;
    for (auto& [key, index] : conditionIndex) {  // sorted: groups come in one piece
        const auto [at, isNew] = groupIndex.insert({key.first, study.groups.size()});
        if (isNew) {
            study.groups.push_back({.name = groupName(key.first, factors),
                                    .pattern = key.first.pattern,
                                    .angleDeg = {},
                                    .litLevel = -key.first.negativeLit,
                                    .kind = kindName(key.first),
                                    .levels = key.first.levels,
                                    .kernel = gathered.shown[key.first].kernel,
                                    .encoding = gathered.shown[key.first].encoding});
            groupAngles.emplace_back();
        }
        const std::set<double>& angles = gathered.angles[key];
        groupAngles.back().insert(angles.begin(), angles.end());
        index = study.conditions.size();
        const auto size = frameSizes.find(key);
        study.conditions.push_back(
            {.group = at->second,
             .artifactPx = size == frameSizes.end() ? key.second : size->second,
             .angleDeg = only(angles)});
    }
    for (std::size_t g = 0; g < study.groups.size(); ++g) {
        study.groups[g].angleDeg = only(groupAngles[g]);
    }
    for (auto& [id, person] : gathered.people) {
        if (person.cells.empty()) {
            study.notices.push_back("participant " + id + " has no trial to fit: left out");
            continue;
        }
        Observer observer{.id = id,
                          .cells = {},
                          .references = person.references,
                          .falseAlarms = person.falseAlarms,
                          .catchTrials = person.catchTrials,
                          .catchFailures = person.catchFailures};
        for (auto& [key, trials] : person.cells) {
            observer.cells.push_back({.condition = conditionIndex[key],
                                      .trials = std::move(trials),
                                      .staircaseLog10c = meanSlope(person.staircases[key])});
        }
        study.observers.push_back(std::move(observer));
    }
    return study;
}

using Sidecars = std::vector<std::optional<records::SessionSidecar>>;

Sidecars readSidecars(std::span<const TrialTable> tables) {
    Sidecars sidecars;
    for (const TrialTable& table : tables) {
        const std::filesystem::path file = records::sidecarPath(table.file);
        if (std::filesystem::exists(file)) {
            sidecars.emplace_back(records::readSidecar(file));
        } else {
            sidecars.emplace_back();
        }
    }
    return sidecars;
}

// What may differ between sessions of one study: words, and which of its conditions a session ran,
// as one that runs a condition again does.
bool isFree(const std::string& field) {
    return field == "description" || field == "only_conditions";
}

// The first field in which two normalised designs differ, with both values; "" for one design.
std::string designDifference(const nlohmann::json& one, const nlohmann::json& other) {
    for (const auto& [field, value] : one.items()) {
        if (isFree(field)) continue;
        const std::string there = other.contains(field) ? other.at(field).dump() : "nothing";
        if (there != value.dump()) return field + " " + value.dump() + ", but %s has " + there;
    }
    for (const auto& [field, value] : other.items()) {
        if (!isFree(field) && !one.contains(field)) {
            return field + " nothing, but %s has " + value.dump();
        }
    }
    return "";
}

void refuseMixedDesigns(std::span<const TrialTable> tables, const Sidecars& sidecars) {
    std::optional<std::size_t> first;
    for (std::size_t t = 0; t < tables.size(); ++t) {
        if (!sidecars[t]) continue;
        if (!first) first = t;
        std::string difference = designDifference(sidecars[t]->design, sidecars[*first]->design);
        if (difference.empty()) continue;
        difference.replace(difference.find("%s"), 2, tables[*first].file.string());
        throw std::runtime_error(tables[t].file.string() + ": its design has " + difference +
                                 ": a fit stands for one design; fit the tables apart, or divide "
                                 "the groups by it: --by design");
    }
}

// Absent in a design from elsewhere.
std::optional<ScreeningLimits> screeningOf(const nlohmann::json& design, const std::string& file) {
    if (!design.is_object() || !design.contains("screening")) return std::nullopt;
    const records::JsonFields fields(design["screening"], file, "stairwell.design.screening");
    return ScreeningLimits{fields.number("false_alarm_rate", records::between(0, 1)),
                           fields.number("catch_failure_share", records::between(0, 1))};
}

// What the sidecars say, as far as every table has one.
void addFromSidecars(std::span<const TrialTable> tables, const Sidecars& sidecars, Study& study) {
    double sum = 0;
    bool everyGeometry = true;
    std::vector<StaircaseTerms> terms;
    std::vector<std::optional<ScreeningLimits>> limits;
    for (std::size_t t = 0; t < sidecars.size(); ++t) {
        const auto& sidecar = sidecars[t];
        if (!sidecar) return;
        everyGeometry = everyGeometry && sidecar->pxPerDeg;
        sum += sidecar->pxPerDeg.value_or(0);
        terms.push_back({sidecar->criterion, sidecar->beta});
        limits.push_back(
            screeningOf(sidecar->design, records::sidecarPath(tables[t].file).string()));
    }
    if (everyGeometry) study.pxPerDeg = sum / static_cast<double>(sidecars.size());
    const bool equal = std::all_of(terms.begin(), terms.end(),
                                   [&](const StaircaseTerms& one) { return one == terms.front(); });
    if (equal) study.staircases = terms.front();
    const bool sameLimits = std::all_of(limits.begin(), limits.end(),
                                        [&](const auto& one) { return one == limits.front(); });
    if (sameLimits) study.screening = limits.front();
}

}  // namespace

Study studyOf(std::span<const TrialTable> tables, std::span<const std::string> by) {
    refuseTwice(tables);
    const std::vector<std::string> factors = factorNames(by);
    Gathered gathered;
    gathered.kernel.divided = isFactor(factors, "kernel");
    gathered.encoding.divided = isFactor(factors, "encoding");
    std::vector<std::string> notices;
    for (const TrialTable& table : tables) {
        notices.insert(notices.end(), table.notices.begin(), table.notices.end());
        gather(table, factors, gathered, notices);
    }
    const std::string task = gathered.task.value;
    Study study = indexed(std::move(gathered), factors);
    study.notices.insert(study.notices.begin(), notices.begin(), notices.end());
    if (study.observers.empty()) {
        const std::string first = tables.empty() ? "" : tables.front().file.string() + ": ";
        std::string why;
        for (const std::string& notice : study.notices) why += "; " + notice;
        throw std::runtime_error(first + std::to_string(tables.size()) +
                                 (tables.size() == 1 ? " table" : " tables") +
                                 " without a trial to fit: at least one artifact trial with status "
                                 "ok is needed" +
                                 why);
    }
    study.task = *records::taskFromText(task);
    for (const Group& group : study.groups) {
        if (study.kernel.find(group.kernel) == std::string::npos) {
            study.kernel += (study.kernel.empty() ? "" : ", ") + group.kernel;
        }
    }
    study.encoding = study.groups.front().encoding;
    for (const Group& group : study.groups) {
        if (group.encoding != study.encoding) study.encoding.reset();
    }
    for (const TrialTable& table : tables) study.files.push_back(table.file);
    return study;
}

Study loadStudy(std::span<const std::filesystem::path> paths, std::span<const std::string> by) {
    std::map<std::filesystem::path, std::filesystem::path> files;  // canonical, as given
    for (const std::filesystem::path& path : paths) {
        const auto found = records::findTrialTables(path);
        // One file reached by two spellings of its path is one table.
        for (const std::filesystem::path& file : found)
            files.try_emplace(std::filesystem::weakly_canonical(file), file);
    }
    std::vector<TrialTable> tables;
    for (const auto& [canonical, file] : files) tables.push_back(records::readTrialTable(file));
    const std::vector<std::string> factors = factorNames(by);
    const Sidecars sidecars = readSidecars(tables);
    if (!isFactor(factors, "design")) refuseMixedDesigns(tables, sidecars);
    addFactorColumns(tables, sidecars, factors);
    Study study = studyOf(tables, factors);
    addFromSidecars(tables, sidecars, study);
    return study;
}

double guessingRate(const Observer& observer, Task task) {
    if (task == Task::twoAfc) return 0.5;
    return (observer.falseAlarms + 0.5) / (observer.references + 1.0);
}

int trialCount(const Study& study) {
    int count = 0;
    for (std::size_t g = 0; g < study.groups.size(); ++g) count += trialCount(study, g);
    return count;
}

int trialCount(const Study& study, std::size_t group) {
    std::size_t count = 0;
    for (const Observer& observer : study.observers) {
        for (const Cell& cell : observer.cells) {
            if (study.conditions[cell.condition].group == group) count += cell.trials.size();
        }
    }
    return static_cast<int>(count);
}

double referenceArtifactPx(const Study& study) {
    std::set<double> sizes;
    for (const Condition& condition : study.conditions) sizes.insert(condition.artifactPx);
    double sum = 0;
    for (const double size : sizes) sum += std::log(size);
    return std::exp(sum / static_cast<double>(sizes.size()));
}

std::string conditionName(const Study& study, std::size_t index) {
    const Condition& condition = study.conditions[index];
    return study.groups[condition.group].name + ", a " + numberText(condition.artifactPx);
}

Study subset(const Study& study, const std::vector<bool>& keepObserver,
             const std::vector<bool>& keepCondition) {
    Study kept = study;
    kept.observers.clear();
    std::vector<bool> used(study.conditions.size(), false);
    for (std::size_t i = 0; i < study.observers.size(); ++i) {
        if (!keepObserver[i]) continue;
        Observer observer = study.observers[i];
        std::erase_if(observer.cells,
                      [&](const Cell& cell) { return !keepCondition[cell.condition]; });
        if (observer.cells.empty()) continue;
        for (const Cell& cell : observer.cells) used[cell.condition] = true;
        kept.observers.push_back(std::move(observer));
    }
    kept.groups.clear();
    kept.conditions.clear();
    std::vector<std::size_t> newCondition(study.conditions.size()), newGroup(study.groups.size());
    std::vector<bool> groupSeen(study.groups.size(), false);
    for (std::size_t k = 0; k < study.conditions.size(); ++k) {
        if (!used[k]) continue;
        const std::size_t group = study.conditions[k].group;
        if (!groupSeen[group]) {
            groupSeen[group] = true;
            newGroup[group] = kept.groups.size();
            kept.groups.push_back(study.groups[group]);
        }
        newCondition[k] = kept.conditions.size();
        kept.conditions.push_back(study.conditions[k]);
        kept.conditions.back().group = newGroup[group];
    }
    for (Observer& observer : kept.observers) {
        for (Cell& cell : observer.cells) cell.condition = newCondition[cell.condition];
    }
    return kept;
}

}  // namespace analysis

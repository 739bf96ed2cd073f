// SPDX-License-Identifier: MIT
#include "analysis/factors.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <stdexcept>

#include "records/participants_table.h"
#include "records/quoted_text.h"
#include "records/trial_columns.h"

namespace analysis {
namespace {

namespace fs = std::filesystem;
using records::TrialTable;

constexpr const char* kDesign = "design";
constexpr const char* kSession = "session";

// Columns that count, place or answer a trial, or are a condition's already.
constexpr const char* kNoFactor[] = {"trial",
                                     "trial_type",
                                     "condition",
                                     "pattern",
                                     "angle_deg",
                                     "artifact_px",
                                     "lit_level",
                                     "proposed_radius_px",
                                     "filter_radius_px",
                                     "response",
                                     "correct",
                                     "response_time_s",
                                     "status",
                                     "onset_s",
                                     "threshold_mean",
                                     "threshold_sd",
                                     "image_seed"};

const records::TrialColumn* ownColumn(const std::string& name) {
    const auto columns = records::trialColumns();
    const auto found = std::ranges::find(columns, name, &records::TrialColumn::name);
    return found == columns.end() ? nullptr : &*found;
}

std::optional<std::size_t> extraColumn(const TrialTable& table, const std::string& name) {
    const auto found = std::find(table.extraColumns.begin(), table.extraColumns.end(), name);
    if (found == table.extraColumns.end()) return std::nullopt;
    return static_cast<std::size_t>(found - table.extraColumns.begin());
}

// Where participants.tsv may lie: beside a flat table, at the top of a BIDS tree.
std::vector<fs::path> dataFolders(const TrialTable& table) {
    const fs::path folder = fs::absolute(table.file).parent_path();
    return {folder, folder.parent_path().parent_path()};
}

std::optional<std::string> ofParticipant(const TrialTable& table, const std::string& name) {
    for (const fs::path& folder : dataFolders(table)) {
        const auto cell = records::participantCell(folder, table.participant, name);
        if (cell) return cell;
    }
    return std::nullopt;
}

std::string whatThereIs(std::span<const TrialTable> tables) {
    std::set<std::string> names = {kDesign, kSession};
    for (const records::TrialColumn& column : records::trialColumns()) {
        if (std::ranges::find(kNoFactor, column.name) == std::end(kNoFactor)) {
            names.insert(std::string(column.name));
        }
    }
    names.erase("task");
    for (const TrialTable& table : tables) {
        names.insert(table.extraColumns.begin(), table.extraColumns.end());
        for (const fs::path& folder : dataFolders(table)) {
            const auto columns = records::participantColumns(folder);
            names.insert(columns.begin(), columns.end());
        }
    }
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
}

void addColumn(TrialTable& table, const std::string& name, const std::string& value) {
    table.extraColumns.push_back(name);
    for (records::Trial& trial : table.trials) trial.extra.push_back(value);
}

}  // namespace

std::vector<std::string> factorNames(std::span<const std::string> asked) {
    std::vector<std::string> names;
    for (const std::string& one : asked) {
        const std::string name = one == "noise" ? "noise_levels" : one;
        const auto refuse = [&](const char* rule) {
            throw std::invalid_argument("--by: " + records::quotedText(one) + ": " + rule);
        };
        if (name.empty()) refuse("must name a column");
        if (name == "task") {
            refuse(
                "a guess is not the same in both tasks; fit the tables of each task by themselves");
        }
        if (std::ranges::find(kNoFactor, name) != std::end(kNoFactor)) {
            refuse("numbers, places or answers a trial, or is a part of every condition already");
        }
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
    return names;
}

void addFactorColumns(std::span<TrialTable> tables,
                      std::span<const std::optional<records::SessionSidecar>> sidecars,
                      std::span<const std::string> factors) {
    for (const std::string& name : factors) {
        if (ownColumn(name)) continue;
        std::vector<std::optional<std::string>> values;  // of the tables that lack the column
        bool anywhere = name == kDesign || name == kSession;
        for (std::size_t t = 0; t < tables.size(); ++t) {
            const TrialTable& table = tables[t];
            values.emplace_back();
            if (extraColumn(table, name)) {
                anywhere = true;
            } else if (name == kSession) {
                values.back() = table.session;
            } else if (name == kDesign) {
                if (sidecars[t]) values.back() = sidecars[t]->design.value("name", "n/a");
            } else {
                values.back() = ofParticipant(table, name);
                anywhere = anywhere || values.back();
            }
        }
        if (!anywhere) {
            throw std::invalid_argument("--by: " + records::quotedText(name) +
                                        ": no column of the tables or of participants.tsv: must "
                                        "be one of " +
                                        whatThereIs(tables));
        }
        for (std::size_t t = 0; t < tables.size(); ++t) {
            if (!extraColumn(tables[t], name))
                addColumn(tables[t], name, values[t].value_or("n/a"));
        }
    }
}

FactorReader::FactorReader(const TrialTable& table, std::span<const std::string> factors) {
    for (const std::string& name : factors) {
        Source source;
        if (const records::TrialColumn* own = ownColumn(name)) {
            source.write = own->write;
        } else {
            source.extra = extraColumn(table, name);
        }
        sources_.push_back(source);
    }
}

std::vector<std::string> FactorReader::levels(const records::Trial& trial) const {
    std::vector<std::string> values;
    for (const Source& source : sources_) {
        std::string value;
        if (source.write) {
            source.write(trial, value);
        } else {
            value = source.extra ? trial.extra[*source.extra] : "n/a";
        }
        values.push_back(value);
    }
    return values;
}

}  // namespace analysis

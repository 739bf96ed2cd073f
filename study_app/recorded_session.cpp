// SPDX-License-Identifier: MIT
#include "study_app/recorded_session.h"

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>

#include "quest/quest.h"
#include "records/quoted_text.h"
#include "records/whole_file.h"
#include "study_app/design_file.h"

namespace study_app {
namespace {

namespace fs = std::filesystem;

std::string kernelText(const Design& design) {
    return design.kernels.size() == 1 ? design.kernels.front() : "mixed";
}

records::SessionSidecar sidecarFor(const SessionRequest& request) {
    const quest::QuestParameters staircase = staircaseParameters(request.design);
    records::SessionSidecar sidecar{.context = request.context,
                                    .participant = request.participant,
                                    .session = request.session,
                                    .observer = request.observer,
                                    .design = nlohmann::json(normalisedJson(request.design)),
                                    .seed = request.seed,
                                    .kernel = kernelText(request.design),
                                    .task = request.design.task,
                                    .encoding = request.design.encoding,
                                    .beta = staircase.beta,
                                    .criterion = quest::criterion(staircase),
                                    .displayWidthPx = request.displayWidthPx,
                                    .displayHeightPx = request.displayHeightPx,
                                    .pxPerDeg = request.pxPerDeg,
                                    .displayGamma = request.displayGamma,
                                    .luminance = request.luminance};
    sidecar.context.seed = request.seed;
    return sidecar;
}

Design designOf(const records::SessionSidecar& sidecar, const fs::path& file) {
    return designFromJson(sidecar.design, file.string() + ": stairwell.design");
}

[[noreturn]] void refuse(const fs::path& file, const std::string& what, const std::string& there,
                         const std::string& here) {
    throw std::runtime_error(file.string() + ": " + what + ": the session there has " + there +
                             ", this one " + here +
                             ": a session goes on only as it began; choose another --session or "
                             "--participant for a new one");
}

std::string sentence(const fs::path& table, std::size_t row, const Difference& difference) {
    return table.string() + ": line " + std::to_string(row + 2) + ": column " + difference.column +
           ": recorded " + records::quotedText(difference.recorded) +
           ", but the sidecar's design and seed and the rows before give " +
           records::quotedText(difference.derived);
}

}  // namespace

RecordedSession::RecordedSession(const SessionRequest& request)
    : table_(records::trialTablePath(request.dataFolder, request.participant, request.session)),
      journal_(table_),
      session_(request.design, request.seed) {
    const fs::path sidecar = records::sidecarPath(table_);
    if (fs::exists(sidecar)) {
        requireSameSession(request);
    } else if (journal_.existing().trials.empty()) {
        records::writeSidecar(sidecar, sidecarFor(request));
    } else {
        throw std::runtime_error(sidecar.string() + ": is missing: the " +
                                 std::to_string(journal_.existing().trials.size()) +
                                 " trials recorded beside it cannot be continued without the "
                                 "design and the seed that it holds");
    }
    records::registerParticipant(request.dataFolder, request.participant);
    replayRows();
}

void RecordedSession::requireSameSession(const SessionRequest& request) const {
    const fs::path file = records::sidecarPath(table_);
    const records::SessionSidecar there = records::readSidecar(file);
    const auto require = [&](const char* what, const std::string& a, const std::string& b) {
        if (a != b) refuse(file, what, a, b);
    };
    require("participant", there.participant, request.participant);
    require("session", there.session.value_or("none"), request.session.value_or("none"));
    require("seed", std::to_string(there.seed), std::to_string(request.seed));
    const auto normalised = [](const Design& d) { return nlohmann::json(normalisedJson(d)); };
    const std::string difference =
        designDifference(normalised(designOf(there, file)), normalised(request.design));
    if (!difference.empty()) {
        throw std::runtime_error(file.string() + ": design: " + difference +
                                 ": a session goes on only as it began; choose another --session "
                                 "or --participant for a new one");
    }
    require("observer", there.observer, request.observer);
}

void RecordedSession::replayRows() {
    const std::vector<records::Trial>& rows = journal_.existing().trials;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (const auto difference = session_.replay(rows[i])) {
            throw std::runtime_error(sentence(table_, i, *difference) +
                                     ": the session cannot go on from it");
        }
    }
    resumedRows_ = rows.size();
    if (!rows.empty()) lastRow_ = rows.back();
}

void RecordedSession::answer(const Answer& answer) {
    lastRow_ = session_.answer(answer);
    journal_.append(*lastRow_);
}

bool hasBegun(const fs::path& table) {
    if (!fs::exists(table)) return false;
    if (fs::exists(records::sidecarPath(table))) return true;
    const std::string text = records::readWholeFile(table);
    const std::string header = records::trialTableHeader() + "\n";
    if (header.starts_with(text)) return false;
    return !text.starts_with(header) || text.find('\n', header.size()) != text.npos;
}

ReplayedSession replayTable(const fs::path& file) {
    records::TrialTable table = records::readTrialTable(file);
    const fs::path sidecarFile = records::sidecarPath(file);
    records::SessionSidecar sidecar = records::readSidecar(sidecarFile);
    Session session(designOf(sidecar, sidecarFile), sidecar.seed);
    for (std::size_t i = 0; i < table.trials.size(); ++i) {
        if (const auto difference = session.replay(table.trials[i])) {
            throw std::runtime_error(sentence(file, i, *difference));
        }
    }
    return {std::move(sidecar), std::move(table), std::move(session)};
}

}  // namespace study_app

// SPDX-License-Identifier: MIT
#include "study_app/setup_form.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "quest/quest.h"
#include "records/file_descriptor.h"
#include "records/quoted_text.h"
#include "records/session_sidecar.h"
#include "study_app/design_file.h"

namespace study_app {
namespace {

namespace fs = std::filesystem;

std::optional<std::string> sessionOf(const SetupForm& form) {
    return form.session.empty() ? std::nullopt : std::optional(form.session);
}

bool isId(const std::string& text) {
    return std::ranges::all_of(text, [](unsigned char c) { return std::isalnum(c) != 0; });
}

std::optional<std::uint64_t> seedFrom(const std::string& text) {
    std::uint64_t seed = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, seed);
    return error == std::errc() && stop == end ? std::optional(seed) : std::nullopt;
}

template <typename List, typename ToText>
std::string joined(const List& list, ToText toText) {
    std::string text;
    for (std::size_t i = 0; i < list.size(); ++i) {
        if (i > 0) text += i + 1 == list.size() ? " and " : ", ";
        text += toText(list[i]);
    }
    return text;
}

std::string describe(const Silhouette& s) {
    std::string text(records::toText(s.pattern));
    if (s.angleDeg) text += " at " + records::exactText(*s.angleDeg) + "°";
    if (s.orientation == Orientation::horizontal) text = "horizontal " + text;
    if (s.orientation == Orientation::vertical) text = "vertical " + text;
    return text;
}

std::string plural(std::size_t count, const std::string& noun) {
    return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string describeFrames(const Design& d) {
    const auto name = [](const Condition& c) { return c.name; };
    return "rendered frames, " + d.frames->pairs.front().technique + ": " +
           joined(conditions(d), name);
}

std::string describeEdges(const Design& d) {
    const auto number = [](auto value) { return records::exactText(static_cast<double>(value)); };
    const auto itself = [](const std::string& text) { return text; };
    std::string text = "steps of " + joined(d.artifactPx, number) + " px; " +
                       joined(d.patterns, describe) + "; " + joined(d.kernels, itself) + " filter";
    if (d.litLevels != std::vector<double>{1.0}) {
        text += "; lit level " + joined(d.litLevels, number);
    }
    if (d.noiseLevels != std::vector<double>{0.0}) {
        text += "; noise of " + joined(d.noiseLevels, number) + " levels";
    }
    return text;
}

std::string describeTable(const fs::path& table) {
    try {
        if (!hasBegun(table)) return "not begun";
        const Session session = replayTable(table).session;
        if (session.finished()) return "finished";
        return std::to_string(session.answered()) + " of " + std::to_string(session.total()) +
               " trials";
    } catch (const std::exception&) {
        return "cannot be resumed";
    }
}

void requireFree(const fs::path& table) {
    const records::FileDescriptor file = records::openFile(table, O_RDONLY);
    if (!file.isOpen() || ::flock(file.get(), LOCK_SH | LOCK_NB) == 0 || errno != EWOULDBLOCK)
        return;
    throw std::runtime_error(table.string() +
                             ": is open in another program: this session is running");
}

/// The session goes on only as it began: what the form asks for must be that.
void requireAsBegun(const SetupForm& form, const fs::path& table, const Session& session) {
    const auto normalised = [](const Design& d) { return nlohmann::json(normalisedJson(d)); };
    const Design& begun = session.design();
    std::string difference = designDifference(normalised(begun), normalised(designOf(form, begun)));
    if (!difference.empty()) difference = "design: " + difference;
    if (difference.empty() && !form.seed.empty() && seedFrom(form.seed) != session.seed()) {
        difference =
            "seed is " + std::to_string(session.seed()) + " there and " + form.seed + " here";
    }
    if (difference.empty()) return;
    throw std::runtime_error(records::sidecarPath(table).string() + ": " + difference +
                             ": a session goes on only as it began; choose another session or "
                             "participant for a new one");
}

}  // namespace

fs::path tableOf(const SetupForm& form) {
    return records::trialTablePath(form.dataFolder, form.participant, sessionOf(form));
}

ExistingSession findExisting(const SetupForm& form) {
    ExistingSession existing;
    if (form.participant.empty() || !isId(form.participant) || !isId(form.session)) return existing;
    const fs::path table = tableOf(form);
    if (!fs::exists(table)) return existing;
    try {
        requireFree(table);
        if (!hasBegun(table)) return existing;
        const ReplayedSession replayed = replayTable(table);
        requireAsBegun(form, table, replayed.session);
        existing.answered = replayed.session.answered();
        existing.total = replayed.session.total();
        existing.rows = replayed.session.rows();
        existing.design = replayed.session.design();
        // Frames may have been moved: where they are now, the form says.
        if (existing.design->frames && !form.design.empty()) {
            existing.design->frames->folder = designOf(form).frames->folder;
        }
        existing.seed = replayed.session.seed();
        existing.state = replayed.session.finished() ? ExistingSession::State::finished
                                                     : ExistingSession::State::unfinished;
    } catch (const std::exception& error) {
        existing.state = ExistingSession::State::unusable;
        existing.problem = error.what();
    }
    return existing;
}

std::vector<std::string> describeParticipants(const fs::path& dataFolder, std::size_t most) {
    std::vector<std::string> lines;
    std::error_code ignored;  // no folder yet, no participants
    if (!fs::is_directory(dataFolder, ignored)) return lines;
    std::vector<fs::path> tables;
    try {
        tables = records::findTrialTables(dataFolder);
    } catch (const std::runtime_error&) {
        return lines;
    }
    for (const fs::path& table : tables) {
        if (lines.size() == most) {
            lines.push_back("and " + std::to_string(tables.size() - most) + " more");
            break;
        }
        std::string name = table.filename().string();
        name.resize(std::min(name.find("_task-"), name.size()));
        if (name.starts_with("sub-")) name.erase(0, 4);
        if (const auto session = name.find("_ses-"); session != name.npos) {
            name.replace(session, 5, ", session ");
        }
        lines.push_back(name + ": " + describeTable(table));
    }
    return lines;
}

Design withTask(Design design, records::Task task) {
    if (design.task == task) return design;
    quest::QuestParameters& q = design.staircase;
    const double criterion = quest::criterion(q);
    if (task == records::Task::yesNo) {
        q = quest::forYesNo(q, kYesNoGamma);
    } else {
        q.gamma = 0.5;
        q.pThreshold = quest::thresholdProbability(criterion, q.gamma, q.delta);
        design.localise = false;
    }
    design.task = task;
    return design;
}

Design designOf(const SetupForm& form, const std::optional<Design>& begun) {
    const std::string name = form.design.empty() ? kNewDesign : form.design;
    Design design = form.design.empty() && begun ? *begun : readDesign(findDesign(name));
    if (form.presentation) design.presentation = *form.presentation;
    return form.task ? withTask(design, *form.task) : design;
}

std::vector<std::string> describeDesign(const Design& d) {
    const std::string shown = d.frames ? "picture" : "edge";
    std::vector<std::string> lines;
    lines.push_back(d.task == records::Task::twoAfc
                        ? "Two " + shown + "s side by side; which one has stair-steps?"
                        : "One " + shown + " at a time; does it have stair-steps?");
    lines.push_back(plural(conditions(d).size(), "condition") + ": " +
                    (d.frames ? describeFrames(d) : describeEdges(d)));
    lines.push_back(plural(static_cast<std::size_t>(totalTrials(d)), "trial") + " (" +
                    std::to_string(d.trialsPerCondition) + " per condition, " +
                    std::to_string(catchTrials(d)) + " to check attention), about " +
                    plural(static_cast<std::size_t>(expectedMinutes(d)), "minute"));
    return lines;
}

std::string notWritable(const fs::path& folder) {
    std::error_code error;
    fs::path there = fs::absolute(folder, error);
    while (!fs::exists(there, error) && there.has_relative_path()) there = there.parent_path();
    if (!fs::is_directory(there, error)) {
        return folder.string() + ": cannot be written: " + there.string() + " is no folder";
    }
    if (::access(there.c_str(), W_OK | X_OK) == 0) return {};
    return folder.string() + ": cannot be written: " + there.string() + ": " + std::strerror(errno);
}

std::string missing(const SetupForm& form) {
    if (form.dataFolder.empty()) return "Choose the folder in which the data set lies.";
    if (form.participant.empty()) return "Give the participant an id.";
    if (!isId(form.participant)) return "The participant's id may hold letters and digits only.";
    if (!isId(form.session)) return "The session's id may hold letters and digits only.";
    if (!form.seed.empty() && !seedFrom(form.seed)) return "The seed must be a whole number.";
    if (!form.age.empty()) {
        double age = 0;
        const char* const end = form.age.data() + form.age.size();
        const auto [stop, error] = std::from_chars(form.age.data(), end, age);
        if (error != std::errc() || stop != end || !(age >= 0 && age <= 150)) {
            return "The age must be a number of years.";
        }
    }
    return {};
}

SessionRequest requestFrom(const SetupForm& form, const ExistingSession& existing,
                           const DisplayProfile& display, std::uint64_t freshSeed,
                           const records::RunContext& context) {
    if (const std::string problem = missing(form); !problem.empty()) {
        throw std::runtime_error(problem);
    }
    if (existing.state == ExistingSession::State::unusable) {
        throw std::runtime_error(existing.problem);
    }
    return {.dataFolder = form.dataFolder,
            .participant = form.participant,
            .session = sessionOf(form),
            .observer = "human",
            .design = existing.design ? *existing.design : designOf(form),
            .seed = existing.design ? existing.seed : seedFrom(form.seed).value_or(freshSeed),
            .displayWidthPx = display.widthPx,
            .displayHeightPx = display.heightPx,
            .context = context,
            .pxPerDeg = pxPerDeg(display),
            .displayGamma = display.gamma,
            .luminance = display.luminance};
}

}  // namespace study_app

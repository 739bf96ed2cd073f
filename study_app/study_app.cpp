// SPDX-License-Identifier: MIT
// study_app: runs the study's sessions.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "program/progress.h"
#include "program/run_program.h"
#include "records/run_context.h"
#include "study_app/design_check.h"
#include "study_app/design_file.h"
#include "study_app/display_file.h"
#include "study_app/recorded_session.h"
#include "study_app/screens.h"
#include "study_app/session_report.h"
#include "study_app/simulated_population.h"
#include "study_app/simulated_study.h"
#include "study_app/window_options.h"

namespace {

constexpr int kCheckedObservers = 10;

struct Options {
    std::string design, data, participant, session, observer, replay, check;
    std::optional<double> pxPerDeg;
    std::string seed;  // as text: CLI11 reads "-1" as 2^64 - 1
    int observers = 0;
    bool headless = false, listDesigns = false;
    study_app::WindowArguments window;
};

void printNotices(const std::vector<std::string>& notices) {
    for (const std::string& notice : notices) {
        std::fprintf(stderr, "study_app: notice: %s\n", notice.c_str());
    }
}

void listDesigns() {
    for (const study_app::ShippedDesign& design : study_app::shippedDesigns()) {
        std::printf("%-10s %s\n", design.name.c_str(), design.description.c_str());
    }
}

void replay(const std::string& file) {
    if (file.empty()) throw std::runtime_error("--replay: empty: must name a trial table");
    const study_app::ReplayedSession replayed = study_app::replayTable(file);
    printNotices(replayed.table.notices);
    std::printf("%s: every proposal and threshold of %zu rows derived again, bit for bit\n",
                file.c_str(), replayed.table.trials.size());
    std::printf("%s\n%s", study_app::contextLine(replayed.session).c_str(),
                study_app::thresholdTable(replayed.session, nullptr).c_str());
}

void printSession(const study_app::SimulatedSession& session) {
    printNotices(session.notices);
    if (session.newRows == 0) {
        std::printf("sub-%s: finished already, nothing changed (%s)\n", session.participant.c_str(),
                    session.table.c_str());
    } else if (session.resumedRows > 0) {
        std::printf("sub-%s: resumed after %zu rows, %zu recorded in %s\n",
                    session.participant.c_str(), session.resumedRows, session.newRows,
                    session.table.c_str());
    } else {
        std::printf("sub-%s: %zu rows recorded in %s\n", session.participant.c_str(),
                    session.newRows, session.table.c_str());
    }
}

void simulate(const Options& options, const study_app::SessionRequest& request) {
    const auto start = std::chrono::steady_clock::now();
    const auto population = study_app::populationFromText(options.observer);
    const auto participants = static_cast<std::size_t>(options.observers);
    const auto trials = static_cast<std::size_t>(study_app::totalTrials(request.design));
    program::Progress progress("trials", trials * std::max<std::size_t>(participants, 1));
    const auto onTrial = [&] { progress.advance(); };

    std::vector<study_app::SimulatedSession> sessions;
    if (participants == 0) {
        sessions.push_back(study_app::runSimulatedSession(request, population, onTrial));
    } else {
        sessions = study_app::runSimulatedStudy(request, population, participants, onTrial);
    }
    std::size_t newRows = 0;
    for (const study_app::SimulatedSession& session : sessions) {
        printSession(session);
        newRows += session.newRows;
    }
    if (participants == 0) {
        std::printf("%s\n%s", study_app::contextLine(sessions[0].session).c_str(),
                    study_app::thresholdTable(sessions[0].session, &sessions[0].observer).c_str());
    } else {
        std::printf("%s", study_app::studyTable(sessions).c_str());
    }
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    std::printf("%zu rows, each synced to the disk, in %.3f s\n", newRows, elapsed.count());
}

/// What a stored display shows of the design.
std::string onDisplay(const study_app::DisplayProfile& display, const study_app::Design& design) {
    std::string text = "\n" + display.name + ", " + std::to_string(display.widthPx) + " x " +
                       std::to_string(display.heightPx) + " px: ";
    const cv::Size needed = study_app::stimulusArea(design.task, design.windowPx);
    if (display.widthPx < needed.width || display.heightPx < needed.height) {
        text += "warning: too small for stimuli of " + std::to_string(needed.width) + " x " +
                std::to_string(needed.height) + " px. ";
    }
    const std::optional<double> pxPerDeg = study_app::pxPerDeg(display);
    return text + (pxPerDeg ? study_app::visibleRangeText(design, *pxPerDeg)
                            : std::string("no viewing distance is known\n"));
}

void check(const CLI::App& app, const Options& options, std::uint64_t seed) {
    const study_app::Design design = study_app::readDesign(study_app::findDesign(options.check));
    const std::string observer = app.count("--observer") > 0 ? options.observer : "simulated";
    const int observers = app.count("--observers") > 0 ? options.observers : kCheckedObservers;
    program::Progress progress("sessions", study_app::kCheckSessions);
    const study_app::DesignCheck checked = study_app::checkDesign(
        design, study_app::populationFromText(observer), seed, [&] { progress.advance(); });
    std::printf("%s", study_app::checkText(checked, design, observers).c_str());
    if (options.pxPerDeg) {
        std::printf("\n%s", study_app::visibleRangeText(design, *options.pxPerDeg).c_str());
    }
    if (options.window.displays.empty()) return;
    for (const study_app::DisplayProfile& display :
         study_app::readDisplays(options.window.displays)) {
        std::printf("%s", onDisplay(display, design).c_str());
    }
}

// What CLI11 cannot say without crowding --help: which options belong together.
void require(const CLI::App& app, const char* option) {
    if (app.count(option) == 0) throw CLI::RequiredError(option);
}

/// An option that a mode does not use is refused, not ignored.
void requireAlone(const CLI::App& app, const char* mode,
                  const std::vector<std::string_view>& with = {}) {
    for (const char* option :
         {"--design", "--data", "--participant", "--session", "--headless", "--observer",
          "--observers", "--seed", "--replay", "--list-designs", "--check", "--px-per-deg"}) {
        const bool taken = std::ranges::find(with, option) != with.end();
        if (std::string_view(option) != mode && !taken && app.count(option) > 0) {
            throw CLI::ExcludesError(mode, option);
        }
    }
}

std::uint64_t readSeed(const std::string& text) {
    std::uint64_t seed = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, seed);
    if (error == std::errc() && stop == end) return seed;
    throw CLI::ValidationError("--seed", text + ": must be a whole number from 0 to 2^64 - 1");
}

void showWindow(const CLI::App& app, const Options& options, std::vector<std::string> command) {
    for (const char* option : {"--observer", "--observers"}) {
        if (app.count(option) > 0) throw CLI::RequiresError(option, "--headless");
    }
    study_app::WindowRun run;
    if (!options.data.empty()) run.form.dataFolder = options.data;
    if (!options.design.empty()) run.form.design = options.design;
    run.form.participant = options.participant;
    run.form.session = options.session;
    if (app.count("--seed") > 0) run.form.seed = std::to_string(readSeed(options.seed));
    run.context = records::currentRunContext("study_app", std::move(command));
    study_app::apply(options.window, run);
    study_app::runWindow(run);
}

void run(const CLI::App& app, const Options& options, std::vector<std::string> command) {
    if (options.listDesigns) {
        requireAlone(app, "--list-designs");
        return listDesigns();
    }
    if (app.count("--replay") > 0) {
        requireAlone(app, "--replay");
        return replay(options.replay);
    }
    if (app.count("--check") > 0) {
        requireAlone(app, "--check", {"--observer", "--observers", "--seed", "--px-per-deg"});
        return check(app, options, app.count("--seed") > 0 ? readSeed(options.seed) : 1);
    }
    if (app.count("--px-per-deg") > 0) throw CLI::RequiresError("--px-per-deg", "--check");
    if (!options.headless) return showWindow(app, options, std::move(command));
    for (const char* option : {"--design", "--data", "--observer", "--seed"}) require(app, option);
    if (app.count("--observers") > 0 && app.count("--participant") > 0) {
        throw CLI::ExcludesError("--observers", "--participant");
    }
    if (app.count("--observers") == 0) require(app, "--participant");
    if (options.data.empty()) throw std::runtime_error("--data: empty: must name a folder");

    study_app::SessionRequest request{
        .dataFolder = options.data,
        .participant = options.participant,
        .session = app.count("--session") > 0 ? std::optional(options.session) : std::nullopt,
        .design = study_app::readDesign(study_app::findDesign(options.design)),
        .seed = readSeed(options.seed),
        .context = records::currentRunContext("study_app", std::move(command))};
    simulate(options, request);
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{
        "Runs sessions of a study: randomly interleaved QUEST staircases over the conditions of a "
        "design.\nEvery answer is on disk before the next stimulus; the same command resumes an "
        "unfinished session."};
    app.footer("Keys of --observer simulated:key=value,... with their defaults:\n" +
               study_app::describeKeys() +
               "\nExample: study_app --headless --design paper16 --data study --observers 10 "
               "--observer simulated:c=3.47 --seed 1");
    Options o;
    app.add_option("--design", o.design, "Design file, or the name of a shipped design");
    app.add_option("--data", o.data, "Folder of the data set (BIDS), created where it is missing");
    app.add_option("--participant", o.participant, "Participant id: letters and digits");
    app.add_option("--session", o.session, "Session id: letters and digits (default: none)");
    app.add_flag("--headless", o.headless, "Run without a window, with a simulated observer");
    app.add_option("--observer", o.observer, "simulated[:key=value,...], see below");
    app.add_option("--observers", o.observers,
                   "Simulate a whole study: participants 01, 02, ... N instead of --participant")
        ->check(CLI::Range(1, 9999));
    app.add_option("--seed", o.seed,
                   "Whole number: order, roving and simulated observers follow from it");
    app.add_option(
        "--replay", o.replay,
        "Derive a recorded session again from its table and sidecar, compare, print thresholds");
    app.add_option("--check", o.check,
                   "Design to validate and simulate: minutes, precision for --observers (default "
                   "10), proposals beyond the display's limits");
    app.add_option("--px-per-deg", o.pxPerDeg,
                   "With --check: resolution of a display (or --displays FILE: of all stored ones)")
        ->check(CLI::Range(1.0, 1000.0));
    app.add_flag("--list-designs", o.listDesigns, "Print the shipped designs");
    study_app::addWindowOptions(app, o.window);
    std::vector<std::string> command(argv, argv + argc);
    return program::run(app, argc, argv, [&] { run(app, o, command); });
}

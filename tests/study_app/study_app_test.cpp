// SPDX-License-Identifier: MIT
// The program as its user starts it: killed, out of disk, started twice, misused.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "quest/random.h"
#include "records/session_sidecar.h"
#include "records/trial_table.h"
#include "study_app/recorded_session.h"
#include "study_app/session.h"
#include "study_app/simulated_population.h"
#include "tests/project_folders.h"
#include "tests/run_command.h"
#include "tests/study_app/test_designs.h"
#include "tests/temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

std::string contents(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::string> headless(const fs::path& data, const std::string& design = "paper16",
                                  const std::string& session = "a") {
    return {"--headless", "--design",      tests::shippedDesignFile(design).string(),
            "--data",     data.string(),   "--participant",
            "01",         "--session",     session,
            "--observer", "simulated:c=3", "--seed",
            "21"};
}

/// What headless() asks for, to open it without the program.
study_app::SessionRequest sameSession(const fs::path& data, const std::string& design) {
    return {.dataFolder = data,
            .participant = "01",
            .session = "a",
            .observer = study_app::toText(study_app::SimulatedPopulation{.c = 3}),
            .design = tests::shippedDesign(design),
            .seed = 21,
            .displayWidthPx = 600,
            .displayHeightPx = 600,
            .context = records::currentRunContext("test", {"test"})};
}

fs::path tableIn(const fs::path& data, const std::string& session = "a") {
    return records::trialTablePath(data, "01", session);
}

tests::CommandResult studyApp(const std::vector<std::string>& arguments) {
    return tests::runProgram("study_app", arguments);
}

/// Starts study_app with its output thrown away; `fileSizeLimit` in bytes, 0 for none.
pid_t start(const std::vector<std::string>& arguments, rlim_t fileSizeLimit = 0,
            const fs::path& errors = "/dev/null") {
    const std::string program = (tests::programFolder() / "study_app").string();
    std::vector<char*> argv{const_cast<char*>(program.c_str())};
    for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
    argv.push_back(nullptr);
    const pid_t child = fork();
    if (child != 0) return child;
    const int out = open("/dev/null", O_WRONLY);
    const int err = open(errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(out, STDOUT_FILENO);
    dup2(err, STDERR_FILENO);
    if (fileSizeLimit > 0) {
        const rlimit limit{fileSizeLimit, fileSizeLimit};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    execv(program.c_str(), argv.data());
    _exit(127);
}

int waitFor(pid_t child) {
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/// Waits until the file exists and has `bytes`, or the child has ended.
void waitForSize(const fs::path& file, std::uintmax_t bytes, pid_t child) {
    const auto isThere = [&] {
        std::error_code missing;
        const std::uintmax_t size = fs::file_size(file, missing);
        return !missing && size >= bytes;
    };
    siginfo_t ended{};
    while (!isThere() && ended.si_pid == 0) {
        std::this_thread::sleep_for(std::chrono::microseconds(50));
        waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOHANG | WNOWAIT);
    }
}

/// What must hold after a kill: the table is the beginning of the uninterrupted one with nothing
/// lost that stood there `before`, and a session resumed on it proposes the next trial of the
/// uninterrupted one, bit for bit.
void expectResumes(const study_app::SessionRequest& request, const std::string& before,
                   const std::string& whole, const std::vector<records::Trial>& wholeRows) {
    const fs::path file = tableIn(request.dataFolder, *request.session);
    const std::string after = contents(file);
    ASSERT_TRUE(after.starts_with(before.substr(0, before.rfind('\n') + 1)));
    ASSERT_TRUE(whole.starts_with(after));
    const study_app::RecordedSession resumed(request);
    const study_app::Session& session = resumed.session();
    ASSERT_EQ(session.rows(), std::max<std::ptrdiff_t>(std::ranges::count(after, '\n') - 1, 0));
    if (session.finished()) return;
    const records::Trial& next = wholeRows[session.rows()];
    ASSERT_EQ(session.next().condition, next.condition);
    ASSERT_EQ(session.next().proposedRadiusPx, next.proposedRadiusPx);
    ASSERT_EQ(session.next().filterRadiusPx, next.filterRadiusPx);
}

// Half of the kills hit one session, resumed again and again, within 0.4 ms after its table has
// grown by a random part of up to an eighth; the other half hit sessions that start from nothing,
// within 3 ms after the table appears, where the header, the sidecar and the first rows are
// written.
TEST(StudyApp, LosesNoTrialWhenKilledAtRandomMoments) {
    const tests::TemporaryFolder folder;
    const fs::path reference = folder.path() / "reference", data = folder.path() / "data";
    ASSERT_EQ(studyApp(headless(reference)).exitCode, 0);
    const std::string whole = contents(tableIn(reference));
    const auto wholeRows = records::readTrialTable(tableIn(reference)).trials;
    study_app::SessionRequest request = sameSession(data, "paper16");

    std::mt19937_64 rng(17);
    for (int kills = 0; kills < 100;) {
        const bool fresh = kills % 2 == 1;
        request.session = fresh ? "fresh" + std::to_string(kills) : "long";
        const fs::path table = tableIn(data, *request.session);
        const pid_t child = start(headless(data, "paper16", *request.session));
        const std::uint64_t further = quest::uniformBelow(rng, whole.size() / 8);
        waitForSize(table, fresh ? 0 : contents(table).size() + further, child);
        const std::uint64_t delayUs = quest::uniformBelow(rng, fresh ? 3000 : 400);
        std::this_thread::sleep_for(std::chrono::microseconds(delayUs));
        const std::string before = contents(table);
        kill(child, SIGKILL);
        if (waitFor(child) == 0) {  // it was done first
            ASSERT_EQ(contents(table), whole);
            fs::remove(table);
            continue;
        }
        ++kills;
        expectResumes(request, before, whole, wholeRows);
        if (HasFatalFailure()) FAIL() << "after kill " << kills;
    }
    EXPECT_EQ(studyApp(headless(data, "paper16", "long")).exitCode, 0);
    EXPECT_EQ(contents(tableIn(data, "long")), whole);
    EXPECT_EQ(contents(data / "participants.tsv"), "participant_id\nsub-01\n");
}

TEST(StudyApp, SaysSoWhenTheDiskIsFullAndResumesWhenThereIsRoom) {
    const tests::TemporaryFolder folder;
    const fs::path reference = folder.path() / "reference", data = folder.path() / "data";
    const fs::path errors = folder.path() / "errors";
    ASSERT_EQ(studyApp(headless(reference, "quick")).exitCode, 0);
    const std::string whole = contents(tableIn(reference));
    const auto sidecarBytes = fs::file_size(records::sidecarPath(tableIn(reference)));
    ASSERT_GT(whole.size(), sidecarBytes + 1000) << "the limit below must hit the table";

    std::size_t recorded = 0;
    for (rlim_t limit = sidecarBytes + 100; limit < whole.size(); limit += 777) {
        EXPECT_EQ(waitFor(start(headless(data, "quick"), limit, errors)), 1);
        const std::string sentence = contents(errors);
        EXPECT_THAT(sentence, AllOf(HasSubstr("study_app: "), HasSubstr(tableIn(data).string()),
                                    HasSubstr("File too large")));
        EXPECT_EQ(std::count(sentence.begin(), sentence.end(), '\n'), 1);
        const std::string kept = contents(tableIn(data));
        EXPECT_TRUE(whole.starts_with(kept));
        EXPECT_TRUE(kept.ends_with('\n'));
        EXPECT_GE(kept.size(), recorded);
        recorded = kept.size();
    }
    EXPECT_GT(recorded, 0u);
    EXPECT_EQ(studyApp(headless(data, "quick")).exitCode, 0);
    EXPECT_EQ(contents(tableIn(data)), whole);
}

TEST(StudyApp, LeavesNothingHalfWhenTheDiskIsFullFromTheStart) {
    const tests::TemporaryFolder folder;
    const fs::path data = folder.path() / "data";
    for (const rlim_t limit : {rlim_t{1}, rlim_t{300}, rlim_t{2000}}) {
        EXPECT_EQ(waitFor(start(headless(data, "quick"), limit)), 1);
    }
    EXPECT_EQ(studyApp(headless(data, "quick")).exitCode, 0);
}

TEST(StudyApp, SecondProgramOnTheSameSessionIsRefused) {
    const tests::TemporaryFolder folder;
    const study_app::RecordedSession open(sameSession(folder.path(), "quick"));
    const tests::CommandResult result = studyApp(headless(folder.path(), "quick"));
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_THAT(result.err, HasSubstr("another program"));
}

TEST(StudyApp, SaysThatAFinishedSessionIsFinishedAndChangesNothing) {
    const tests::TemporaryFolder folder;
    ASSERT_EQ(studyApp(headless(folder.path(), "quick")).exitCode, 0);
    const auto written = fs::last_write_time(tableIn(folder.path()));
    const std::string before = contents(tableIn(folder.path()));
    const tests::CommandResult again = studyApp(headless(folder.path(), "quick"));
    EXPECT_EQ(again.exitCode, 0);
    EXPECT_THAT(again.out, HasSubstr("finished already, nothing changed"));
    EXPECT_EQ(contents(tableIn(folder.path())), before);
    EXPECT_EQ(fs::last_write_time(tableIn(folder.path())), written);
}

TEST(StudyApp, ReplaysItsOwnSessionAndFindsAChangedCell) {
    const tests::TemporaryFolder folder;
    ASSERT_EQ(studyApp(headless(folder.path(), "quick")).exitCode, 0);
    const fs::path table = tableIn(folder.path());
    tests::CommandResult result = studyApp({"--replay", table.string()});
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_THAT(result.out, AllOf(HasSubstr("67 rows"), HasSubstr("stair-a10-lit1"),
                                  HasSubstr("criterion F* = 0.6465")));
    std::string text = contents(table);
    const std::size_t cell = text.rfind("\t1\t", text.size() / 2);  // some 1 becomes 0
    text[cell + 1] = '0';
    std::ofstream(table, std::ios::binary) << text;
    result = studyApp({"--replay", table.string()});
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_THAT(result.err,
                AllOf(HasSubstr(table.string()), HasSubstr("line "), HasSubstr("column ")));
}

TEST(StudyApp, SimulatesAStudy) {
    const tests::TemporaryFolder folder;
    const tests::CommandResult result =
        studyApp({"--headless", "--design", "quick", "--data", folder.path().string(),
                  "--observers", "3", "--observer", "simulated", "--seed", "1"});
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_THAT(result.out, AllOf(HasSubstr("sub-03"), HasSubstr("201 rows")));
    EXPECT_EQ(records::findTrialTables(folder.path()).size(), 3u);
}

struct Misuse {
    std::vector<std::string> arguments;
    int exitCode;
    const char* part;  // of the sentence
};

TEST(StudyApp, AnswersMisuseWithOneSentence) {
    const tests::TemporaryFolder folder;
    const std::string data = (folder.path() / "data").string();
    const auto with = [&](std::vector<std::string> changes) {
        std::vector<std::string> arguments = headless(data, "quick");
        for (std::size_t i = 0; i + 1 < changes.size(); i += 2) {
            for (std::size_t k = 0; k + 1 < arguments.size(); ++k) {
                if (arguments[k] == changes[i]) arguments[k + 1] = changes[i + 1];
            }
        }
        return arguments;
    };
    std::vector<std::string> both = headless(data, "quick");
    both.insert(both.end(), {"--observers", "2"});
    unsetenv("DISPLAY");
    unsetenv("WAYLAND_DISPLAY");
    const std::vector<Misuse> misuses{
        {{}, 1, "display"},
        {{"--design", "quick", "--data", data, "--participant", "01"}, 1, "display"},
        {{"--design", "quick", "--observer", "simulated"}, 2, "--headless"},
        {{"--headless"}, 2, "--design"},
        {{"--headless", "--design", "quick", "--data", data, "--observer", "simulated", "--seed",
          "1"},
         2,
         "--participant"},
        {both, 2, "--observers"},
        {{"--replay", "x.tsv", "--seed", "1"}, 2, "--seed"},
        {{"--replay", "/nowhere/x.tsv"}, 1, "/nowhere/x.tsv"},
        {{"--replay", ""}, 1, "--replay"},
        {{"--list-designs", "--headless"}, 2, "--headless"},
        {{"--check", "nothing"}, 1, "nothing"},
        {{"--check", "quick", "--data", data}, 2, "--data"},
        {{"--check", "quick", "--observer", "human"}, 1, "human"},
        {{"--px-per-deg", "60"}, 2, "--check"},
        {with({"--seed", "-1"}), 2, "-1"},
        {with({"--seed", "18446744073709551616"}), 2, "--seed"},
        {with({"--seed", "1.5"}), 2, "1.5"},
        {with({"--design", "nothing"}), 1, "nothing"},
        {with({"--design", "/nowhere/x.json"}), 1, "/nowhere/x.json"},
        {with({"--design", ""}), 1, "--design"},
        {with({"--data", ""}), 1, "--data"},
        {with({"--data", "/dev/null"}), 1, "/dev/null"},
        {with({"--data", "/proc/nowhere"}), 1, "/proc/nowhere"},
        {with({"--participant", "a b"}), 1, "a b"},
        {with({"--participant", ""}), 1, "participant"},
        {with({"--session", "../x"}), 1, "../x"},
        {with({"--observer", "human"}), 1, "human"},
        {with({"--observer", "simulated:c=1e300"}), 1, "from 0.001 to 1000"},
    };
    for (const Misuse& misuse : misuses) {
        std::string shown;
        for (const std::string& argument : misuse.arguments) shown += argument + " ";
        const tests::CommandResult result = studyApp(misuse.arguments);
        EXPECT_EQ(result.exitCode, misuse.exitCode) << shown;
        EXPECT_THAT(result.err, AllOf(testing::StartsWith("study_app: "), HasSubstr(misuse.part)))
            << shown;
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << shown;
        EXPECT_EQ(result.out, "") << shown;
    }
    EXPECT_FALSE(fs::exists(data)) << "a refused start leaves nothing behind";
}

TEST(StudyApp, ListsTheShippedDesigns) {
    const tests::CommandResult result = studyApp({"--list-designs"});
    EXPECT_EQ(result.exitCode, 0);
    for (const char* name : {"paper16 ", "paper24 ", "quick "})
        EXPECT_THAT(result.out, HasSubstr(name));
}

TEST(StudyApp, ChecksEveryShippedDesign) {
    for (const char* design : {"paper16", "paper24", "quick"}) {
        const auto result = studyApp({"--check", tests::shippedDesignFile(design).string(),
                                      "--observers", "20", "--px-per-deg", "60"});
        EXPECT_EQ(result.exitCode, 0) << result.err;
        EXPECT_THAT(result.out, AllOf(HasSubstr("conditions, "), HasSubstr("sd with 20 observers"),
                                      HasSubstr("a pixel is 1.00 arc minutes")));
        EXPECT_THAT(result.out, testing::Not(HasSubstr("warning"))) << "a shipped design fits";
    }
}

}  // namespace

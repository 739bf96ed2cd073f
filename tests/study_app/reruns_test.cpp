// SPDX-License-Identifier: MIT
// Flagged conditions once more: which are offered, under which name they are recorded, and that a
// fit takes them together with the session they belong to.
#include "study_app/reruns.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study_app/design_file.h"
#include "tests/run_command.h"
#include "tests/temporary_folder.h"

namespace study_app {
namespace {

using records::Response;

Design threeConditions() {
    Design d;
    d.name = "three";
    d.windowPx = 64;
    d.artifactPx = {3, 4, 6};
    d.patterns = {{.pattern = records::Pattern::stair}};
    d.noiseLevels = {0, 2};
    d.trialsPerCondition = 20;
    d.radius.max = 32;
    return d;
}

SessionRequest requestIn(const tests::TemporaryFolder& folder,
                         std::optional<std::string> session = {}) {
    return {.dataFolder = folder.path() / "data",
            .participant = "01",
            .session = std::move(session),
            .design = threeConditions(),
            .seed = 11,
            .displayWidthPx = 1280,
            .displayHeightPx = 800,
            .context = records::currentRunContext("study_app", {"study_app"})};
}

/// Sees everything at every radius in these conditions, so that their staircases end at a limit;
/// elsewhere up to r = 3 a.
void run(const SessionRequest& request, const std::vector<std::string>& unfooled,
         int trials = 1000) {
    RecordedSession recorded(request);
    for (; !recorded.session().finished() && trials > 0; --trials) {
        const records::Trial& t = recorded.session().next();
        const bool always = std::ranges::find(unfooled, t.condition) != unfooled.end();
        const bool right = always || t.filterRadiusPx < 3 * t.artifactPx || t.number % 2 == 0;
        recorded.answer(
            {.response = (t.side == "left") == right ? Response::left : Response::right});
    }
}

std::vector<std::string> offered(const SessionRequest& request) {
    std::vector<std::string> names;
    for (const RunResult& r : runResults(runsOf(request))) {
        if (r.offered) names.push_back(r.result.threshold.condition);
    }
    return names;
}

TEST(Reruns, OfferEveryFlaggedConditionUntilItIsFlaggedNoMore) {
    for (const std::optional<std::string>& id : std::vector<std::optional<std::string>>{{}, "2"}) {
        const tests::TemporaryFolder folder;
        const SessionRequest first = requestIn(folder, id);
        const std::vector<std::string> flagged{"stair-a3-lit1-noise0", "stair-a6-lit1-noise2"};
        run(first, flagged);
        ASSERT_EQ(offered(first), flagged);

        const SessionRequest again = rerunRequest(first, flagged[0], 5);
        EXPECT_EQ(again.session, id.value_or("") + "rerun1");
        EXPECT_EQ(validate(again.design), "");
        ASSERT_EQ(conditions(again.design).size(), 1u);
        EXPECT_EQ(conditions(again.design)[0].name, flagged[0]);
        run(again, {});
        // From the rerun's end as from the first one's: what is still flagged is still offered.
        for (const SessionRequest& from : {first, again}) {
            EXPECT_THAT(offered(from), testing::ElementsAre(flagged[1]));
        }
        const SessionRequest other = rerunRequest(again, flagged[1], 6);
        EXPECT_EQ(other.session, id.value_or("") + "rerun2");
        run(other, flagged);
        EXPECT_THAT(offered(again), testing::ElementsAre(flagged[1]));
        run(rerunRequest(other, flagged[1], 7), {});
        EXPECT_THAT(offered(other), testing::IsEmpty());
        EXPECT_EQ(runsOf(other).size(), 4u);
    }
}

TEST(Reruns, GoOnWithOneThatWasLeftUnfinished) {
    const tests::TemporaryFolder folder;
    const SessionRequest first = requestIn(folder);
    run(first, {"stair-a3-lit1-noise0", "stair-a4-lit1-noise0"});
    run(rerunRequest(first, "stair-a3-lit1-noise0", 5), {}, 7);
    const SessionRequest resumed = rerunRequest(first, "stair-a3-lit1-noise0", 6);
    EXPECT_EQ(resumed.session, "rerun1");
    EXPECT_EQ(RecordedSession(resumed).session().answered(), 7u);
    EXPECT_EQ(rerunRequest(first, "stair-a4-lit1-noise0", 6).session, "rerun2");
}

TEST(Reruns, BeginOneAgainThatWasKilledAsItBegan) {
    const tests::TemporaryFolder folder;
    const SessionRequest first = requestIn(folder);
    run(first, {"stair-a3-lit1-noise0"});
    {
        const records::TrialJournal begun(
            records::trialTablePath(first.dataFolder, first.participant, "rerun1"));
    }
    EXPECT_EQ(runsOf(first).size(), 1u);
    SessionRequest again = rerunRequest(first, "stair-a3-lit1-noise0", 5);
    EXPECT_EQ(again.session, "rerun1");
    again.session = "rerun2";
    run(again, {});
    EXPECT_EQ(runsOf(first).size(), 2u) << "the one after it counts";
    EXPECT_EQ(runsOf(first).back().rerun, "rerun2");
}

TEST(Reruns, AreNotTakenForThoseOfAnotherDesign) {
    const tests::TemporaryFolder folder;
    const SessionRequest first = requestIn(folder);
    run(first, {"stair-a3-lit1-noise0"});
    SessionRequest stranger = requestIn(folder, "rerun1");
    stranger.design.trialsPerCondition = 5;
    run(stranger, {});
    EXPECT_EQ(runsOf(first).size(), 1u);
    EXPECT_EQ(rerunRequest(first, "stair-a3-lit1-noise0", 6).session, "rerun2");
}

TEST(Reruns, CountAttentionAsTheFitDoes) {
    const tests::TemporaryFolder folder;
    const SessionRequest first = requestIn(folder);
    run(first, {"stair-a3-lit1-noise0"});
    const int before = catchResult(runsOf(first)).answered;
    run(rerunRequest(first, "stair-a3-lit1-noise0", 5), {});
    EXPECT_EQ(catchResult(runsOf(first)).answered, before + 2);
}

TEST(Reruns, AreFittedTogetherWithTheirSession) {
    const tests::TemporaryFolder folder;
    const std::string data = (folder.path() / "data").string();
    const tests::CommandResult simulated = tests::runProgram(
        "study_app", {"--headless", "--design", "quick", "--data", data, "--observers", "3",
                      "--observer", "simulated", "--seed", "3"});
    ASSERT_EQ(simulated.exitCode, 0) << simulated.err;
    SessionRequest first = requestIn(folder);
    first.design = readDesign(findDesign("quick"));
    run(rerunRequest(first, "step-a10-lit1", 5), {});
    const std::string out = (folder.path() / "fit").string();
    const tests::CommandResult fit = tests::runProgram("fit_slope", {data, "--out", out});
    EXPECT_EQ(fit.exitCode, 0) << fit.err;
    // 15 trials of each of three observers, and the rerun with its 2 catch trials.
    EXPECT_THAT(fit.out, testing::ContainsRegex("step, lit 1 +10 +3 +62 "));
}

}  // namespace
}  // namespace study_app

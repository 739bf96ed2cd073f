// SPDX-License-Identifier: MIT
// shadow_bench --sweep as its user runs it: a tiny sweep, killed, gone on with, in two shards.
#include <gmock/gmock.h>

#include <filesystem>

#include "demo/direct_run.h"
#include "demo/sizing_policy.h"
#include "demo/sweep_table.h"
#include "demo/swept_view.h"
#include "demo/tsv_journal.h"
#include "records/whole_file.h"
#include "tests/run_command.h"
#include "tests/temporary_folder.h"

namespace {

using testing::HasSubstr;

std::vector<std::string> tinySweep(const std::filesystem::path& out,
                                   std::vector<std::string> more = {}) {
    std::vector<std::string> arguments = {"--sweep",
                                          "--out",
                                          out.string(),
                                          "--scenes",
                                          "planar_occluder",
                                          "--techniques",
                                          "pcf_disc,vsm",
                                          "--sizes",
                                          "64,128",
                                          "--frames",
                                          "1",
                                          "--rounds",
                                          "2",
                                          "--width",
                                          "160",
                                          "--height",
                                          "90"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

TEST(Sweep, MeasuresEveryCellAndReports) {
    const tests::TemporaryFolder folder;
    const auto result = tests::runProgram("shadow_bench", tinySweep(folder.path()));
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("report: "));
    const demo::SweepTable table = demo::readSweep(folder.path());
    ASSERT_EQ(table.cells.size(), 4U);
    for (const demo::SweepCell& cell : table.cells) {
        EXPECT_EQ(cell.status, "ok");
        EXPECT_EQ(cell.frameMs.count, 2);
        EXPECT_GT(cell.frameMs.median, 0);
        EXPECT_EQ(cell.reference, 128);
        EXPECT_EQ(cell.rmse == 0, cell.resolution == 128);
        EXPECT_EQ(cell.rippleMost == 0, cell.resolution == 128);
        EXPECT_GE(cell.flickerLight, 0);
    }
    EXPECT_EQ(table.policySizes.size(), 2 * demo::sizingPolicies().size());

    // Each calibrated policy drew its frames itself, and so did the automatic size.
    const std::vector<demo::DirectRow> direct = demo::readDirect(folder.path());
    int automatic = 0;
    for (const demo::DirectRow& row : direct) {
        EXPECT_GT(row.frameMs, 0);
        EXPECT_EQ(row.reference, 128);
        automatic += row.policy == demo::kControllerRun;
        // What the table said of this size is what it looks like.
        if (const auto* cell = table.find(row.scene, row.frame, row.technique, row.resolution);
            cell != nullptr && row.policy != demo::kControllerRun) {
            EXPECT_NEAR(row.rmse, cell->rmse, 1e-5) << row.policy;
            EXPECT_NEAR(row.rippleP95, cell->rippleP95, 1e-5) << row.policy;
        }
    }
    EXPECT_EQ(automatic, 2);
    for (const demo::PolicyComparison& comparison : demo::comparePolicies(table))
        for (const auto& entry : comparison.entries)
            EXPECT_EQ(
                entry.result && demo::directResult(direct, table, *entry.result, comparison.over),
                entry.result.has_value())
                << entry.policy->name;
    for (const char* technique : {"pcf_disc", "vsm"})
        EXPECT_TRUE(std::filesystem::exists(
            demo::errorPicture(folder.path(), "planar_occluder", technique)));
    EXPECT_THAT(records::readWholeFile(folder.path() / "sweep.html"), HasSubstr("<td>direct</td>"));

    // Nothing is left to measure.
    const std::string times = records::readWholeFile(folder.path() / "sweep_times.tsv");
    ASSERT_EQ(tests::runProgram("shadow_bench", tinySweep(folder.path())).exitCode, 0);
    EXPECT_EQ(records::readWholeFile(folder.path() / "sweep_times.tsv"), times);

    // The policies are asked again where their journal is gone, or has other steps.
    const auto policies = folder.path() / "sweep_policies.tsv";
    const std::string asked = records::readWholeFile(policies);
    std::filesystem::remove(policies);
    ASSERT_EQ(tests::runProgram("shadow_bench", tinySweep(folder.path())).exitCode, 0);
    EXPECT_EQ(demo::readSweep(folder.path()).policySizes, table.policySizes);
    records::writeWholeFile(policies, asked.substr(0, asked.rfind(',')) + "\n");
    ASSERT_EQ(tests::runProgram("shadow_bench", tinySweep(folder.path())).exitCode, 0);
    EXPECT_EQ(demo::readSweep(folder.path()).policySizes, table.policySizes);
    EXPECT_EQ(records::readWholeFile(folder.path() / "sweep_times.tsv"), times);

    // Killed in the middle of the second round's first line of a unit.
    const auto file = folder.path() / "sweep_times.tsv";
    const std::string kept = times.substr(0, times.rfind("planar_occluder"));
    records::writeWholeFile(file, kept.substr(0, kept.rfind("planar_occluder") + 7));
    ASSERT_EQ(tests::runProgram("shadow_bench", tinySweep(folder.path())).exitCode, 0);
    const demo::SweepTable again = demo::readSweep(folder.path());
    for (const demo::SweepCell& cell : again.cells) EXPECT_EQ(cell.frameMs.count, 2);

    // Of another revision: it goes on, and says so.
    std::string revised = records::readWholeFile(file);
    revised.replace(revised.find("revision "), 9, "revision x");
    records::writeWholeFile(file, revised);
    EXPECT_THAT(tests::runProgram("shadow_bench", tinySweep(folder.path())).err,
                HasSubstr("goes on from another run: revision is \"x"));

    auto differently = tinySweep(folder.path());
    differently.back() = "80";
    EXPECT_THAT(tests::runProgram("shadow_bench", differently).err, HasSubstr("another plan"));

    const auto compared = tests::runProgram(
        "shadow_bench", {"--compare", folder.path().string(), folder.path().string()});
    EXPECT_THAT(compared.out, HasSubstr("0 slower, worse or missing"));
    const auto recommended = tests::runProgram(
        "shadow_bench",
        {"--recommend", folder.path().string(), "--scene", "planar_occluder", "--max-error", "1"});
    EXPECT_THAT(recommended.out, HasSubstr(" at 64: "));
}

TEST(Sweep, ShardsTogetherAreTheWhole) {
    const tests::TemporaryFolder folder;
    for (const char* shard : {"1/2", "2/2"}) {
        const auto result =
            tests::runProgram("shadow_bench", tinySweep(folder.path(), {"--shard", shard}));
        ASSERT_EQ(result.exitCode, 0) << result.err;
    }
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "sweep_times.2of2.tsv"));
    const tests::TemporaryFolder wholeFolder;
    ASSERT_EQ(tests::runProgram("shadow_bench", tinySweep(wholeFolder.path())).exitCode, 0);
    const demo::SweepTable whole = demo::readSweep(wholeFolder.path());
    const demo::SweepTable parts = demo::readSweep(folder.path());
    ASSERT_EQ(parts.cells.size(), 4U);
    EXPECT_EQ(parts.policySizes, whole.policySizes);
    for (const demo::SweepCell& cell : whole.cells) {
        const auto* same = parts.find(cell.scene, cell.frame, cell.technique, cell.resolution);
        ASSERT_NE(same, nullptr);
        EXPECT_EQ(same->rmse, cell.rmse);
        EXPECT_EQ(same->ripples, cell.ripples);
        EXPECT_EQ(same->flickerLight, cell.flickerLight);
        EXPECT_EQ(same->frameMs.count, cell.frameMs.count);
    }
    const auto report = tests::runProgram("shadow_bench", tinySweep(folder.path(), {"--report"}));
    EXPECT_EQ(report.exitCode, 0) << report.err;
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "sweep.html"));

    // Parts of different sweeps are not one.
    const auto second = folder.path() / "sweep_times.2of2.tsv";
    std::string text = records::readWholeFile(second);
    const std::string plan = "160 x 90 px, 1 frames";
    text.replace(text.find(plan), plan.size(), "320 x 90 px, 1 frames");
    records::writeWholeFile(second, text);
    EXPECT_THAT(tests::runProgram("shadow_bench", tinySweep(folder.path(), {"--report"})).err,
                HasSubstr("sweep_times.2of2.tsv: is of another sweep than"));
}

TEST(Sweep, GoesAlongTheScenesOwnPathsAtEverySoftness) {
    const tests::TemporaryFolder folder;
    auto arguments = tinySweep(folder.path(), {"--softness", "1,2"});
    for (std::size_t i = 0; i + 1 < arguments.size(); ++i)
        if (arguments[i] == "--frames") arguments[i + 1] = "2";
    const auto result = tests::runProgram("shadow_bench", arguments);
    ASSERT_EQ(result.exitCode, 0) << result.err;
    const demo::SweepTable table = demo::readSweep(folder.path());
    ASSERT_EQ(table.scenes,
              (std::vector<std::string>{"planar_occluder", "planar_occluder softness 2"}));
    ASSERT_EQ(table.frames, 2);
    for (const int frame : {0, 1})
        EXPECT_NEAR(table.find(table.scenes[1], frame, "vsm", 64)->radiusUv,
                    2 * table.find(table.scenes[0], frame, "vsm", 64)->radiusUv, 1e-6);
    // Half of the way: the light has moved too.
    const renderer::Scene scene = renderer::makeScene("planar_occluder");
    const demo::PathView half = demo::pathView(scene, 1, 2);
    EXPECT_EQ(half.sun.azimuthDeg, renderer::along(scene.sunPath, scene.sun, 0.5).azimuthDeg);
    EXPECT_EQ(half.camera.yawDeg, renderer::along(scene.cameraPath, scene.camera, 0.5).yawDeg);
    EXPECT_NE(half.sun.azimuthDeg, scene.sun.azimuthDeg);
}

TEST(Sweep, RefusesBadInputInOneSentence) {
    const tests::TemporaryFolder folder;
    const std::string out = folder.path().string();
    for (const auto& [arguments, sentence] :
         std::vector<std::pair<std::vector<std::string>, std::string>>{
             {{"--sweep", "--out", out, "--shard", "3/2"}, "--shard is \"3/2\""},
             {{"--sweep", "--out", out, "--shard", "x"}, "--shard is \"x\""},
             {{"--sweep", "--out", out, "--sizes", "100,200"}, "sizes has 100"},
             {{"--sweep", "--out", out, "--sizes", "256,128"}, "ascending"},
             {{"--sweep", "--out", out, "--frames", "0"}, "frames is 0"},
             {{"--sweep", "--out", out, "--width", "0"}, "width is 0 px"},
             {{"--sweep", "--out", out, "--height", "99999"}, "height is 99999 px"},
             {{"--sweep", "--out", out, "--techniques", "vsm:taps=3"}, "taps"},
             {{"--sweep", "--out", out, "--techniques", "pcf_taps:taps"}, "PARAMETER=NUMBER"},
             {{"--sweep", "--out", out, "--techniques", "pcf_taps:taps=999"}, "taps"},
             {{"--sweep", "--out", out, "--softness", "0"}, "softness has 0"},
             {{"--sweep", "--out", out, "--scenes", "nope"}, "\"nope\" is not known"},
             {{"--growth", "--out", out, "--scenes", "yard,city"}, "--growth takes one scene"},
             {{"--growth", "--out", out, "--rounds", "0"}, "rounds is 0"},
             {{"--sweep", "--out", out, "--most-ms", "-1"}, "must be greater than 0"},
             {{"--sweep", "--out", out, "--stability", out + "/none.md"}, "none.md"},
             {{"--sweep", "--report", "--out", out + "/none"}, "there is no sweep"},
             {{"--compare", out, out}, "there is no sweep"},
             {{"--recommend", out}, "--recommend needs --max-error, --max-ms or both"},
             {{"--recommend", out, "--max-ms", "nan"}, "--max-ms is n/a, must be at least 0"},
             {{"--recommend", out, "--max-error", "-1"}, "--max-error is -1"},
             {{"--recommend", out, "--max-ms", "5"}, "there is no sweep"}}) {
        const auto result = tests::runProgram("shadow_bench", arguments);
        EXPECT_EQ(result.exitCode, 1) << sentence;
        EXPECT_THAT(result.err, HasSubstr(sentence));
    }
    // What means nothing without --sweep is not ignored.
    for (const char* option : {"--report", "--direct", "--model"})
        EXPECT_EQ(tests::runProgram("shadow_bench", {option, "--out", out}).exitCode, 2) << option;
    EXPECT_EQ(tests::runProgram("shadow_bench", {"--shard", "1/2", "--out", out}).exitCode, 2);
    EXPECT_EQ(tests::runProgram("shadow_bench", {"--sweep", "--growth", "--out", out}).exitCode, 2);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()))
        << "a wrong word leaves no journal behind";
}

}  // namespace

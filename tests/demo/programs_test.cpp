// SPDX-License-Identifier: MIT
// shadow_demo and shadow_bench as their users start them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "records/run_context.h"
#include "records/whole_file.h"
#include "renderer/scene.h"
#include "renderer/technique.h"
#include "tests/project_folders.h"
#include "tests/run_command.h"
#include "tests/temporary_folder.h"

namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::vector<std::string> smallFrame(std::vector<std::string> more) {
    std::vector<std::string> arguments = {"--headless", "--width", "64", "--height", "36"};
    if (std::ranges::find(more, "--frames") == more.end()) {
        more.emplace_back("--frames");
        more.emplace_back("1");
    }
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

/// A line that begins with the name and a tab.
bool hasLineFor(const std::string& text, std::string_view name) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
        if (line.size() > name.size() && line.starts_with(name) && line[name.size()] == '\t')
            return true;
    return false;
}

TEST(ShadowDemo, ListsWhatTheTablesHold) {
    const auto techniques = tests::runProgram("shadow_demo", {"--list-techniques"});
    EXPECT_EQ(techniques.exitCode, 0);
    for (const renderer::Technique& technique : renderer::techniques())
        EXPECT_TRUE(hasLineFor(techniques.out, technique.name)) << technique.name;
    const auto scenes = tests::runProgram("shadow_demo", {"--list-scenes"});
    for (const renderer::SceneEntry& entry : renderer::builtInScenes())
        EXPECT_TRUE(hasLineFor(scenes.out, entry.name)) << entry.name;
}

TEST(ShadowDemo, WritesAPictureAndItsStats) {
    const tests::TemporaryFolder folder;
    const std::string png = (folder.path() / "frame.png").string();
    const std::string json = (folder.path() / "stats.json").string();
    const auto result = tests::runProgram(
        "shadow_demo", smallFrame({"--scene", "planar_occluder", "--screenshot", png, "--stats",
                                   json, "--parameter", "bias_texels=0.5"}));
    ASSERT_EQ(result.exitCode, 0) << result.err;
    const cv::Mat picture = cv::imread(png);
    EXPECT_EQ(picture.cols, 64);
    EXPECT_EQ(picture.rows, 36);
    EXPECT_GT(cv::norm(picture - cv::Mat(picture.size(), picture.type(), cv::mean(picture))), 0)
        << "a flat picture";

    const auto stats = nlohmann::json::parse(std::ifstream(json));
    const records::RunContext context = records::runContextFromJson(stats.at("context"), json);
    EXPECT_EQ(context.program, "shadow_demo");
    EXPECT_TRUE(context.glRenderer.has_value());
    EXPECT_EQ(context.viewportWidthPx, 64);
    EXPECT_EQ(stats.at("resolution_mode"), "auto");
    EXPECT_GE(stats.at("resolution").get<int>(), 1);
    EXPECT_FALSE(stats.at("reason").get<std::string>().empty());
    EXPECT_EQ(stats.at("parameters").at("bias_texels"), 0.5);
    EXPECT_EQ(stats.at("slope").at("c"), 3.47);
    for (const char* pass : {"depth", "prepass", "lookup", "lit", "demand"})
        EXPECT_GT(stats.at("passes_ms").at(pass).at("median").get<double>(), 0) << pass;
    const int n = stats.at("resolution");
    EXPECT_EQ(stats.at("map_bytes").get<int>(), 4 * n * n);
    ASSERT_EQ(stats.at("maps").size(), 1U);
    EXPECT_EQ(stats.at("maps").at(0).at("map"), "sun");
    EXPECT_EQ(stats.at("maps").at(0).at("resolution"), n);
    EXPECT_TRUE(stats.at("budget").is_null());
}

TEST(ShadowDemo, SharesABudgetAmongMapsAndRecordsWhy) {
    const tests::TemporaryFolder folder;
    const std::string json = (folder.path() / "stats.json").string();
    const std::string trace = (folder.path() / "sizes.trace").string();
    const auto result = tests::runProgram(
        "shadow_demo", smallFrame({"--scene", "yard:cascades=2", "--budget-texels", "300000",
                                   "--stats", json, "--trace", trace}));
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("sun, cascade 2"));
    EXPECT_THAT(result.out, HasSubstr("budget: 300000 texels"));
    const auto stats = nlohmann::json::parse(std::ifstream(json));
    ASSERT_EQ(stats.at("maps").size(), 2U);
    int used = 0;
    for (const auto& map : stats.at("maps")) {
        EXPECT_FALSE(map.at("reason").get<std::string>().empty());
        EXPECT_GE(map.at("artifact_ratio").get<double>(), 0);
        used += map.at("resolution").get<int>() * map.at("resolution").get<int>();
    }
    EXPECT_LE(used, 300000);
    EXPECT_EQ(stats.at("budget").at("used_texels"), used);
    EXPECT_EQ(stats.at("budget").at("texels"), 300000);

    const auto replayed = tests::runProgram("shadow_demo", {"--replay", trace});
    EXPECT_EQ(replayed.exitCode, 0) << replayed.err;
    EXPECT_THAT(replayed.out, HasSubstr("every decision the same"));
    std::ofstream(trace, std::ios::app) << "x";
    const auto damaged = tests::runProgram("shadow_demo", {"--replay", trace});
    EXPECT_EQ(damaged.exitCode, 1);
    EXPECT_THAT(damaged.err, HasSubstr(trace + ": "));
}

TEST(ShadowDemo, RefusesBadInputInOneSentence) {
    const tests::TemporaryFolder folder;
    const std::string file = (folder.path() / "file").string();
    std::ofstream(file) << "not a slope";
    const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
        {{"--scene", "nope"}, "scene \"nope\" is not known; known are: planar_occluder, yard"},
        {{"--technique", "nope"}, "technique \"nope\" is not known; known are: hard, pcf_disc"},
        {{"--resolution", "0"}, "--resolution is \"0\""},
        {{"--resolution", "-8"}, "--resolution is \"-8\""},
        {{"--resolution", "1000000"}, "what the driver allows"},
        {{"--budget-texels", "0"}, "budget_texels: 0: must be in [1, 1e+12]"},
        {{"--budget-texels", "-4"}, "budget_texels: -4: must be in"},
        {{"--window-picture", file}, "--window-picture needs a window and --frames"},
        {{"--replay", file}, file},
        {{"--replay", "/no/such.trace"}, "/no/such.trace"},
        {{"--trace", file, "--resolution", "64"}, "--trace: nothing was recorded"},
        {{"--radius", "nan"}, "radius is nan"},
        {{"--radius", "-1"}, "radius is -1"},
        {{"--radius-uv", "1.5"}, "no wider than the map"},
        {{"--slope", file}, file},
        {{"--slope", "/no/such/file.json"}, "/no/such/file.json"},
        {{"--stats", file + "/below.json"}, file},
        {{"--screenshot", file + "/below.png"}, file},
        {{"--parameter", "bias_texels"}, "NAME=NUMBER"},
        {{"--technique", "vsm", "--parameter", "bias_texels=auto"},
         "--parameter is \"bias_texels=auto\", but bias_texels of technique vsm has no automatic "
         "choice; must be 0 to 4"},
        {{"--parameter", "bias_texels=nan"}, "nan"},
        {{"--parameter", "size=1"}, "no parameter \"size\""},
        {{"--samples", "0"}, "--samples is 0"},
        {{"--shaders", "/no/such"}, "shader folder /no/such does not exist"}};
    for (const auto& [arguments, sentence] : cases) {
        const auto result = tests::runProgram("shadow_demo", smallFrame(arguments));
        EXPECT_EQ(result.exitCode, 1) << arguments[1];
        EXPECT_THAT(result.err, HasSubstr(sentence));
        EXPECT_THAT(result.err, testing::Not(HasSubstr("terminate called")));
    }
    const auto zero = tests::runProgram("shadow_demo", {"--headless", "--width", "0"});
    EXPECT_EQ(zero.exitCode, 1);
    EXPECT_THAT(zero.err, HasSubstr("viewport is 0 x 720"));
}

TEST(ShadowDemo, NamesTheStateFileWhoseSceneCannotBeShown) {
    const tests::TemporaryFolder folder;
    const std::string file = (folder.path() / "state.json").string();
    ASSERT_EQ(tests::runProgram("shadow_demo", smallFrame({"--state", file})).exitCode, 0);
    auto state = nlohmann::json::parse(std::ifstream(file));
    for (const auto& [scene, sentence] : std::vector<std::pair<std::string, std::string>>{
             {"/no/such.obj", "/no/such.obj: no such model file"},
             {"yard:cascades=99", "scene \"yard:cascades=99\": cascades is \"99\""}}) {
        state["scene"] = scene;
        std::ofstream(file) << state;
        const auto result = tests::runProgram("shadow_demo", smallFrame({"--state", file}));
        EXPECT_EQ(result.exitCode, 1);
        EXPECT_THAT(result.err, StartsWith("shadow_demo: " + file + ": field scene: " + sentence));
        // Not where the command line names the scene.
        const auto other =
            tests::runProgram("shadow_demo", smallFrame({"--state", file, "--scene", scene}));
        EXPECT_THAT(other.err, StartsWith("shadow_demo: " + sentence));
    }
}

TEST(ShadowDemo, SaysThatAStillSequenceIsOnePicture) {
    const tests::TemporaryFolder folder;
    const std::string out = (folder.path() / "sequence").string();
    const auto sequence = [&](std::vector<std::string> more) {
        more.insert(more.end(), {"--sequence", out});
        return tests::runProgram("shadow_demo", smallFrame(more)).err;
    };
    EXPECT_EQ(sequence({}), "") << "a single picture";
    EXPECT_THAT(sequence({"--frames", "2"}), HasSubstr("note: --path is still"));
    EXPECT_EQ(sequence({"--frames", "2", "--path", "sun"}), "");
}

TEST(ShadowDemo, NamesARangeAsItsListDoes) {
    const auto refused = tests::runProgram(
        "shadow_demo", smallFrame({"--technique", "lvsm", "--parameter", "layers=17"}));
    EXPECT_EQ(refused.exitCode, 1);
    EXPECT_THAT(refused.err, HasSubstr("layers of technique lvsm is 17, must be auto or 1 to 16"));
    EXPECT_THAT(tests::runProgram("shadow_demo", {"--list-techniques"}).out,
                HasSubstr("auto or 1 to 16"));
}

TEST(ShadowDemo, StopsAtTheStartWhereAShaderOfTheFolderDoesNotCompile) {
    const tests::TemporaryFolder folder;
    std::filesystem::copy(tests::sourceFolder() / "renderer/shaders", folder.path(),
                          std::filesystem::copy_options::recursive);
    const std::vector<std::string> arguments = smallFrame({"--shaders", folder.path().string()});
    EXPECT_EQ(tests::runProgram("shadow_demo", arguments).exitCode, 0);
    const std::filesystem::path file = folder.path() / "filters/pcf_disc.glsl";
    std::ofstream(file, std::ios::app) << "oops\n";
    const auto result = tests::runProgram("shadow_demo", arguments);
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_THAT(result.err, HasSubstr(file.string() + ":"));
}

TEST(ShadowDemo, SaysWhatIsMissingWithoutOpenGl45) {
    // Mesa is told to offer no more than 3.3; the sentence names what was tried.
    ::setenv("MESA_GL_VERSION_OVERRIDE", "3.3", 1);
    const auto result = tests::runProgram("shadow_demo", smallFrame({}));
    ::unsetenv("MESA_GL_VERSION_OVERRIDE");
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_THAT(result.err, HasSubstr("no OpenGL 4.5 core context could be made"));
    EXPECT_THAT(result.err, HasSubstr("EGL"));
}

TEST(ShadowDemo, SaysThatThereIsNoDisplay) {
    const char* display = std::getenv("DISPLAY");
    const std::string saved = display == nullptr ? "" : display;
    ::unsetenv("DISPLAY");
    const auto result = tests::runProgram("shadow_demo", {"--frames", "1"});
    if (!saved.empty()) ::setenv("DISPLAY", saved.c_str(), 1);
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_THAT(result.err, HasSubstr("window: "));
}

TEST(ShadowDemo, RunsInAWindow) {
    const tests::TemporaryFolder folder;
    const std::string json = (folder.path() / "stats.json").string();
    const std::string png = (folder.path() / "frame.png").string();
    const std::string log = (folder.path() / "log").string();
    ::setenv("XDG_STATE_HOME", folder.path().c_str(), 1);
    const auto shown = [&](const std::string& options) {
        const std::string command = "xvfb-run -a -s '-screen 0 320x200x24' " +
                                    (tests::programFolder() / "shadow_demo").string() +
                                    " --frames 3 --width 96 --height 54 --stats " + json +
                                    " --screenshot " + png + options + " > " + log + " 2>&1";
        const int status = std::system(command.c_str());
        EXPECT_EQ(status, 0) << records::readWholeFile(log);
    };
    shown("");
    EXPECT_EQ(nlohmann::json::parse(std::ifstream(json)).at("scene"), "yard");
    EXPECT_EQ(cv::imread(png).cols, 96);
    // What it showed at the end is what it shows at the next start.
    shown(" --scene planar_occluder --percentile 0.9");
    shown("");
    EXPECT_EQ(nlohmann::json::parse(std::ifstream(json)).at("scene"), "planar_occluder");
    const std::filesystem::path own = folder.path() / "stairwell" / "shadow_demo.json";
    EXPECT_EQ(nlohmann::json::parse(std::ifstream(own)).at("percentile"), 0.9);
    const std::string window = (folder.path() / "window.png").string();
    shown(" --window-picture " + window);
    EXPECT_EQ(cv::imread(window).cols, 96);
    EXPECT_GT(cv::norm(cv::imread(window), cv::imread(png)), 0) << "the panel lies over it";
    std::ofstream(own) << "{";
    shown("");
    EXPECT_THAT(records::readWholeFile(log), HasSubstr("beginning anew"));
    ::unsetenv("XDG_STATE_HOME");
}

/// Starts the window for two frames; exit code, and what it said.
std::pair<int, std::string> startedInWindow(const std::filesystem::path& log,
                                            const std::string& options) {
    const std::string command = "xvfb-run -a -s '-screen 0 320x200x24' " +
                                (tests::programFolder() / "shadow_demo").string() +
                                " --frames 2 --width 96 --height 54 " + options + " > " +
                                log.string() + " 2>&1";
    const int status = std::system(command.c_str());
    return {status, records::readWholeFile(log)};
}

// Nobody asked for it, and without the window it cannot be changed.
TEST(ShadowDemo, BeginsAnewWhereTheKeptStateCannotBeShown) {
    const tests::TemporaryFolder folder;
    ::setenv("XDG_STATE_HOME", folder.path().c_str(), 1);
    const auto log = folder.path() / "log", own = folder.path() / "stairwell/shadow_demo.json";
    ASSERT_EQ(startedInWindow(log, "").first, 0);
    const auto good = nlohmann::json::parse(std::ifstream(own));
    const std::string noSlope = (folder.path() / "no slope.json").string();
    std::ofstream(noSlope) << "{\"c\": 3}";
    const std::vector<nlohmann::json> changes = {
        {{"resolution", 1000000}},
        {{"slope", folder.path().string()}},
        {{"slope", noSlope}},
        {{"slope", "/no/such/slope.json"}},
        {{"view", "difference"}, {"compare_with", 1000000}},
        {{"view", "split"}, {"compare_with", 1000000}},
        {{"scene", "/no/such/model.obj"}}};
    for (const nlohmann::json& change : changes) {
        nlohmann::json state = good;
        state.update(change);
        std::ofstream(own) << state;
        const auto [status, said] = startedInWindow(log, "");
        EXPECT_EQ(status, 0) << change << said;
        EXPECT_THAT(said, HasSubstr("note: ")) << change;
        EXPECT_THAT(said, HasSubstr("beginning anew")) << change;
        EXPECT_EQ(nlohmann::json::parse(std::ifstream(own)), good) << change;
        // A file that was named stays an error.
        const auto named = folder.path() / "named.json";
        std::ofstream(named) << state;
        const auto [refused, sentence] = startedInWindow(log, "--state " + named.string());
        EXPECT_NE(refused, 0) << change << sentence;
        EXPECT_EQ(nlohmann::json::parse(std::ifstream(named)), state) << change;
    }
    ::unsetenv("XDG_STATE_HOME");
}

TEST(ShadowBench, WritesOneReportWithItsTable) {
    const tests::TemporaryFolder folder;
    const std::filesystem::path out = folder.path() / "made" / "here";
    const auto result = tests::runProgram(
        "shadow_bench",
        {"--out", out.string(), "--resolutions", "auto,64,256", "--width", "160", "--height", "90",
         "--rounds", "2", "--scenes", "planar_occluder", "--techniques", "pcf_disc"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("the speed of the fixed 256 map"));
    EXPECT_THAT(result.out, HasSubstr("report: " + (out / "report.html").string()));

    std::istringstream table(records::readWholeFile(out / "benchmark.tsv"));
    std::vector<std::vector<std::string>> rows;
    std::string line;
    int context = 0;
    while (std::getline(table, line)) {
        if (line.front() == '#') {
            ++context;
            continue;
        }
        rows.emplace_back();
        std::istringstream cells(line);
        for (std::string cell; std::getline(cells, cell, '\t');) rows.back().push_back(cell);
    }
    EXPECT_GT(context, 5);
    ASSERT_EQ(rows.size(), 4U);
    for (const auto& row : rows) EXPECT_EQ(row.size(), rows[0].size());
    const auto cell = [&](std::size_t row, const std::string& name) {
        const auto column = std::find(rows[0].begin(), rows[0].end(), name) - rows[0].begin();
        return rows.at(row).at(static_cast<std::size_t>(column));
    };
    EXPECT_EQ(cell(1, "resolution_mode"), "auto");
    EXPECT_EQ(cell(3, "is_reference"), "1");
    EXPECT_EQ(cell(3, "rmse"), "0");
    EXPECT_GT(std::stod(cell(2, "rmse")), 0.001);
    EXPECT_GT(std::stod(cell(2, "frame_ms")), 0);

    const std::string page = records::readWholeFile(out / "report.html");
    EXPECT_THAT(page, HasSubstr("<svg"));
    EXPECT_THAT(page, HasSubstr("data:image/png;base64,"));
    EXPECT_THAT(page, testing::Not(HasSubstr("src=\"http")));
}

TEST(ShadowBench, RefusesBadInputInOneSentence) {
    const tests::TemporaryFolder folder;
    const std::string file = (folder.path() / "file").string();
    std::ofstream(file) << "x";
    const std::string out = (folder.path() / "out").string();
    const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
        {{"--out", out, "--scenes", "nope"}, "scene \"nope\" is not known"},
        {{"--out", out, "--techniques", "nope"}, "technique \"nope\" is not known"},
        {{"--out", out, "--resolutions", "auto"}, "no fixed size"},
        {{"--out", out, "--resolutions", "0"}, "--resolutions is \"0\""},
        {{"--out", out, "--rounds", "0"}, "rounds is 0"},
        {{"--out", out, "--slope", file}, file},
        {{"--out", out, "--fit", out}, "slope.json"},
        {{"--out", file + "/below"}, file}};
    for (const auto& [arguments, sentence] : cases) {
        const auto result = tests::runProgram("shadow_bench", arguments);
        EXPECT_EQ(result.exitCode, 1) << arguments.back();
        EXPECT_THAT(result.err, StartsWith("shadow_bench: "));
        EXPECT_THAT(result.err, HasSubstr(sentence));
    }
    EXPECT_EQ(tests::runProgram("shadow_bench", {}).exitCode, 2);
}

}  // namespace

// SPDX-License-Identifier: MIT
// One thing grows at a time, and a killed run goes on.
#include "demo/growth_run.h"

#include <gmock/gmock.h>

#include <set>

#include "records/whole_file.h"
#include "tests/headless_gl.h"
#include "tests/temporary_folder.h"

namespace {

demo::GrowthSettings tiny(const std::filesystem::path& folder) {
    return {.techniques = {&renderer::findTechnique("pcf_taps"), &renderer::findTechnique("vsm")},
            .rounds = 1,
            .widthPx = 32,
            .heightPx = 18,
            .folder = folder,
            .reduction = 16};
}

TEST(GrowthRun, MeasuresEachThingAloneAndGoesOnWhereItWasKilled) {
    const tests::TemporaryFolder folder;
    const auto measure = [&] { demo::measureGrowth(tests::gl(), tiny(folder.path()), {}); };
    measure();
    const auto file = folder.path() / "growth_times.tsv";
    const std::string whole = records::readWholeFile(file);
    const std::vector<demo::Growth> all = demo::readGrowth(folder.path());
    std::set<std::string> axes;
    for (const demo::Growth& growth : all) {
        axes.insert(growth.axis);
        EXPECT_GE(growth.exponent.points, 3) << growth.axis << growth.pass;
        EXPECT_EQ(growth.axis == "taps" && growth.technique == "vsm", false) << "it has no taps";
        EXPECT_EQ(growth.pass == "prefilter_ms" && growth.technique == "pcf_taps", false);
    }
    EXPECT_EQ(axes.size(), std::size(demo::kGrowthAxes));

    measure();
    EXPECT_EQ(records::readWholeFile(file), whole) << "nothing is left to measure";
    records::writeWholeFile(file, whole.substr(0, whole.size() / 2));
    measure();
    const auto lines = [](const std::string& text) {
        return std::count(text.begin(), text.end(), '\n');
    };
    EXPECT_EQ(lines(records::readWholeFile(file)), lines(whole));
}

TEST(GrowthRun, IsReadWithItsPower) {
    const tests::TemporaryFolder folder;
    std::string text;
    for (const std::string& column : demo::kGrowthColumns)
        text += (text.empty() ? "" : "\t") + column;
    text += "\n";
    for (const int n : {512, 1024, 2048, 4096})
        for (const double noise : {0.5, 1.0, 30.0})  // the median is not led astray
            text += "N\tyard\tvsm\t" + std::to_string(n) + "\t0\t" +
                    std::to_string(1e-6 * n * n * noise) + "\t1\tn/a\t1\t1\t1\n";
    records::writeWholeFile(folder.path() / "growth_times.tsv", text);
    const auto all = demo::readGrowth(folder.path());
    ASSERT_EQ(all.size(), 4U);  // frame, depth, lookup, lit
    EXPECT_EQ(all[0].pass, "frame_ms");
    EXPECT_NEAR(all[0].exponent.exponent, 2, 1e-3);  // six digits in the file
    EXPECT_NEAR(all[1].exponent.exponent, 0, 1e-9);
    EXPECT_THAT(demo::growthTable(all), testing::HasSubstr("N\tyard\tvsm\tframe_ms\t512\t4096"));
}

TEST(GrowthRun, RefusesBadSettingsInOneSentence) {
    demo::GrowthSettings settings = tiny({});
    settings.rounds = 0;
    EXPECT_THROW(settings.validate(), std::invalid_argument);
    settings = tiny({});
    settings.scene = "nope";
    EXPECT_THROW(settings.validate(), std::invalid_argument);
    settings = tiny({});
    settings.scene = "planar_occluder:triangles=100000";
    EXPECT_THROW(settings.validate(), std::invalid_argument);
    settings = tiny({});
    settings.techniques.clear();
    EXPECT_THROW(settings.validate(), std::invalid_argument);
}

}  // namespace

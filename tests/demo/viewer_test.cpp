// SPDX-License-Identifier: MIT
// The viewer without its window: what a state shows, the state file, the keys.
#include "demo/viewer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "demo/viewer_message.h"
#include "demo/viewer_panel.h"
#include "tests/headless_gl.h"
#include "tests/project_folders.h"
#include "tests/temporary_folder.h"
#include "tests/thrown_message.h"

namespace {

using demo::Path;
using demo::ViewerState;
using renderer::View;
using testing::HasSubstr;
using tests::gl;
using tests::messageOf;

ViewerState smallState(View view) {
    ViewerState state;
    state.view = view;
    state.resolution = 64;
    state.compareWith = 1024;
    return state;
}

renderer::ByteImage imageOf(const ViewerState& state) {
    demo::Viewer viewer(gl(), state, 96, 54);
    viewer.settle();
    return viewer.picture(1);
}

// As L in the window does it.
TEST(Viewer, ShadersThatDoNotCompileLeaveThePictureAndTheStateAsTheyWere) {
    demo::Viewer viewer(gl(), smallState(View::difference), 96, 54);
    viewer.settle();
    const renderer::ByteImage before = viewer.picture(1);
    renderer::ShaderLibrary::Files files = renderer::ShaderLibrary::embedded().files();
    files["passes/lit.frag"] += "oops";
    EXPECT_THAT(messageOf([&] { viewer.reload(renderer::ShaderLibrary(files)); }),
                HasSubstr("passes/lit.frag"));
    viewer.step();
    EXPECT_EQ(viewer.picture(1).values, before.values);

    files = renderer::ShaderLibrary::embedded().files();
    files["filters/esm.glsl"] = "oops";
    viewer.reload(renderer::ShaderLibrary(files));
    ViewerState other = viewer.state();
    other.technique = "esm";
    EXPECT_THAT(messageOf([&] { viewer.show(other); }), HasSubstr("filters/esm.glsl:1"));
    EXPECT_EQ(viewer.state().technique, "pcf_disc");
    viewer.step();
    EXPECT_EQ(viewer.picture(1).values, before.values);
}

// What chooses the size is read again with the rest.
TEST(Viewer, ReloadsTheShadersOfTheDemand) {
    ViewerState state = smallState(View::demand);
    state.resolution.reset();
    state.radiusUv = 0.05;
    state.technique = "pcss";
    demo::Viewer viewer(gl(), state, 96, 54);
    viewer.settle();
    EXPECT_GT(viewer.run().chosen().need, 0);
    const renderer::ByteImage before = viewer.picture(1);
    renderer::ShaderLibrary::Files files = renderer::ShaderLibrary::embedded().files();
    files["passes/detail.comp"] += "oops";
    EXPECT_THAT(messageOf([&] { viewer.reload(renderer::ShaderLibrary(files)); }),
                HasSubstr("passes/detail.comp"));
    viewer.settle();
    EXPECT_EQ(viewer.picture(1).values, before.values) << "the last good ones stay";

    files = renderer::ShaderLibrary::embedded().files();
    const std::string begin = "PixelDemand pixelDemand(ivec2 pixel) {";
    std::string& demand = files["shared/pixel_demand.glsl"];
    const auto at = demand.find(begin);
    ASSERT_NE(at, std::string::npos);
    demand.insert(at + begin.size(), "if (pixel.x >= 0) return kAsksForNothing;");
    viewer.reload(renderer::ShaderLibrary(files));
    viewer.settle();
    EXPECT_THAT(viewer.run().chosen().reason, HasSubstr("nothing visible in penumbra"));
    EXPECT_NE(viewer.picture(1).values, before.values) << "no pixel is painted";
}

TEST(Viewer, TakesAnotherSlopeOrKeepsTheLastOne) {
    demo::Viewer viewer(gl(), smallState(View::picture), 32, 18);
    EXPECT_EQ(viewer.slope().slope.c, 3.47);
    const auto file =
        tests::sourceFolder() / "docs/results/software-rasteriser/simulated-slope.json";
    viewer.useSlope(file);
    EXPECT_NEAR(viewer.slope().slope.c, 3.22, 0.005) << "as README states it";
    EXPECT_NEAR(static_cast<double>(viewer.run().demandRule().c), viewer.slope().slope.c, 1e-6);
    EXPECT_THAT(messageOf([&] { viewer.useSlope("/no/such/slope.json"); }),
                HasSubstr("/no/such/slope.json"));
    EXPECT_NEAR(viewer.slope().slope.c, 3.22, 0.005);
    // For another audience the same file is read again.
    ViewerState state = viewer.state();
    state.audience.detection = 0.1;
    viewer.show(state);
    EXPECT_EQ(viewer.slope().file, file.string());
    EXPECT_GT(viewer.slope().slope.c, 4);
    viewer.useSlope(std::nullopt);
    EXPECT_EQ(viewer.slope().file, "");
    EXPECT_FALSE(viewer.state().slopeFile);
}

TEST(Viewer, BeginsWithTheSlopeThatAStateFileNames) {
    const tests::TemporaryFolder folder;
    ViewerState state = smallState(View::picture);
    state.slopeFile =
        tests::sourceFolder() / "docs/results/software-rasteriser/simulated-slope.json";
    demo::writeViewerState(folder.path() / "state.json", state);
    const ViewerState again = demo::readViewerState(folder.path() / "state.json");
    EXPECT_NEAR(demo::Viewer(gl(), again, 32, 18).slope().slope.c, 3.22, 0.005);
    state.slopeFile = "/no/such/slope.json";
    EXPECT_THAT(messageOf([&] { demo::Viewer(gl(), state, 32, 18); }),
                HasSubstr("/no/such/slope.json"));
    // A state that is refused leaves everything as it was.
    demo::Viewer viewer(gl(), again, 32, 18);
    EXPECT_THAT(messageOf([&] { viewer.show(state); }), HasSubstr("/no/such/slope.json"));
    EXPECT_EQ(viewer.state(), again);
    EXPECT_NEAR(viewer.slope().slope.c, 3.22, 0.005);
}

// As the panel's sliders ask for it.
TEST(Viewer, ShowsAModelWithSeveralMaps) {
    const tests::TemporaryFolder folder;
    const std::string file = (folder.path() / "wedge.obj").string();
    std::ofstream(file) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 3 4\nf 2 3 4\n";
    ViewerState state = smallState(View::picture);
    state.scene = file;
    demo::Viewer viewer(gl(), state, 32, 18);
    viewer.step();
    EXPECT_EQ(viewer.run().maps().size(), 1U);
    state.scene = demo::withSceneOption(state.scene, "cascades", 2, 1);
    state.scene = demo::withSceneOption(state.scene, "lamps", 1, 0);
    viewer.show(state);
    viewer.step();
    EXPECT_EQ(viewer.run().maps().size(), 3U);
}

TEST(Viewer, ShowsThePenumbraeOfTheMapThatIsAskedFor) {
    ViewerState state = smallState(View::penumbra);
    state.scene = "lamps";
    const auto pictureOf = [&](int map) {
        state.viewMap = map;
        demo::Viewer viewer(gl(), state, 96, 54);
        viewer.settle();
        return viewer.picture(1).values;
    };
    const auto sun = pictureOf(1), lastLamp = pictureOf(8);
    EXPECT_NE(sun, lastLamp);
    EXPECT_EQ(pictureOf(1000), lastLamp) << "beyond the last map";
}

TEST(Viewer, SplitShowsOneFrameOnEachSideOfTheLine) {
    const renderer::ByteImage left = imageOf(smallState(View::picture));
    ViewerState state = smallState(View::picture);
    state.resolution = state.compareWith;
    const renderer::ByteImage right = imageOf(state);
    state = smallState(View::split);
    state.splitAt = 0.25F;
    const renderer::ByteImage split = imageOf(state);
    int differing = 0;
    for (int y = 0; y < split.height; ++y)
        for (int x = 0; x < split.width; ++x) {
            if (std::abs(x + 0.5 - 24) < 1) continue;  // the line
            for (int channel = 0; channel < 3; ++channel) {
                const auto expected = (x < 24 ? left : right).at(x, y, channel);
                ASSERT_EQ(split.at(x, y, channel), expected) << x << ' ' << y;
                differing += left.at(x, y, channel) != right.at(x, y, channel) ? 1 : 0;
            }
        }
    EXPECT_GT(differing, 100) << "or the test could not fail";
}

bool coloured(const renderer::ByteImage& image, int x, int y) {
    return image.at(x, y, 0) != image.at(x, y, 1) || image.at(x, y, 1) != image.at(x, y, 2);
}

TEST(Viewer, DifferenceIsGreyWhereTheFramesAgree) {
    ViewerState state = smallState(View::difference);
    state.compareWith = 64;
    const renderer::ByteImage same = imageOf(state);
    state.compareWith = 1024;
    const renderer::ByteImage other = imageOf(state);
    int differing = 0;
    for (int y = 0; y < same.height; ++y)
        for (int x = 0; x < same.width; ++x) {
            ASSERT_FALSE(coloured(same, x, y)) << x << ' ' << y;
            differing += coloured(other, x, y) ? 1 : 0;
        }
    EXPECT_GT(differing, 50);
}

// Both views paint what the controller counts, so they paint the same pixels but for the surfaces
// that face away from the light.
TEST(Viewer, PenumbraAndDemandPaintThePenumbra) {
    ViewerState state = smallState(View::penumbra);
    state.radiusUv = 0.05;  // wider than a pixel: beside a narrow penumbra, pixels ask too
    demo::Viewer viewer(gl(), state, 96, 54);
    viewer.settle();
    const renderer::ByteImage painted = viewer.picture(1);
    state.view = View::demand;
    viewer.show(state);
    viewer.step();
    const renderer::ByteImage demand = viewer.picture(1);
    int both = 0;
    for (int y = 0; y < painted.height; ++y)
        for (int x = 0; x < painted.width; ++x) {
            if (coloured(demand, x, y)) {
                EXPECT_TRUE(coloured(painted, x, y)) << x << ' ' << y;
                ++both;
            }
        }
    EXPECT_GT(both, 50);
}

TEST(Viewer, ShowsAnotherStateOrStaysAsItWas) {
    demo::Viewer viewer(gl(), smallState(View::picture), 64, 36);
    viewer.settle();
    ViewerState state = viewer.state();
    state.scene = "planar_occluder";
    state.technique = "hard";
    state.sunElevationDeg = 60;
    viewer.show(state);
    viewer.step();
    EXPECT_EQ(viewer.frame().scene().name, "planar_occluder");
    EXPECT_EQ(viewer.frame().scene().sun.elevationDeg, 60);
    ViewerState bad = state;
    bad.radiusM = 1e6;
    EXPECT_THAT(messageOf([&] { viewer.show(bad); }), HasSubstr("radius is 1000000"));
    EXPECT_EQ(viewer.state(), state);
    bad = state;
    bad.gain = 0;
    EXPECT_THAT(messageOf([&] { viewer.show(bad); }), HasSubstr("gain: 0: must be in [1, 64]"));
    viewer.step();
    EXPECT_EQ(viewer.state(), state);
}

// What a frame refuses is found out while it is drawn; the state before can be drawn again.
TEST(Viewer, DrawsAgainAfterWhatTheDriverRefuses) {
    demo::Viewer viewer(gl(), smallState(View::picture), 64, 36);
    viewer.settle();
    const ViewerState good = viewer.state();
    ViewerState wide = good;
    wide.technique = "vsm";
    wide.resolution = gl().maxResolution;
    wide.radiusM = viewer.softness().radiusM / viewer.softness().radiusUv;
    viewer.show(wide);
    EXPECT_THAT(messageOf([&] { viewer.step(); }), HasSubstr("texels wide, is within the"));
    ViewerState sampled = good;
    sampled.technique = "vsm";
    sampled.parameters["vsm"] = renderer::findTechnique("vsm").standardParameters();
    setParameter(renderer::findTechnique("vsm"), sampled.parameters["vsm"], "map_samples", 16);
    viewer.show(sampled);
    EXPECT_THAT(messageOf([&] { viewer.step(); }), HasSubstr("map_samples is 16"));
    viewer.show(good);
    viewer.step();
    EXPECT_EQ(viewer.state(), good);
    EXPECT_FALSE(viewer.picture(1).values.empty());
}

TEST(ViewerState, IsReadAsItWasWritten) {
    const tests::TemporaryFolder folder;
    const auto file = folder.path() / "state.json";
    ViewerState state;
    demo::writeViewerState(file, state);
    EXPECT_EQ(demo::readViewerState(file), state);
    state = {.scene = "planar_occluder",
             .technique = "hard",
             .resolution = 512,
             .compareWith = 128,
             .radiusM = 0.25,
             .audience = {.detection = 0.1, .people = 0.9},
             .budgetTexels = 5'000'000'000,
             .view = View::difference,
             .viewMap = 3,
             .splitAt = 0.25F,
             .gain = 8,
             .cameraYawDeg = 30.5F,
             .sunElevationDeg = 20,
             .path = Path::sun,
             .pathPlace = 0.5,
             .panel = false,
             .timePasses = true};
    state.parameters["pcf_disc"] = renderer::findTechnique("pcf_disc").standardParameters();
    state.parameters["pcf_disc"][0] = 0.25F;
    demo::writeViewerState(file, state);
    EXPECT_EQ(demo::readViewerState(file), state);
}

TEST(ViewerState, NamesFieldValueAndRuleOfABadFile) {
    const tests::TemporaryFolder folder;
    const auto file = folder.path() / "state.json";
    demo::writeViewerState(file, {});
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    const auto readWith = [&](const std::string& from, const std::string& to) {
        std::string changed = text.str();
        const auto at = changed.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        changed.replace(at, from.size(), to);
        std::ofstream(file) << changed;
        return messageOf([&] { demo::readViewerState(file); });
    };
    EXPECT_THAT(readWith("\"yard\"", "\"yart\""), HasSubstr("yart"));
    EXPECT_THAT(readWith("\"pcf_disc\"", "\"pcf\""), HasSubstr("pcf"));
    EXPECT_THAT(readWith("4096", "0"), HasSubstr("compare_with: 0: must be at least 1"));
    EXPECT_THAT(readWith("\"view_map\": 1", "\"view_map\": 0"),
                HasSubstr("view_map: 0: must be at least 1"));
    EXPECT_THAT(readWith("\"gain\": 4.0", "\"gain\": 400"), HasSubstr("gain: 400"));
    EXPECT_THAT(readWith("\"budget_texels\": null", "\"budget_texels\": 0"),
                HasSubstr("budget_texels: 0: must be in [1, 1e+12]"));
    EXPECT_THAT(readWith("\"budget_texels\": null", "\"budget_texels\": -1"),
                HasSubstr("budget_texels"));
    EXPECT_THAT(readWith("\"parameters\": {}", "\"parameters\": {\"hart\": {}}"),
                HasSubstr("hart"));
    EXPECT_THAT(readWith("\"path_place\": 0.0", "\"path_place\": 1"),
                HasSubstr("path_place: 1: must be in [0, 1)"));
    EXPECT_THAT(readWith("\"detection\": 0.0", "\"detection\": 1"),
                HasSubstr("detection: 1: must be in [0, 1)"));
    EXPECT_THAT(readWith("state 1.0", "state 2.0"), HasSubstr("schema"));
    EXPECT_THAT(readWith("\"panel\"", "\"pannel\""), HasSubstr("panel"));
}

TEST(ViewerState, ChangesOneOptionOfAScene) {
    using demo::sceneOption, demo::withSceneOption;
    EXPECT_EQ(withSceneOption("yard", "cascades", 4, 1), "yard:cascades=4");
    EXPECT_EQ(withSceneOption("yard:cascades=4:lamps=2", "cascades", 3, 1),
              "yard:lamps=2:cascades=3");
    EXPECT_EQ(withSceneOption("yard:cascades=4:lamps=2", "lamps", 0, 0), "yard:cascades=4");
    EXPECT_EQ(withSceneOption("yard", "lamps", 0, 0), "yard");
    EXPECT_EQ(sceneOption("yard:cascades=4:lamps=2", "cascades", 1), 4);
    EXPECT_EQ(sceneOption("yard:cascades=4:lamps=2", "lamps", 0), 2);
    EXPECT_EQ(sceneOption("yard:cascades=", "cascades", 1), 1);
    EXPECT_EQ(sceneOption("lamps", "lamps", 0), 0);
    EXPECT_EQ(withSceneOption("a/b.obj:lamps=2", "cascades", 3, 1), "a/b.obj:lamps=2:cascades=3");
    EXPECT_EQ(sceneOption("a/b.obj:lamps=2", "lamps", 0), 2);
    // A file of that name.
    const tests::TemporaryFolder folder;
    const std::string file = (folder.path() / "b:cascades=2.obj").string();
    std::ofstream(file) << "v";
    EXPECT_EQ(sceneOption(file, "cascades", 1), 1);
    EXPECT_EQ(withSceneOption(file + ":cascades=5", "cascades", 3, 1), file + ":cascades=3");
}

TEST(ViewerMessage, StaysAsLongAsItTakesToReadItOnceItIsDrawn) {
    demo::ViewerMessage message;
    EXPECT_EQ(message.shownAt(0), "");
    message.say("saved as picture.png");
    EXPECT_EQ(message.shownAt(10), "saved as picture.png") << "it took 10 s to save it";
    EXPECT_EQ(message.shownAt(13), "saved as picture.png");
    message.say("saved as picture.png");
    EXPECT_EQ(message.shownAt(23), "saved as picture.png");
    EXPECT_EQ(message.shownAt(27), "saved as picture.png");
    EXPECT_EQ(message.shownAt(29), "");
    message.say(std::string(400, 'x'));
    EXPECT_NE(message.shownAt(40), "");
    EXPECT_NE(message.shownAt(60), "") << "a long one longer";
    EXPECT_EQ(message.shownAt(80), "");
}

TEST(ViewerPanel, StaysInsideTheWindow) {
    EXPECT_EQ(demo::keptInside(16, 400, 1280), 16);
    EXPECT_EQ(demo::keptInside(-300, 400, 1280), 0) << "after a tiny window";
    EXPECT_EQ(demo::keptInside(1100, 400, 1280), 880);
    EXPECT_EQ(demo::keptInside(16, 400, 96), 0) << "its beginning at least";
}

TEST(ViewerKeys, ChangeWhatTheySay) {
    ViewerState state;
    EXPECT_TRUE(demo::applyKey('4', state));
    EXPECT_EQ(state.resolution, 1024);
    EXPECT_TRUE(demo::applyKey('R', state));
    EXPECT_FALSE(state.resolution);
    EXPECT_TRUE(demo::applyKey('R', state));
    EXPECT_TRUE(state.resolution);
    for (std::size_t i = 0; i < renderer::techniques().size(); ++i) demo::applyKey('T', state);
    EXPECT_EQ(state.technique, ViewerState().technique) << "once round";
    for (std::size_t i = 0; i < renderer::kAllViews.size(); ++i) demo::applyKey('V', state);
    EXPECT_EQ(state.view, View::picture);
    demo::applyKey('S', state);
    EXPECT_NE(state.scene, ViewerState().scene);
    demo::applyKey('P', state);
    EXPECT_EQ(state.path, Path::camera);
    demo::applyKey('H', state);
    EXPECT_FALSE(state.panel);
    EXPECT_FALSE(demo::applyKey('Q', state));
}

}  // namespace

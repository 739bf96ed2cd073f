// SPDX-License-Identifier: MIT
// The papers' experiments: each row of the lists can be drawn, and what the papers claim is seen in
// the numbers.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "demo/depth_distribution.h"
#include "demo/paper_drawing.h"
#include "demo/paper_page.h"
#include "demo/paper_tables.h"
#include "renderer/scene.h"
#include "tests/headless_gl.h"
#include "tests/thrown_message.h"

namespace {

using demo::PaperFigure;
using demo::PaperNumber;

bool knownPaper(const std::string& name) {
    for (const demo::PaperTitle& title : demo::paperTitles())
        if (title.name == name) return true;
    return false;
}

TEST(PaperExperiments, NameKnownScenesTechniquesAndParameters) {
    std::set<std::string> names;
    for (const PaperFigure& figure : demo::paperFigures()) {
        EXPECT_TRUE(names.insert(figure.name).second) << figure.name;
        EXPECT_TRUE(knownPaper(figure.paper)) << figure.name;
        EXPECT_NO_THROW(renderer::findScene(figure.scene)) << figure.name;
        EXPECT_FALSE(figure.setting.empty()) << figure.name;
        EXPECT_FALSE(figure.finding.empty()) << figure.name;
        for (const demo::PaperPanel& panel : figure.panels)
            EXPECT_NO_THROW(demo::panelSettings(panel, 1)) << figure.name << ": " << panel.caption;
        if (figure.truth) {
            EXPECT_NO_THROW(demo::panelSettings(*figure.truth, 1)) << figure.name;
        }
    }
    for (const demo::PaperTable& table : demo::paperTables()) {
        EXPECT_TRUE(names.insert(table.name).second) << table.name;
        EXPECT_TRUE(knownPaper(table.paper)) << table.name;
        EXPECT_NO_THROW(renderer::findScene(table.scene)) << table.name;
        EXPECT_FALSE(table.finding.empty()) << table.name;
        for (const demo::PaperTable::Row& row : table.rows) {
            EXPECT_NO_THROW(demo::panelSettings(row.panel, 1)) << table.name << ": " << row.title;
            EXPECT_EQ(row.paperFps.size(), table.columns.size()) << table.name << ": " << row.title;
        }
    }
}

#ifndef __SANITIZE_ADDRESS__  // some fifty renderers; the claims below draw the same way there
TEST(PaperExperiments, EveryFigureDraws) {
    for (PaperFigure figure : demo::paperFigures()) {
        if (!figure.truth)
            figure.truth = figure.panels.front();  // a map of 4096 is not needed for that
        figure.truth->resolution = std::min(figure.truth->resolution, 256);
        for (demo::PaperPanel& panel : figure.panels)
            panel.resolution = std::min(panel.resolution, 256);
        const auto drawn = demo::drawFigure(tests::gl(), figure, 8, 1);
        ASSERT_EQ(drawn.size(), figure.panels.size()) << figure.name;
        for (const demo::DrawnPanel& panel : drawn) {
            EXPECT_FALSE(panel.picture.values.empty()) << figure.name;
            EXPECT_EQ(panel.numbers.size(), figure.numbers.size()) << figure.name;
            for (const double number : panel.numbers)
                EXPECT_TRUE(std::isfinite(number)) << figure.name;
            EXPECT_GT(panel.resolution, 0) << figure.name;
            EXPECT_EQ(panel.frameMs.count, figure.timed ? 1 : 0) << figure.name;
        }
    }
}
#endif

double numberOf(const PaperFigure& figure, const demo::DrawnPanel& panel, PaperNumber number) {
    for (std::size_t i = 0; i < figure.numbers.size(); ++i)
        if (figure.numbers[i] == number) return panel.numbers[i];
    ADD_FAILURE() << figure.name << " has no " << demo::toText(number);
    return NAN;
}

TEST(PaperExperiments, AnisotropyAndMipsReduceTheError) {
    const PaperFigure& grazing = demo::findPaperFigure("variance-1");
    const auto shallow = demo::drawFigure(tests::gl(), grazing, 2);
    EXPECT_LT(numberOf(grazing, shallow[2], PaperNumber::rmse),
              numberOf(grazing, shallow[0], PaperNumber::rmse));
    EXPECT_LT(numberOf(grazing, shallow[2], PaperNumber::rmse),
              numberOf(grazing, shallow[1], PaperNumber::rmse));
    const PaperFigure& far = demo::findPaperFigure("variance-2");
    const auto small = demo::drawFigure(tests::gl(), far, 2);
    EXPECT_LT(numberOf(far, small[1], PaperNumber::rmse),
              numberOf(far, small[0], PaperNumber::rmse));
}

// As the page says it: a fifth of a percent over the whole umbra, nearly all of it in few lines.
TEST(PaperExperiments, VarianceBleedsWherePcfIsDark) {
    const PaperFigure& figure = demo::findPaperFigure("variance-4");
    const auto drawn = demo::drawFigure(tests::gl(), figure);
    EXPECT_GT(numberOf(figure, drawn[0], PaperNumber::umbraLight), 0.001);
    EXPECT_LT(numberOf(figure, drawn[1], PaperNumber::umbraLight), 1e-5);
}

TEST(PaperExperiments, SixteenBitsAreWorseThanThirtyTwoUnlessSplit) {
    const PaperFigure& figure = demo::findPaperFigure("variance-precision");
    const auto drawn = demo::drawFigure(tests::gl(), figure, 2);
    const auto rmse = [&](std::size_t i) { return numberOf(figure, drawn[i], PaperNumber::rmse); };
    EXPECT_GT(rmse(1), 0.02);
    EXPECT_LT(rmse(2), 0.25 * rmse(1));
}

TEST(PaperExperiments, GradientMapsDarkenPlanesWithoutTheOffset) {
    const PaperFigure& figure = demo::findPaperFigure("gradient-3");
    const auto drawn = demo::drawFigure(tests::gl(), figure, 4);
    EXPECT_GT(numberOf(figure, drawn[0], PaperNumber::litLight), 0.98);
    EXPECT_LT(numberOf(figure, drawn[1], PaperNumber::litLight), 0.75);
}

TEST(PaperExperiments, PowerCdfEdgesAreSharperThanPcf) {
    const PaperFigure& figure = demo::findPaperFigure("power-cdf-4");
    const auto drawn = demo::drawFigure(tests::gl(), figure);
    EXPECT_LT(numberOf(figure, drawn[2], PaperNumber::edgeWidth),
              numberOf(figure, drawn[0], PaperNumber::edgeWidth));
}

TEST(PaperExperiments, TwicePenumbraHidesHalfTheMap) {
    const PaperFigure& figure = demo::findPaperFigure("perception-1");
    const auto drawn = demo::drawFigure(tests::gl(), figure, 2);
    const auto ripple = [&](std::size_t i) {
        return numberOf(figure, drawn[i], PaperNumber::edgeRipple);
    };
    EXPECT_GT(ripple(1), 1.5 * ripple(0));  // the reduced map shows under the small kernel,
    EXPECT_NEAR(ripple(3), ripple(0),
                0.5 * ripple(0));  // and as much as the full one did under twice that
}

TEST(PaperExperiments, RefuseAPaperThatIsNotThere) {
    EXPECT_EQ(
        tests::messageOf([] { demo::writePaperPage("unused", "nobody", tests::gl(), {}, 1); }),
        "paper \"nobody\" is not known; known are: variance, power-cdf, gradient, perception");
}

TEST(DepthDistribution, OfAPowerIsThatPower) {
    std::vector<float> depths;
    constexpr int kDepths = 2000;
    for (int i = 0; i < kDepths; ++i)  // quantiles of t^3 on [.2, .6]
        depths.push_back(0.2F + 0.4F * std::cbrt(static_cast<float>(i) / (kDepths - 1)));
    const auto fit = demo::fitPower(depths);
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->beta, 3,
                0.01);  // the mean of 2000 quantiles is that of the power to a few 1e-4
    EXPECT_LT(fit->most, 0.002);
}

TEST(DepthDistribution, OfTwoDepthsIsFarFromAnyPower) {
    const auto fit = demo::fitPower({0.2F, 0.2F, 0.6F, 0.6F});
    ASSERT_TRUE(fit);
    EXPECT_EQ(fit->beta, 1);
    EXPECT_EQ(fit->most, 0.5);
    EXPECT_FALSE(demo::fitPower({0.3F, 0.3F}));
    EXPECT_FALSE(demo::fitPower({}));
}

}  // namespace

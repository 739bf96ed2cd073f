// SPDX-License-Identifier: MIT
#include "study_app/trial_stimulus.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "study_app/session.h"
#include "study_app/simulated_population.h"
#include "tests/study_app/test_designs.h"

namespace {

using records::Response;
using records::Task;
using records::Trial;
using study_app::Design;
using study_app::Session;

Design noisyDesign() {
    Design d;
    d.name = "noisy";
    d.windowPx = 96;
    d.artifactPx = {6};
    d.patterns = {{.pattern = records::Pattern::stair}};
    d.kernels = {"disc", "poisson8", "poisson8-still"};
    d.noiseLevels = {0, 5};
    d.trialsPerCondition = 3;
    d.radius.max = 48;
    return d;
}

TEST(TrialImages, FollowFromTheRowOfTheTableAlone) {
    for (const bool dither : {false, true}) {
        Design d = noisyDesign();
        d.dither = dither;
        Session session(d, 3);
        std::string text = records::trialTableHeader() + "\n";
        std::vector<study_app::TrialImages> shown;
        while (!session.finished()) {
            shown.push_back(study_app::trialImages(session.next(), d));
            text += records::trialTableRow(session.answer({.response = Response::left})) + "\n";
        }
        const auto rows = records::parseTrialTable(text, "t.tsv").trials;
        std::set<int> seeds;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            EXPECT_TRUE(study_app::trialImages(rows[i], d) == shown[i]) << rows[i].condition;
            const bool random = dither || rows[i].kernel != "disc" || rows[i].noiseLevels != 0;
            EXPECT_EQ(rows[i].imageSeed.has_value(), random);
            EXPECT_EQ(rows[i].dither, dither ? std::optional(true) : std::nullopt);
            if (!random) continue;
            EXPECT_TRUE(seeds.insert(*rows[i].imageSeed).second) << "every image has its own";
            Trial other = rows[i];
            *other.imageSeed ^= 1;
            EXPECT_FALSE(study_app::trialImages(other, d) == shown[i]) << rows[i].condition;
            other.imageSeed.reset();
            EXPECT_THROW(study_app::trialImages(other, d), std::invalid_argument);
        }
    }
}

TEST(TrialImages, RefuseWhatNoRowOfOursSays) {
    const Design d = noisyDesign();
    Trial trial = Session(d, 3).next();
    for (const char* kernel : {"star", "poisson", "poisson0"}) {
        trial.kernel = kernel;
        EXPECT_THROW(study_app::trialImages(trial, d), std::invalid_argument) << kernel;
    }
    trial.pattern = records::Pattern::frame;
    trial.frame = "map.png";
    EXPECT_THROW(study_app::trialImages(trial, d), std::invalid_argument);
}

Design clickDesign(const study_app::Silhouette& silhouette) {
    Design d;
    d.name = "click";
    d.task = Task::yesNo;
    d.windowPx = 160;
    d.artifactPx = {12};
    d.patterns = {silhouette};
    d.radius = {.min = 0.25, .max = 80, .step = 0.25};
    d.staircase = quest::forYesNo(quest::kDefaultParameters, study_app::kYesNoGamma);
    d.localise = true;
    d.trialsPerCondition = 16;
    return d;
}

/// Where a riser is on a nearly unfiltered image: the code jumps along the axis along which treads
/// are level. Px from the left and upper edge.
std::vector<cv::Point2d> risersOf(const cv::Mat& codes, bool turned) {
    std::vector<cv::Point2d> found;
    for (int row = 0; row + 1 < codes.rows; ++row)
        for (int c = 0; c + 1 < codes.cols; ++c) {
            const int here = codes.at<std::uint8_t>(row, c);
            const int next =
                turned ? codes.at<std::uint8_t>(row + 1, c) : codes.at<std::uint8_t>(row, c + 1);
            if (std::abs(here - next) < 200) continue;
            found.emplace_back(turned ? c + 0.5 : c + 1, turned ? row + 1 : row + 0.5);
        }
    return found;
}

TEST(Clicks, AreMeasuredFromTheNearestRiserAsTheObserverSeesIt) {
    for (const study_app::Silhouette& silhouette :
         {study_app::Silhouette{.pattern = records::Pattern::step},
          study_app::Silhouette{.pattern = records::Pattern::stair},
          study_app::Silhouette{.pattern = records::Pattern::line, .angleDeg = 12}}) {
        const Design d = clickDesign(silhouette);
        Session session(d, 5);
        for (int i = 0; i < 16; ++i) {
            Trial trial = session.next();
            trial.filterRadiusPx = 0.25;
            trial.type = records::TrialType::artifact;
            const cv::Mat image = study_app::trialImages(trial, d).left;
            const auto risers = risersOf(image, trial.orientationQuarter.value() % 2 == 1);
            ASSERT_FALSE(risers.empty());
            const auto distance = [&](double x, double y) {
                return study_app::clickDistancePx(trial, d.windowPx, x, y).value();
            };
            for (const cv::Point2d& p : risers) ASSERT_LT(distance(p.x, p.y), 0.01);
            // From anywhere: the distance to the nearest of those pixels, half a pixel long each.
            for (int k = 0; k < 50; ++k) {
                const double x = (k * 37) % 160, y = (k * 61) % 160;
                double nearest = 1e9;
                for (const cv::Point2d& p : risers)
                    nearest = std::min(nearest, std::hypot(p.x - x, p.y - y));
                ASSERT_NEAR(distance(x, y), nearest, 1.3);
            }
            session.answer({.response = Response::notSeen});
        }
    }
}

TEST(Clicks, AreTakenWithSeenInADesignThatLocalisesAlone) {
    const Design d = clickDesign({.pattern = records::Pattern::step});
    Session session(d, 5);
    const auto with = [](Response response, double x, double y) {
        return study_app::Answer{.response = response, .clickXPx = x, .clickYPx = y};
    };
    EXPECT_THROW(session.answer(with(Response::notSeen, 80, 80)), std::invalid_argument);
    EXPECT_THROW(session.answer(with(Response::seen, 161, 80)), std::invalid_argument);
    EXPECT_THROW(session.answer(with(Response::seen, 80, -1)), std::invalid_argument);
    EXPECT_THROW(session.answer(with(Response::seen, 80, std::nan(""))), std::invalid_argument);
    study_app::Answer half{.response = Response::seen, .clickXPx = 80};
    EXPECT_THROW(session.answer(half), std::invalid_argument);
    EXPECT_EQ(session.rows(), 0u);
    bool reference = false, artifact = false;
    while (!session.finished()) {
        const Trial row = session.answer(with(Response::seen, 80, 70));
        EXPECT_EQ(row.clickXPx, 80);
        EXPECT_EQ(row.clickYPx, 70);
        const bool shown = row.type == records::TrialType::artifact;
        EXPECT_EQ(row.clickDistancePx.has_value(), shown) << "a straight edge has no riser";
        (shown ? artifact : reference) = true;
    }
    EXPECT_TRUE(reference && artifact);

    Design other = d;
    other.localise = false;
    Session elsewhere(other, 5);
    EXPECT_THROW(elsewhere.answer(with(Response::seen, 80, 80)), std::invalid_argument);
    EXPECT_NO_THROW(elsewhere.answer({.response = Response::seen}));
}

TEST(Clicks, OfARecordedTableAreHeldAgainstTheDesign) {
    Design d = clickDesign({.pattern = records::Pattern::step});
    Session session(d, 5);
    Trial row = session.answer({.response = Response::seen, .clickXPx = 10, .clickYPx = 20});
    EXPECT_FALSE(Session(d, 5).replay(row));
    Trial moved = row;
    moved.clickXPx = 11;
    ASSERT_EQ(moved.type, records::TrialType::artifact);
    EXPECT_EQ(Session(d, 5).replay(moved).value().column, "click_distance_px");
    d.localise = false;
    EXPECT_EQ(Session(d, 5).replay(row).value().column, "click_x_px");
}

TEST(Session, TakesNoAnswerWhereNoneWasGiven) {
    const Design d = tests::variedDesign(Task::twoAfc);
    Session session(d, 5);
    EXPECT_THROW(session.answer({}), std::invalid_argument);
    const Trial row = session.answer({.status = records::TrialStatus::repeated});
    EXPECT_FALSE(row.response);
    EXPECT_FALSE(row.correct);
    EXPECT_FALSE(Session(d, 5).replay(row));
    EXPECT_THAT(records::trialTableRow(row), testing::HasSubstr("\tn/a\t0\t"));
}

}  // namespace

// SPDX-License-Identifier: MIT
#include "study_app/frame_design.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>

#include "study_app/design_file.h"
#include "study_app/frame_images.h"
#include "study_app/session.h"
#include "study_app/simulated_population.h"
#include "study_app/trial_stimulus.h"
#include "tests/study_app/frame_folder.h"
#include "tests/temporary_folder.h"

namespace {

using nlohmann::json;
using records::Task;
using records::Trial;
using study_app::Design;
using testing::AllOf;
using testing::HasSubstr;

class Frames : public testing::Test {
  protected:
    Frames() {
        std::vector<double> ratios;
        for (double ratio = 0.75; ratio < 12.1; ratio *= std::pow(2, 0.25)) ratios.push_back(ratio);
        pairs = tests::writeFrameFolder(folder.path() / "frames", ratios);
    }

    json file(const std::string& task = "2afc") const {
        return {{"schema", {{"name", "stairwell design"}, {"major", 1}, {"minor", 0}}},
                {"name", "frames"},
                {"task", task},
                {"frames", "frames"},
                {"trials_per_condition", 20}};
    }
    Design design(const std::string& task = "2afc") const {
        return study_app::designFromJson(file(task), "d.json", folder.path());
    }
    std::string errorOf(const json& changed) const {
        try {
            study_app::designFromJson(changed, "d.json", folder.path());
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return "no error";
    }
    /// The error after the manifest's list was changed.
    std::string errorWith(const std::function<void(std::vector<records::FramePair>&)>& change) {
        auto changed = pairs;
        change(changed);
        json list = json::parse(records::toJson(changed).dump());
        std::ofstream(folder.path() / "frames" / records::kManifestName)
            << json{{"schema", {{"name", "stairwell frames"}, {"major", 1}, {"minor", 0}}},
                    {"frames", list}};
        return errorOf(file());
    }

    tests::TemporaryFolder folder;
    std::vector<records::FramePair> pairs;
};

std::vector<Trial> wholeSession(const Design& design) {
    study_app::Session session(design, 9);
    const auto observer = study_app::drawParticipant({}, design, 9);
    std::vector<Trial> rows;
    while (!session.finished()) {
        const std::optional<Trial> last = rows.empty() ? std::nullopt : std::optional(rows.back());
        rows.push_back(session.answer(study_app::simulatedAnswer(observer, session, last)));
    }
    return rows;
}

TEST_F(Frames, ShowTheNearestPairAndTeachTheStaircaseWhatWasShown) {
    const std::vector<Trial> rows = wholeSession(design());
    study_app::Session again(design(), 9);
    for (const Trial& row : rows) {
        EXPECT_FALSE(again.replay(row));
        EXPECT_EQ(row.pattern, records::Pattern::frame);
        EXPECT_EQ(row.kernel, "pcf_disc");
        EXPECT_EQ(row.filterRadiusPx, tests::kFrameRadiusPx);
        if (!row.staircase) {
            EXPECT_EQ(row.frame, "map0.png") << "a catch trial shows the coarsest map";
            continue;
        }
        const double proposed = *row.proposedRadiusPx / row.artifactPx;
        const auto distance = [&](const records::FramePair& pair) {
            return std::abs(std::log(pair.radiusPx / pair.artifactPx / proposed));
        };
        const auto& nearest = *std::ranges::min_element(pairs, {}, distance);
        EXPECT_EQ(row.frame, nearest.artifact);
        EXPECT_EQ(row.artifactPx, nearest.artifactPx);
    }
    ASSERT_TRUE(again.finished());
    for (const quest::QuestTrial& trial : again.staircase(0).history()) {
        const auto shown = [&](const records::FramePair& pair) {
            return quest::strength(pair.artifactPx, pair.radiusPx) == trial.x;
        };
        EXPECT_TRUE(std::ranges::any_of(pairs, shown));
    }
}

TEST_F(Frames, ComeFromTheFilesCodeByCode) {
    for (const char* task : {"2afc", "yes_no"}) {
        const Design d = design(task);
        int references = 0;
        for (const Trial& row : wholeSession(d)) {
            const auto pair =
                std::ranges::find(pairs, row.frame.value(), &records::FramePair::artifact);
            const auto codes = [&](const std::string& name) {
                cv::Mat image = study_app::readFrame(*d.frames, name, d.windowPx);
                if (row.mirror.value()) cv::flip(image, image, 1);
                return image;
            };
            const cv::Mat artifact = codes(pair->artifact), converged = codes(pair->converged);
            const study_app::TrialImages images = study_app::trialImages(row, d);
            const auto same = [](const cv::Mat& a, const cv::Mat& b) {
                return a.size() == b.size() && cv::countNonZero(a != b) == 0;
            };
            EXPECT_EQ(row.orientationQuarter, 0);
            if (row.task == Task::twoAfc) {
                const bool left = row.side == "left";
                EXPECT_TRUE(same(left ? images.left : images.right, artifact));
                EXPECT_TRUE(same(left ? images.right : images.left, converged));
            } else {
                const bool reference = row.type == records::TrialType::reference;
                references += reference ? 1 : 0;
                EXPECT_TRUE(same(images.left, reference ? converged : artifact));
                EXPECT_TRUE(images.right.empty());
            }
        }
        EXPECT_EQ(references > 0, std::string(task) == "yes_no");
    }
}

TEST_F(Frames, GoOnFromTheSidecarsListWhereverTheFolderIs) {
    const Design d = design();
    const json stored = study_app::normalisedJson(d);
    EXPECT_EQ(study_app::designFromJson(stored, "sidecar"), d);
    std::filesystem::rename(folder.path() / "frames", folder.path() / "moved");
    EXPECT_EQ(study_app::designFromJson(stored, "sidecar"), d) << "to replay, no picture is needed";
    json moved = file();
    moved["frames"] = "moved";
    const Design there = study_app::designFromJson(moved, "d.json", folder.path());
    EXPECT_NE(there, d);
    EXPECT_EQ(study_app::designDifference(stored, study_app::normalisedJson(there)), "");
}

TEST_F(Frames, ArePinnedByTheirChecksums) {
    const Design d = design();
    const std::filesystem::path file4 = d.frames->folder / "map4.png";
    EXPECT_EQ(d.frames->sha256.size(), pairs.size() + 1);
    EXPECT_NO_THROW(study_app::requireFrames(*d.frames));
    tests::writePicture(file4, tests::kFrameEdgePx, tests::kFrameEdgePx, 1, 99);
    for (const auto& use : std::vector<std::function<void()>>{
             [&] { study_app::requireFrames(*d.frames); },
             [&] { study_app::readFrame(*d.frames, "map4.png", d.windowPx); }}) {
        try {
            use();
            ADD_FAILURE() << "another picture was taken";
        } catch (const std::runtime_error& error) {
            EXPECT_THAT(error.what(), AllOf(HasSubstr(file4.string() + ": is another picture"),
                                            HasSubstr("SHA-256")));
        }
    }
    EXPECT_NO_THROW(study_app::readFrame(*d.frames, "map3.png", d.windowPx));
    EXPECT_THAT(study_app::designDifference(study_app::normalisedJson(d),
                                            study_app::normalisedJson(design())),
                HasSubstr("frames.sha256.map4.png"));
}

TEST_F(Frames, AreRefusedByFilePlaceValueAndRule) {
    const std::filesystem::path frames = folder.path() / "frames";
    const auto with = [&](const char* field, const json& value) {
        json changed = file();
        changed[field] = value;
        return errorOf(changed);
    };
    EXPECT_EQ(errorOf(file()), "no error");
    EXPECT_THAT(with("frames", "none"),
                AllOf(HasSubstr("none/manifest.json"), HasSubstr("cannot be read")));
    EXPECT_THAT(with("artifact_px", {10}),
                HasSubstr("field artifact_px: an array: must not stand beside frames"));
    EXPECT_THAT(with("window_px", 600),
                HasSubstr("field window_px: 600: must be the edge of the frames, 48"));
    EXPECT_THAT(with("encoding", "code"), HasSubstr("field encoding: \"code\": must be srgb"));
    EXPECT_THAT(with("roving", true),
                HasSubstr("field roving.shift: true: must be false with frames"));
    EXPECT_THAT(
        with("quest", {{"guess_ratio", 20}}),
        HasSubstr("field quest.guess_ratio: 20: must lie among the r / a of scene \"yard\""));

    tests::writePicture(frames / "map3.png", 40, 40, 1, 0);
    EXPECT_THAT(errorOf(file()),
                AllOf(HasSubstr("map3.png: 40 px: must be as wide as"), HasSubstr("48 px")));
    tests::writePicture(frames / "map3.png", 48, 40, 1, 0);
    EXPECT_THAT(errorOf(file()), HasSubstr("map3.png: 48 x 40 px: must be square"));
    tests::writePicture(frames / "map3.png", 48, 48, 3, 0);
    EXPECT_THAT(errorOf(file()), HasSubstr("map3.png: 3 channels: must be 8-bit grey"));
    std::ofstream(frames / "map3.png") << "no picture";
    EXPECT_THAT(errorOf(file()), HasSubstr("map3.png: cannot be read as a picture"));
    std::filesystem::remove(frames / "map3.png");
    EXPECT_THAT(errorOf(file()), HasSubstr("map3.png: no such file"));
}

TEST_F(Frames, ListsAreRefusedByFilePlaceValueAndRule) {
    using Pairs = std::vector<records::FramePair>;
    EXPECT_EQ(errorWith([](Pairs&) {}), "no error");
    EXPECT_THAT(errorWith([](Pairs& p) { p.resize(1); }),
                HasSubstr("field frames: scene \"yard\" at radius_px 24 has one artifact size"));
    EXPECT_THAT(errorWith([](Pairs& p) { p.clear(); }),
                AllOf(HasSubstr("manifest.json: field frames"), HasSubstr("at least one pair")));
    EXPECT_THAT(
        errorWith([](Pairs& p) { p[2].artifact = p[1].artifact; }),
        HasSubstr("field frames[2].artifact: \"map1.png\": must stand in the list once, and is in "
                  "frames[1] as well"));
    EXPECT_THAT(errorWith([](Pairs& p) { p[2].artifactPx = p[1].artifactPx; }),
                HasSubstr("field frames[2].artifact_px"));
    EXPECT_THAT(errorWith([](Pairs& p) { p[2].converged = p[2].artifact; }),
                HasSubstr("field frames[2].converged"));
    EXPECT_THAT(errorWith([](Pairs& p) { p[2].artifact = "../map2.png"; }),
                HasSubstr("must be the name of a file in the folder"));
    EXPECT_THAT(errorWith([](Pairs& p) { p[2].radiusPx = -1.5; }),
                HasSubstr("field frames[2].radius_px: -1.5: must be a number greater than 0"));
    EXPECT_THAT(errorWith([](Pairs& p) { p[2].technique = "pcss"; }),
                HasSubstr("field frames[2].technique: \"pcss\": must be that of frames[0]"));
}

}  // namespace

// SPDX-License-Identifier: MIT
#include "resolution_controller/trace.h"

#include <gmock/gmock.h>

#include <bit>
#include <cmath>
#include <random>
#include <span>
#include <vector>

#include "tests/resolution_controller/counting_new.h"

namespace {

namespace rc = resolution_controller;
using testing::HasSubstr;

/// A few lights through everything that can happen to them.
struct Recording {
    explicit Recording(std::size_t bufferSize = 1 << 20, std::uint64_t seed = 1)
        : buffer(bufferSize), writer(buffer), random(seed) {}

    void frames(int count) {
        std::vector<rc::LightData> data(3);
        std::vector<rc::Decision> decisions(3);
        for (int frame = 0; frame < count; ++frame) {
            for (rc::LightData& light : data) {
                histogram.add(float(random() % 5000));
                light = {.kind = rc::LightData::Kind(random() % 5),
                         .radiusUv = random() % 9 ? 0.01 / double(1 + random() % 50) : std::nan(""),
                         .histogram = random() % 9 ? &histogram : nullptr,
                         .frame = {.cameraCut = random() % 40 == 0,
                                   .dataAgeFrames = std::int32_t(random() % 3),
                                   .contrast = double(random() % 12) / 10,
                                   .detailTexels = std::int32_t(random() % 200)}};
                if (random() % 10 == 0) light.frame.budgetSize = std::int32_t(random() % 4000);
            }
            rc::Budget budget;
            if (random() % 3) budget.texels = std::int64_t(random() % 10'000'000);
            lights.update(data, decisions, budget);
            writer.frame(data, budget, decisions);
        }
    }

    rc::LightSet lights{std::vector<rc::Settings>{
        {}, {.slope = {.contrastExponent = 0.2}, .crossFadeFrames = 4}, {.textureSize = 4096}}};
    std::vector<std::byte> buffer;
    rc::TraceWriter writer;
    std::mt19937_64 random;
    rc::DemandHistogram histogram;
};

TEST(Trace, MakesTheSameDecisionsAgain) {
    Recording r;
    ASSERT_TRUE(r.writer.begin(r.lights));
    r.frames(400);
    rc::Settings settings{.maxSize = 1000};
    r.lights.reconfigure(1, settings);
    EXPECT_TRUE(r.writer.reconfigured(1, settings));
    settings.percentile = -1;
    r.lights.reconfigure(2, settings);
    EXPECT_TRUE(r.writer.reconfigured(2, settings));
    r.frames(400);
    EXPECT_EQ(r.writer.lost(), 0u);
    const rc::ReplayReport report = rc::replay(r.writer.bytes());
    EXPECT_EQ(report.problem, "");
    EXPECT_TRUE(report.same);
    EXPECT_EQ(report.frames, 800u);
}

TEST(Trace, StartsAtAnyFrame) {
    Recording r;
    for (int round = 0; round < 20; ++round) {
        r.frames(17);
        ASSERT_TRUE(r.writer.begin(r.lights));
        r.frames(30);
        const rc::ReplayReport report = rc::replay(r.writer.bytes());
        ASSERT_TRUE(report.same) << report.problem;
        ASSERT_EQ(report.frames, 30u);
    }
}

TEST(Trace, AFullBufferKeepsWhatItHas) {
    Recording r(3000);
    ASSERT_TRUE(r.writer.begin(r.lights));
    r.frames(100);
    EXPECT_GT(r.writer.frames(), 0u);
    EXPECT_EQ(r.writer.frames() + r.writer.lost(), 100u);
    EXPECT_FALSE(r.writer.reconfigured(0, {}));
    const rc::ReplayReport report = rc::replay(r.writer.bytes());
    EXPECT_TRUE(report.same) << report.problem;
    EXPECT_EQ(report.frames, r.writer.frames());

    Recording tiny(100);
    EXPECT_FALSE(tiny.writer.begin(tiny.lights));
    tiny.frames(2);
    EXPECT_EQ(tiny.writer.bytes().size(), 0u);
    EXPECT_EQ(tiny.writer.lost(), 2u);
}

TEST(Trace, NamesTheFirstDifference) {
    Recording r;
    ASSERT_TRUE(r.writer.begin(r.lights));
    std::vector<rc::LightData> data(3, {.kind = rc::LightData::Kind::radius, .radiusUv = 0.005});
    std::vector<rc::Decision> decisions(3);
    r.lights.update(data, decisions);
    r.writer.frame(data, {}, decisions);
    r.lights.update(data, decisions);
    decisions[1].size = 512;
    r.writer.frame(data, {}, decisions);
    const rc::ReplayReport report = rc::replay(r.writer.bytes());
    EXPECT_FALSE(report.same);
    EXPECT_EQ(report.differences, 1u);
    EXPECT_EQ(report.firstFrame, 1u);
    EXPECT_EQ(report.firstLight, 1u);
    EXPECT_THAT(report.problem, HasSubstr("frame 1, light 1: recorded 512 (meets the demand"));

    // Also where it is cut short after it.
    r.writer.frame(data, {}, decisions);
    const rc::ReplayReport cut = rc::replay(r.writer.bytes().first(r.writer.bytes().size() - 1));
    EXPECT_FALSE(cut.same);
    EXPECT_EQ(cut.differences, 2u);
    EXPECT_EQ(cut.frames, 2u);
    EXPECT_THAT(cut.problem, HasSubstr(report.problem + "; then trace, byte "));
    EXPECT_THAT(cut.problem, HasSubstr("the trace ends within a record"));
}

TEST(Trace, WritingAllocatesNothing) {
    Recording r;
    std::vector<rc::LightData> data(
        3, {.kind = rc::LightData::Kind::histogram, .histogram = &r.histogram});
    std::vector<rc::Decision> decisions(3);
    const long before = allocationCount();
    const bool began = r.writer.begin(r.lights);
    for (int frame = 0; frame < 100; ++frame) {
        r.histogram.add(100);
        r.writer.frame(data, {.texels = 5}, decisions);
        r.writer.reconfigured(0, {});
    }
    EXPECT_EQ(allocationCount(), before);
    EXPECT_TRUE(began);
    EXPECT_EQ(r.writer.frames(), 100u);
}

constexpr std::size_t kMinorAt = 10;  // in the header, after name and major version

std::vector<std::byte> ofMinor(unsigned char minor, std::span<const std::byte> trace) {
    std::vector<std::byte> bytes(trace.begin(), trace.end());
    bytes.at(kMinorAt) = std::byte{minor};
    return bytes;
}

/// Another value in place of a trace's last number: the least radius of its last decision.
std::vector<std::byte> endingWith(double minRadiusUv, std::span<const std::byte> trace,
                                  unsigned char minor) {
    std::vector<std::byte> bytes = ofMinor(minor, trace);
    const auto bits = std::bit_cast<std::uint64_t>(minRadiusUv);
    for (std::size_t i = 0; i < sizeof bits; ++i)
        bytes[bytes.size() - sizeof bits + i] = static_cast<std::byte>(bits >> (8 * i));
    return bytes;
}

// Before 1.1 a held size was enlarged by the slope that its data came with.
TEST(Trace, ReplaysOlderVersionsByTheRulesOfTheirTime) {
    const rc::Settings oldSlope{.slope = {.c = 3}, .maxSize = 512};
    const rc::Settings newSlope{.slope = {.c = 6}, .maxSize = 512};
    for (const bool beforeTheTrace : {false, true}) {
        for (unsigned char minor = 0; minor < 4; ++minor) {
            rc::LightSet lights(std::vector{oldSlope});
            lights.decideBy(minor == 0 ? rc::Rules::nothingRemembered : rc::Rules(minor));
            std::vector<std::byte> buffer(1 << 16);
            rc::TraceWriter writer(buffer);
            std::vector<rc::LightData> data{
                {.kind = rc::LightData::Kind::radius, .radiusUv = 0.0001}};
            std::vector<rc::Decision> decisions(1);
            writer.begin(lights);
            const auto next = [&] {
                lights.update(data, decisions);
                writer.frame(data, {}, decisions);
            };
            next();
            ASSERT_EQ(decisions[0].minRadiusUv, 3.0 / 512);
            lights.reconfigure(0, newSlope);
            writer.reconfigured(0, newSlope);
            if (beforeTheTrace) writer.begin(lights);
            data[0] = {};
            next();
            ASSERT_EQ(decisions[0].minRadiusUv, 6.0 / 512);
            const auto problem = [&](double least) {
                return rc::replay(endingWith(least, writer.bytes(), minor)).problem;
            };
            EXPECT_EQ(problem((minor == 0 ? 3.0 : 6.0) / 512), "");
            EXPECT_THAT(problem((minor == 0 ? 6.0 : 3.0) / 512),
                        HasSubstr("light 0: recorded 512 (held: no data"));
            EXPECT_THAT(rc::replay(ofMinor(4, writer.bytes())).problem,
                        HasSubstr("trace, byte 16: minor version is 4: must be at most 3"));
        }
    }
}

// Before 1.2 a need fell again as often as it had been taken back, in 1.2 never again, and before
// 1.3 sizes did as needs before 1.2 and fades had other rules.
TEST(Trace, OfASetThatDecidesByOlderRulesIsOfTheirVersionAndReplays) {
    std::vector<std::vector<double>> decided;
    using enum rc::Rules;
    for (const rc::Rules rules : {nothingRemembered, needsRemembered, fallsRemembered}) {
        rc::LightSet lights(std::vector<rc::Settings>(2, {.crossFadeFrames = 6}));
        lights.decideBy(rules);
        std::vector<rc::Decision> decisions(2);
        std::vector<double>& all = decided.emplace_back();
        int frame = 0;
        const auto record = [&](int frames) {
            std::vector<std::byte> buffer(1 << 20);
            rc::TraceWriter writer(buffer);
            writer.begin(lights);
            for (const int end = frame + frames; frame < end; ++frame) {
                const auto needing = [](double texels) {
                    return rc::LightData{.kind = rc::LightData::Kind::radius,
                                         .radiusUv = 3.47 / texels};
                };
                const std::vector<rc::LightData> data{needing(frame % 100 < 50 ? 1000 : 500),
                                                      needing(frame % 60 < 5             ? 1000
                                                              : decisions[1].size < 1456 ? 1400
                                                                                         : 700)};
                const rc::Budget budget{.texels = 3 * 512 * 512 + 1456 * 1456 * (frame / 300 % 2)};
                lights.update(data, decisions, budget);
                writer.frame(data, budget, decisions);
                for (const rc::Decision& d : decisions)
                    all.insert(all.end(), {double(d.size), d.fadeWeight, d.minRadiusUv});
            }
            EXPECT_EQ(int(writer.bytes()[kMinorAt]), int(rules));
            const rc::ReplayReport report = rc::replay(writer.bytes());
            EXPECT_EQ(report.problem, "");
            EXPECT_EQ(report.frames, std::uint64_t(frames));
        };
        for (int begun = 0; begun < 60; ++begun) record(17);  // from any state
    }
    EXPECT_NE(decided[0], decided[1]);
    EXPECT_NE(decided[1], decided[2]);
}

TEST(Trace, RefusesWhatIsNone) {
    Recording r;
    ASSERT_TRUE(r.writer.begin(r.lights));
    r.frames(3);
    const std::vector<std::byte> good(r.writer.bytes().begin(), r.writer.bytes().end());
    auto spoilt = good;
    spoilt[0] = std::byte{'x'};
    EXPECT_THAT(rc::replay(spoilt).problem, HasSubstr("must begin with STWTRACE"));
    spoilt = good;
    spoilt[8] = std::byte{2};
    EXPECT_THAT(rc::replay(spoilt).problem, HasSubstr("major version is 2: must be 1"));
    spoilt = good;
    spoilt[15] = std::byte{0x7f};
    EXPECT_THAT(rc::replay(spoilt).problem, HasSubstr("number of lights is"));
    EXPECT_FALSE(rc::replay({}).same);
    EXPECT_THAT(rc::replay({}).problem, HasSubstr("trace, byte 0"));
    spoilt = good;
    spoilt.push_back(std::byte{9});
    EXPECT_THAT(rc::replay(spoilt).problem, HasSubstr("unknown kind of record, 9"));
}

TEST(Trace, CutShortOrDamagedItIsRefusedOrReplaysToAVerdict) {
    Recording r(1 << 20, 5);
    ASSERT_TRUE(r.writer.begin(r.lights));
    r.frames(4);
    const std::vector<std::byte> good(r.writer.bytes().begin(), r.writer.bytes().end());
    int whole = 0;
    for (std::size_t length = 0; length < good.size(); ++length) {
        const auto report = rc::replay(std::span(good).first(length));
        if (report.same) ++whole;
        EXPECT_EQ(report.same, report.problem.empty());
    }
    EXPECT_EQ(whole, 4) << "at the ends of records alone: after 0, 1, 2 and 3 frames";
    for (int i = 0; i < 20000; ++i) {
        auto damaged = good;
        for (int n = 0; n < 3; ++n) damaged[r.random() % damaged.size()] = std::byte(r.random());
        rc::replay(damaged);
    }
}

}  // namespace

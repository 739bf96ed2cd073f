// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "resolution_controller/light_set.h"
#include "resolution_controller/stairwell.h"
#include "tests/resolution_controller/counting_new.h"

extern "C" int32_t sizeChosenFromC(double radius_uv);

namespace {

namespace rc = resolution_controller;
using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

stairwell_settings defaults() {
    stairwell_settings s;
    EXPECT_EQ(stairwell_settings_init(&s, sizeof s), STAIRWELL_OK);
    return s;
}

stairwell_light withRadius(double radius) {
    stairwell_light light;
    EXPECT_EQ(stairwell_light_init(&light, sizeof light), STAIRWELL_OK);
    light.kind = STAIRWELL_RADIUS;
    light.radius_uv = radius;
    return light;
}

struct Lights {
    explicit Lights(std::size_t count, const stairwell_settings& settings = defaults()) {
        const std::vector<stairwell_settings> all(count, settings);
        EXPECT_EQ(stairwell_create(all.data(), count, &handle, nullptr, 0), STAIRWELL_OK);
    }
    ~Lights() { stairwell_destroy(handle); }
    stairwell_lights* handle = nullptr;
};

TEST(CInterface, IsC) {
    EXPECT_EQ(sizeChosenFromC(0.01), 368);
    EXPECT_EQ(stairwell_abi(), std::uint32_t{STAIRWELL_ABI});
}

TEST(CInterface, DecidesAsTheLightSetDoes) {
    std::mt19937_64 rng(1);
    Lights c(3);
    rc::LightSet cpp(std::vector<rc::Settings>(3));
    std::vector<rc::Decision> expected(3);
    for (int frame = 0; frame < 1000; ++frame) {
        stairwell_histogram histogram{};
        rc::DemandHistogram same;
        for (int i = 0; i < 20; ++i) {
            const auto n = std::bit_cast<float>(std::uint32_t(rng()));
            EXPECT_EQ(stairwell_histogram_add(&histogram, n, 1), STAIRWELL_OK);
            same.add(n);
        }
        const double radius = 0.001 * double(1 + rng() % 50);
        std::vector<stairwell_light> data(3, withRadius(radius));
        data[1].kind = STAIRWELL_HISTOGRAM;
        data[1].histogram = &histogram;
        data[2].camera_cut = frame % 50 == 0;
        data[2].budget_size = 700;
        const auto budget = std::int64_t(rng() % 5'000'000);
        const std::vector<rc::LightData> cppData{
            {.kind = rc::LightData::Kind::radius, .radiusUv = radius},
            {.kind = rc::LightData::Kind::histogram, .histogram = &same},
            {.kind = rc::LightData::Kind::radius,
             .radiusUv = radius,
             .frame = {.budgetSize = 700, .cameraCut = frame % 50 == 0}}};
        std::vector<stairwell_decision> decisions(3);
        stairwell_summary summary;
        ASSERT_EQ(stairwell_update(c.handle, data.data(), 3, &budget, decisions.data(),
                                   sizeof decisions[0], &summary),
                  STAIRWELL_OK);
        const auto e = cpp.update(cppData, expected, {.texels = budget});
        EXPECT_EQ(summary.used, e.budget.used);
        EXPECT_EQ(summary.worst_artifact_ratio, e.worstArtifactRatio);
        for (std::size_t i = 0; i < 3; ++i) {
            ASSERT_EQ(decisions[i].size, expected[i].size);
            ASSERT_EQ(decisions[i].reason, int(expected[i].reason));
            ASSERT_EQ(decisions[i].min_radius_uv, expected[i].minRadiusUv);
            ASSERT_EQ(decisions[i].cleared, expected[i].map.cleared);
        }
    }
}

rc::DemandHistogram inCpp(const stairwell_histogram& histogram) {
    return std::bit_cast<rc::DemandHistogram>(histogram);
}

TEST(CInterface, AddsRecentFramesUpAsTheClassDoes) {
    std::mt19937_64 rng(2);
    for (int frames = 1; frames <= STAIRWELL_MOST_RECENT; ++frames) {
        stairwell_recent c;
        ASSERT_EQ(stairwell_recent_init(&c, sizeof c, frames), STAIRWELL_OK);
        rc::RecentDemand cpp(frames);
        EXPECT_EQ(inCpp(c.sum), cpp.sum());
        for (int i = 0; i < 200; ++i) {
            if (rng() % 100 == 0) {
                EXPECT_EQ(stairwell_recent_clear(&c), STAIRWELL_OK);
                cpp.clear();
            }
            stairwell_histogram newest{};
            for (int point = 0; point < 5; ++point) {
                const auto n = std::bit_cast<float>(std::uint32_t(rng()));
                stairwell_histogram_add(&newest, n, std::uint32_t(rng()));  // counters wrap, too
            }
            EXPECT_EQ(stairwell_recent_add(&c, &newest), STAIRWELL_OK);
            ASSERT_EQ(inCpp(c.sum), cpp.add(inCpp(newest))) << frames << ' ' << i;
        }
    }
}

TEST(CInterface, AddsASumToItself) {
    for (int frames = 1; frames <= 3; ++frames) {
        stairwell_recent recent;
        ASSERT_EQ(stairwell_recent_init(&recent, sizeof recent, frames), STAIRWELL_OK);
        rc::RecentDemand expected(frames);
        stairwell_histogram one{};
        one.counts[7] = 1;
        one.rejected = 2;
        for (int i = 0; i < 5; ++i) {
            stairwell_recent_add(&recent, &one);
            expected.add(inCpp(one));
            const stairwell_histogram sum = recent.sum;
            EXPECT_EQ(stairwell_recent_add(&recent, &recent.sum), STAIRWELL_OK);
            EXPECT_EQ(inCpp(recent.sum), expected.add(inCpp(sum))) << frames << ' ' << i;
            const stairwell_histogram oldest = recent.last[recent.next];
            EXPECT_EQ(stairwell_recent_add(&recent, &recent.last[recent.next]), STAIRWELL_OK);
            EXPECT_EQ(inCpp(recent.sum), expected.add(inCpp(oldest))) << frames << ' ' << i;
        }
    }
}

TEST(CInterface, RefusesANumberOfRecentFramesThatItCannotKeep) {
    stairwell_recent recent;
    std::memset(&recent, 0x5a, sizeof recent);
    for (const int frames :
         {0, -1, 65, std::numeric_limits<int>::min(), std::numeric_limits<int>::max()}) {
        EXPECT_EQ(stairwell_recent_init(&recent, sizeof recent, frames), STAIRWELL_BAD_VALUE);
    }
    EXPECT_EQ(stairwell_recent_init(&recent, sizeof recent - 4, 16), STAIRWELL_BAD_STRUCT_SIZE);
    EXPECT_EQ(recent.frames, 0x5a5a5a5a) << "outputs are untouched on failure";
}

// Where the struct is not what init made, nothing is written, in it or beside it.
TEST(CInterface, LeavesRecentFramesThatWereNotInitialisedAlone) {
    constexpr int kLeast = std::numeric_limits<int>::min(), kMost = std::numeric_limits<int>::max();
    struct Spoilt {
        std::uint32_t structSize;
        int frames, next;
        stairwell_status status;
    };
    constexpr std::uint32_t kSize = sizeof(stairwell_recent);
    std::mt19937_64 rng(3);
    const stairwell_histogram newest{.counts = {1, 2, 3}, .rejected = 4};
    struct Guarded {
        unsigned char before[4096];
        stairwell_recent recent;
        unsigned char after[4096];
    };
    std::vector<Guarded> bytes(2);
    Guarded &used = bytes[0], &kept = bytes[1];
    const auto same = [&] { return std::memcmp(&used, &kept, sizeof used) == 0; };
    for (const Spoilt& s : {Spoilt{0, 16, 0, STAIRWELL_BAD_STRUCT_SIZE},
                            {kSize - 4, 16, 0, STAIRWELL_BAD_STRUCT_SIZE},
                            {kSize, 0, 0, STAIRWELL_BAD_VALUE},
                            {kSize, -1, 0, STAIRWELL_BAD_VALUE},
                            {kSize, kLeast, kLeast, STAIRWELL_BAD_VALUE},
                            {kSize, 65, 64, STAIRWELL_BAD_VALUE},
                            {kSize, kMost, 70, STAIRWELL_BAD_VALUE},
                            {kSize, 16, 16, STAIRWELL_BAD_VALUE},
                            {kSize, 16, kMost, STAIRWELL_BAD_VALUE},
                            {kSize, 16, -1, STAIRWELL_BAD_VALUE},
                            {kSize, 64, kLeast, STAIRWELL_BAD_VALUE}}) {
        auto* const all = reinterpret_cast<unsigned char*>(&used);
        std::generate_n(all, sizeof used, [&] { return static_cast<unsigned char>(rng()); });
        used.recent.struct_size = s.structSize;
        used.recent.frames = s.frames;
        used.recent.next = s.next;
        std::memcpy(&kept, &used, sizeof used);
        EXPECT_EQ(stairwell_recent_add(&used.recent, &newest), s.status);
        EXPECT_TRUE(same()) << s.frames << ' ' << s.next;
        EXPECT_EQ(stairwell_recent_clear(&used.recent), s.status);
        EXPECT_TRUE(same()) << s.frames << ' ' << s.next;
    }
}

TEST(CInterface, RefusesNullEverywhere) {
    stairwell_lights* none = nullptr;
    Lights lights(1);
    const stairwell_light light = withRadius(0.01);
    stairwell_decision d;
    stairwell_slope slope;
    const stairwell_histogram histogram{};
    stairwell_recent recent;
    stairwell_recent_init(&recent, sizeof recent, 16);
    const stairwell_settings settings = defaults();
    for (const stairwell_status status :
         {stairwell_slope_init(nullptr, sizeof(stairwell_slope)),
          stairwell_settings_init(nullptr, sizeof(stairwell_settings)),
          stairwell_light_init(nullptr, sizeof(stairwell_light)),
          stairwell_slope_for(nullptr, 0, 0.5, 0, 0, &slope, nullptr),
          stairwell_slope_for(&settings.slope, 0, 0.5, 0, 0, nullptr, nullptr),
          stairwell_histogram_add(nullptr, 1, 1),
          stairwell_recent_init(nullptr, sizeof(stairwell_recent), 16),
          stairwell_recent_add(nullptr, &histogram),
          stairwell_recent_add(&recent, nullptr),
          stairwell_recent_clear(nullptr),
          stairwell_create(nullptr, 1, &none, nullptr, 0),
          stairwell_create(&settings, 1, nullptr, nullptr, 0),
          stairwell_update(nullptr, &light, 1, nullptr, &d, sizeof d, nullptr),
          stairwell_update(lights.handle, nullptr, 1, nullptr, &d, sizeof d, nullptr),
          stairwell_update(lights.handle, &light, 1, nullptr, nullptr, sizeof d, nullptr),
          stairwell_reconfigure(nullptr, 0, &settings, nullptr, 0),
          stairwell_reconfigure(lights.handle, 0, nullptr, nullptr, 0),
          stairwell_trace_start(nullptr, &d, sizeof d),
          stairwell_trace_start(lights.handle, nullptr, 10),
          stairwell_trace_stop(nullptr, nullptr, nullptr),
          stairwell_trace_replay(nullptr, 0, nullptr, nullptr, 0)}) {
        EXPECT_EQ(status, STAIRWELL_NULL_ARGUMENT);
    }
    stairwell_destroy(nullptr);
    EXPECT_EQ(stairwell_demand(nullptr, 0.01f, 0, 1, 0), 0);
}

TEST(CInterface, NoticesStructsOfAnotherSize) {
    stairwell_settings settings = defaults();
    EXPECT_EQ(stairwell_settings_init(&settings, sizeof settings - 8), STAIRWELL_BAD_STRUCT_SIZE);
    settings.struct_size = 0;
    stairwell_lights* none = nullptr;
    EXPECT_EQ(stairwell_create(&settings, 1, &none, nullptr, 0), STAIRWELL_BAD_STRUCT_SIZE);
    EXPECT_EQ(none, nullptr);
    EXPECT_EQ(stairwell_demand(&settings, 0.01f, 0, 1, 0), 0);
    settings = defaults();
    settings.slope.struct_size = 4;
    EXPECT_EQ(stairwell_create(&settings, 1, &none, nullptr, 0), STAIRWELL_BAD_STRUCT_SIZE);
    Lights lights(1);
    stairwell_light light = withRadius(0.01);
    stairwell_decision d;
    EXPECT_EQ(stairwell_update(lights.handle, &light, 1, nullptr, &d, sizeof d - 8, nullptr),
              STAIRWELL_BAD_STRUCT_SIZE);
    light.struct_size = 0;
    EXPECT_EQ(stairwell_update(lights.handle, &light, 1, nullptr, &d, sizeof d, nullptr),
              STAIRWELL_BAD_STRUCT_SIZE);
}

TEST(CInterface, ChecksCountsIndicesAndKinds) {
    Lights lights(2), none(0);
    std::vector<stairwell_light> data(3, withRadius(0.01));
    std::vector<stairwell_decision> d(3);
    for (const std::size_t count : {0, 1, 3}) {
        EXPECT_EQ(stairwell_update(lights.handle, data.data(), count, nullptr, d.data(),
                                   sizeof d[0], nullptr),
                  STAIRWELL_BAD_COUNT);
    }
    EXPECT_EQ(stairwell_update(none.handle, nullptr, 0, nullptr, nullptr, sizeof d[0], nullptr),
              STAIRWELL_OK);
    const stairwell_settings settings = defaults();
    EXPECT_EQ(stairwell_reconfigure(lights.handle, 2, &settings, nullptr, 0), STAIRWELL_BAD_INDEX);
    stairwell_lights* many = nullptr;
    EXPECT_EQ(stairwell_create(&settings, 4097, &many, nullptr, 0), STAIRWELL_BAD_COUNT);
    for (const int kind : {-1, 4, 1 << 20}) {
        data[1].kind = kind;
        EXPECT_EQ(stairwell_update(lights.handle, data.data(), 2, nullptr, d.data(), sizeof d[0],
                                   nullptr),
                  STAIRWELL_BAD_VALUE);
    }
}

TEST(CInterface, SaysWhatIsWrongWithSettingsAndCutsTheMessageToFit) {
    stairwell_settings settings = defaults();
    settings.min_size = 4096;
    settings.max_size = 512;
    stairwell_lights* none = nullptr;
    char message[200] = "", tiny[5] = "xxxx";
    EXPECT_EQ(stairwell_create(&settings, 1, &none, message, sizeof message), STAIRWELL_BAD_VALUE);
    EXPECT_THAT(message, HasSubstr("light 0: resolution controller: minSize is 4096"));
    EXPECT_EQ(stairwell_create(&settings, 1, &none, tiny, sizeof tiny), STAIRWELL_BAD_VALUE);
    EXPECT_STREQ(tiny, "ligh");
    EXPECT_EQ(stairwell_create(&settings, 1, &none, tiny, 0), STAIRWELL_BAD_VALUE);

    const auto said = [&](stairwell_status status) {
        EXPECT_STREQ(message, stairwell_status_text(status));
        std::fill(std::begin(message), std::end(message), 'x');
        return status;
    };
    const auto create = [&](const stairwell_settings* s, std::size_t count, stairwell_lights** to) {
        return said(stairwell_create(s, count, to, message, sizeof message));
    };
    std::fill(std::begin(message), std::end(message), 'x');
    EXPECT_EQ(create(&settings, 1, nullptr), STAIRWELL_NULL_ARGUMENT);
    EXPECT_EQ(create(nullptr, 1, &none), STAIRWELL_NULL_ARGUMENT);
    EXPECT_EQ(create(&settings, 5000, &none), STAIRWELL_BAD_COUNT);
    stairwell_settings unfilled{};
    EXPECT_EQ(create(&unfilled, 1, &none), STAIRWELL_BAD_STRUCT_SIZE);
    EXPECT_EQ(said(stairwell_reconfigure(nullptr, 0, &settings, message, sizeof message)),
              STAIRWELL_NULL_ARGUMENT);
    EXPECT_EQ(said(stairwell_trace_replay(nullptr, 0, nullptr, message, sizeof message)),
              STAIRWELL_NULL_ARGUMENT);
    stairwell_lights* empty = nullptr;
    ASSERT_EQ(stairwell_create(nullptr, 0, &empty, message, sizeof message), STAIRWELL_OK);
    EXPECT_STREQ(message, "");
    EXPECT_EQ(said(stairwell_reconfigure(empty, 0, &settings, message, sizeof message)),
              STAIRWELL_BAD_INDEX);
    stairwell_destroy(empty);

    Lights lights(1);
    EXPECT_EQ(stairwell_reconfigure(lights.handle, 0, &settings, message, sizeof message),
              STAIRWELL_BAD_VALUE);
    const stairwell_light light = withRadius(0.01);
    stairwell_decision d;
    stairwell_update(lights.handle, &light, 1, nullptr, &d, sizeof d, nullptr);
    EXPECT_EQ(d.reason, STAIRWELL_HELD_BAD_SETTINGS);
    settings = defaults();
    for (auto spoil : {+[](stairwell_settings& s) { s.slope.kernel = 5; },
                       +[](stairwell_settings& s) { s.slope.encoding = -1; },
                       +[](stairwell_settings& s) { s.slope.task = 256; },
                       +[](stairwell_settings& s) { s.slope.c = kNan; },
                       +[](stairwell_settings& s) { s.slope.major = 2; }}) {
        settings = defaults();
        spoil(settings);
        EXPECT_EQ(stairwell_reconfigure(lights.handle, 0, &settings, message, sizeof message),
                  STAIRWELL_BAD_VALUE);
        stairwell_update(lights.handle, &light, 1, nullptr, &d, sizeof d, nullptr);
        EXPECT_EQ(d.reason, STAIRWELL_HELD_BAD_SLOPE) << message;
    }
    settings = defaults();
    settings.level_ratio = 256;
    EXPECT_EQ(stairwell_create(&settings, 1, &none, nullptr, 0), STAIRWELL_BAD_VALUE);
}

TEST(CInterface, RefusesReservedFieldsThatAreNot0) {
    stairwell_settings settings = defaults(), slopes = defaults();
    settings.reserved = 77;
    slopes.slope.reserved = -9;
    std::vector<stairwell_settings> second{defaults(), settings};
    char message[200] = "";
    stairwell_lights* none = nullptr;
    EXPECT_EQ(stairwell_create(second.data(), 2, &none, message, sizeof message),
              STAIRWELL_BAD_VALUE);
    EXPECT_STREQ(message, "light 1: reserved is 77: must be 0");
    EXPECT_EQ(stairwell_create(&slopes, 1, &none, message, sizeof message), STAIRWELL_BAD_VALUE);
    EXPECT_STREQ(message, "light 0: slope.reserved is -9: must be 0");
    EXPECT_EQ(none, nullptr);
    Lights lights(1);
    EXPECT_EQ(stairwell_reconfigure(lights.handle, 0, &settings, message, sizeof message),
              STAIRWELL_BAD_VALUE);
    EXPECT_STREQ(message, "reserved is 77: must be 0");
    const stairwell_light light = withRadius(0.01);
    stairwell_decision d;
    stairwell_update(lights.handle, &light, 1, nullptr, &d, sizeof d, nullptr);
    EXPECT_EQ(d.reason, STAIRWELL_DEMAND_MET) << "nothing was changed";
    EXPECT_EQ(stairwell_demand(&settings, 0.01f, 0, 1, 0), 0);
    EXPECT_EQ(stairwell_demand(&slopes, 0.01f, 0, 1, 0), 0);
    stairwell_slope asked;
    EXPECT_EQ(stairwell_slope_for(&slopes.slope, 0, 0.5, 0, 0, &asked, nullptr),
              STAIRWELL_BAD_VALUE);
    stairwell_recent recent;
    stairwell_recent_init(&recent, sizeof recent, 16);
    recent.reserved = 1;
    const stairwell_histogram histogram{};
    EXPECT_EQ(stairwell_recent_add(&recent, &histogram), STAIRWELL_BAD_VALUE);
    EXPECT_EQ(stairwell_recent_clear(&recent), STAIRWELL_BAD_VALUE);
}

TEST(CInterface, TurnsAUsersWordsIntoASlope) {
    stairwell_slope slope;
    ASSERT_EQ(stairwell_slope_init(&slope, sizeof slope), STAIRWELL_OK);
    EXPECT_EQ(slope.c, 3.47);
    slope.c90 = 4.5;
    std::uint32_t warnings = 99;
    ASSERT_EQ(
        stairwell_slope_for(&slope, 0.1, 0.9, STAIRWELL_SRGB, STAIRWELL_DISC, &slope, &warnings),
        STAIRWELL_OK);
    EXPECT_NEAR(slope.c, 4.5 * 1.92, 0.03);
    EXPECT_EQ(warnings, std::uint32_t{STAIRWELL_ENCODING_DIFFERS});
    EXPECT_THAT(stairwell_warning_text(warnings), HasSubstr("encoding"));
    const stairwell_slope before = slope;
    for (const double bad : {kNan, -1.0, 1.0}) {
        EXPECT_EQ(stairwell_slope_for(&slope, bad, 0.5, 0, 0, &slope, nullptr),
                  STAIRWELL_BAD_VALUE);
        EXPECT_EQ(stairwell_slope_for(&slope, 0, bad, 0, 0, &slope, nullptr), STAIRWELL_BAD_VALUE);
    }
    EXPECT_EQ(stairwell_slope_for(&slope, 0, 0.5, 3, 0, &slope, nullptr), STAIRWELL_BAD_VALUE);
    EXPECT_EQ(stairwell_slope_for(&slope, 0, 0.5, 0, 5, &slope, nullptr), STAIRWELL_BAD_VALUE);
    EXPECT_EQ(slope.c, before.c) << "outputs are untouched on failure";
}

TEST(CInterface, RecordsAndReplays) {
    Lights lights(2);
    std::vector<std::byte> buffer(1 << 16);
    char message[200] = "";
    EXPECT_EQ(stairwell_trace_start(lights.handle, buffer.data(), 50), STAIRWELL_BUFFER_TOO_SMALL);
    ASSERT_EQ(stairwell_trace_start(lights.handle, buffer.data(), buffer.size()), STAIRWELL_OK);
    std::vector<stairwell_decision> d(2);
    for (int frame = 0; frame < 100; ++frame) {
        const std::vector<stairwell_light> data(2, withRadius(frame % 7 ? 0.001 * frame : kNan));
        const std::int64_t budget = 100'000 * frame;
        stairwell_update(lights.handle, data.data(), 2, &budget, d.data(), sizeof d[0], nullptr);
        if (frame != 50) continue;
        stairwell_settings settings = defaults();
        settings.max_size = 700;
        EXPECT_EQ(stairwell_reconfigure(lights.handle, 1, &settings, nullptr, 0), STAIRWELL_OK);
    }
    std::size_t bytes = 0;
    std::uint64_t lost = 99, frames = 0;
    EXPECT_EQ(stairwell_trace_stop(lights.handle, &bytes, &lost), STAIRWELL_OK);
    EXPECT_EQ(lost, 0u);
    EXPECT_EQ(stairwell_trace_replay(buffer.data(), bytes, &frames, message, sizeof message),
              STAIRWELL_OK)
        << message;
    EXPECT_EQ(frames, 100u);
    EXPECT_EQ(stairwell_trace_replay(buffer.data(), bytes - 1, &frames, message, sizeof message),
              STAIRWELL_BAD_TRACE);
    EXPECT_THAT(message, HasSubstr("ends within a record"));
    EXPECT_EQ(frames, 99u) << "that could be read";
    buffer[bytes - 20] ^= std::byte{1};
    EXPECT_EQ(stairwell_trace_replay(buffer.data(), bytes, &frames, message, sizeof message),
              STAIRWELL_TRACE_DIFFERS);
    EXPECT_THAT(message, HasSubstr("frame 99, light 1"));
    EXPECT_EQ(frames, 100u);
    char both[600];
    buffer[bytes] = std::byte{9};
    EXPECT_EQ(stairwell_trace_replay(buffer.data(), bytes + 1, &frames, both, sizeof both),
              STAIRWELL_TRACE_DIFFERS);
    EXPECT_THAT(both, HasSubstr("frame 99, light 1"));
    EXPECT_THAT(both, HasSubstr("; then trace, byte "));
    EXPECT_THAT(both, HasSubstr("unknown kind of record, 9"));
    EXPECT_EQ(stairwell_trace_replay(nullptr, 0, &frames, both, sizeof both),
              STAIRWELL_NULL_ARGUMENT);
    EXPECT_EQ(frames, 100u) << "untouched";
    EXPECT_EQ(stairwell_trace_stop(lights.handle, &bytes, &lost), STAIRWELL_OK);
    EXPECT_EQ(bytes, 0u);
}

TEST(CInterface, AllocatesNothingInAFrame) {
    Lights lights(8);
    std::vector<std::byte> buffer(1 << 20);
    stairwell_trace_start(lights.handle, buffer.data(), buffer.size());
    std::vector<stairwell_light> data(8, withRadius(0.002));
    std::vector<stairwell_decision> d(8);
    const std::int64_t budget = 1'000'000;
    stairwell_histogram histogram{};
    stairwell_recent recent;
    data[0].kind = STAIRWELL_HISTOGRAM;
    data[0].histogram = &recent.sum;
    const stairwell_settings settings = defaults();
    const long before = allocationCount();
    stairwell_recent_init(&recent, sizeof recent, 16);
    for (int frame = 0; frame < 100; ++frame) {
        stairwell_histogram_add(&histogram, stairwell_demand(&settings, 0.01f, 0.001f, 1, 0),
                                stairwell_demand_weight(0.01f, 0.001f));
        if (frame == 50) stairwell_recent_clear(&recent);
        stairwell_recent_add(&recent, &histogram);
        stairwell_update(lights.handle, data.data(), 8, &budget, d.data(), sizeof d[0], nullptr);
    }
    EXPECT_EQ(allocationCount(), before);
}

TEST(CInterface, EveryStatusAndReasonHasItsOwnWords) {
    std::set<std::string> words;
    for (int s = STAIRWELL_OK; s <= STAIRWELL_TRACE_DIFFERS; ++s) {
        words.insert(stairwell_status_text(s));
    }
    for (int r = 0; r <= STAIRWELL_SWITCHED_OFF; ++r) words.insert(stairwell_reason_text(r));
    EXPECT_EQ(words.size(), std::size_t(STAIRWELL_TRACE_DIFFERS + 1 + STAIRWELL_SWITCHED_OFF + 1));
    EXPECT_EQ(words.count("unknown"), 0u);
    for (const int other : {-1, 99, 300, 1 << 30}) {
        EXPECT_STREQ(stairwell_status_text(other), "unknown");
        EXPECT_STREQ(stairwell_reason_text(other), "unknown");
    }
}

}  // namespace

// SPDX-License-Identifier: MIT
// The C interface under any calls with any values: no crash, no size outside the levels, no budget
// exceeded, no output that is not finite, what was recorded replays to the same decisions, recent
// frames add up as the class of C++ adds them, and a slope for an audience can be used.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <random>
#include <span>
#include <vector>

#include "resolution_controller/demand.h"
#include "resolution_controller/levels.h"
#include "resolution_controller/stairwell.h"
#include "tests/fuzz/fuzz_target.h"

namespace {

class Bytes {
  public:
    explicit Bytes(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

    /// Zeros after the end.
    template <typename T>
    T take() {
        T value{};
        const std::size_t size = std::min(sizeof(T), bytes_.size());
        if (size > 0) std::memcpy(&value, bytes_.data(), size);
        bytes_ = bytes_.subspan(size);
        return value;
    }
    int below(int end) { return take<std::uint8_t>() % end; }
    bool empty() const { return bytes_.empty(); }

    /// Often something sensible, else any bits.
    double real(double sensible) {
        const int choice = below(8);
        return choice == 0 ? take<double>() : sensible * (1 + choice);
    }
    std::int32_t whole(std::int32_t sensible) {
        return below(8) == 0 ? take<std::int32_t>() : sensible;
    }

  private:
    std::span<const std::uint8_t> bytes_;
};

stairwell_settings settingsFrom(Bytes& in) {
    stairwell_settings s;
    stairwell_settings_init(&s, sizeof s);
    const int changes = in.below(6);
    for (int i = 0; i < changes; ++i) {
        switch (in.below(15)) {
            case 0:
                s.min_size = in.whole(1 << in.below(14));
                break;
            case 1:
                s.max_size = in.whole(1 << in.below(16));
                break;
            case 2:
                s.driver_max_size = in.whole(4096);
                break;
            case 3:
                s.level_ratio = in.whole(in.below(3));
                break;
            case 4:
                s.lower_after_frames = in.whole(in.below(5));
                break;
            case 5:
                s.lower_below_percent = in.whole(in.below(120));
                break;
            case 6:
                s.start_size = in.whole(512);
                break;
            case 7:
                s.texture_size = in.whole(2048);
                break;
            case 8:
                s.cross_fade_frames = in.whole(in.below(9));
                break;
            case 9:
                s.budget_per_texel = in.whole(1 + in.below(30));
                break;
            case 10:
                s.percentile = in.real(0.12);
                break;
            case 11:
                s.slope.c = in.real(1);
                break;
            case 12:
                s.slope.contrast_exponent = in.real(0.1);
                break;
            case 13:
                (in.below(2) ? s.reserved : s.slope.reserved) = in.whole(0);
                break;
            default:
                s.slope.c90 = in.real(1);
                break;
        }
    }
    return s;
}

stairwell_light lightFrom(Bytes& in, stairwell_histogram& histogram) {
    stairwell_light light;
    stairwell_light_init(&light, sizeof light);
    light.kind = in.below(5) == 4 ? in.take<std::int32_t>() : in.below(4);
    light.radius_uv = in.real(0.001 * in.below(100));
    for (int i = in.below(4); i > 0; --i) {
        stairwell_histogram_add(
            &histogram, static_cast<float>(std::clamp(in.real(100 * in.below(90)), -1e30, 1e30)),
            in.take<std::uint32_t>());
    }
    if (in.below(8) > 0) light.histogram = &histogram;
    if (in.below(4) == 0) light.contrast = in.real(0.1);
    if (in.below(4) == 0) light.footprint_uv = in.real(0.001);
    if (in.below(4) == 0) light.largest_radius_uv = in.real(0.01);
    if (in.below(4) == 0) light.budget_size = in.whole(1 << in.below(14));
    if (in.below(4) == 0) light.camera_cut = in.below(2);
    if (in.below(4) == 0) light.data_age_frames = in.whole(in.below(4));
    if (in.below(4) == 0) light.detail_texels = in.whole(100 * in.below(60));
    return light;
}

/// A light's recent frames through C and through C++, until a program writes over the struct.
class Recent {
  public:
    explicit Recent(Bytes& in) {
        const std::int32_t frames = in.whole(1 + in.below(STAIRWELL_MOST_RECENT));
        const bool made = stairwell_recent_init(&c_, sizeof c_, frames) == STAIRWELL_OK;
        fuzz::require(made == (frames >= 1 && frames <= STAIRWELL_MOST_RECENT),
                      "as many frames as there is room for");
        if (made) {
            cpp_ = resolution_controller::RecentDemand(frames);
        } else {
            stairwell_recent_init(&c_, sizeof c_, 1);
        }
    }

    const stairwell_histogram& add(Bytes& in, const stairwell_histogram& newest) {
        if (in.below(16) == 0) spoil(in);
        if (in.below(16) == 0 && stairwell_recent_clear(&c_) == STAIRWELL_OK) cpp_.clear();
        const bool itself = in.below(8) == 0;
        if (stairwell_recent_add(&c_, itself ? &c_.sum : &newest) == STAIRWELL_OK) {
            cpp_.add(itself ? cpp_.sum()
                            : std::bit_cast<resolution_controller::DemandHistogram>(newest));
        }
        fuzz::require(
            spoilt_ || std::bit_cast<resolution_controller::DemandHistogram>(c_.sum) == cpp_.sum(),
            "C adds up as C++ does");
        return c_.sum;
    }

  private:
    void spoil(Bytes& in) {
        spoilt_ = true;
        switch (in.below(3)) {
            case 0:
                c_.struct_size = in.take<std::uint32_t>();
                break;
            case 1:
                c_.frames = in.whole(in.below(70));
                break;
            default:
                c_.next = in.whole(in.below(70));
                break;
        }
    }

    stairwell_recent c_{};
    resolution_controller::RecentDemand cpp_;
    bool spoilt_ = false;
};

/// What a point asks for, of any numbers.
void checkPoint(Bytes& in, const stairwell_settings& settings) {
    const auto any = [&in] { return in.take<float>(); };
    const float footprint = stairwell_pixel_footprint(any(), any(), any(), any());
    fuzz::require(std::isfinite(footprint) && footprint >= 0, "a footprint is a length or 0");
    fuzz::require(stairwell_demand(&settings, any(), any(), any(), any()) >= 0,
                  "a demand is a number of texels");
    const std::uint32_t weight = stairwell_demand_weight(any(), any());
    fuzz::require(weight >= 1 && weight <= 64, "a weight is 1 to 64");
}

/// A slope for an audience that describes itself, or a status.
void checkAudience(Bytes& in, const stairwell_slope& measured) {
    stairwell_slope asked;
    stairwell_slope_init(&asked, sizeof asked);
    std::uint32_t warnings = 0;
    const stairwell_status status =
        stairwell_slope_for(&measured, in.real(0.1), in.real(0.1), in.whole(in.below(3)),
                            in.whole(in.below(5)), &asked, &warnings);
    fuzz::require(status != STAIRWELL_OK || (asked.c > 0 && std::isfinite(asked.c)),
                  "a slope can be used");
    fuzz::require(warnings < 2 * STAIRWELL_POPULATION_UNKNOWN, "warnings are those that are named");
    fuzz::require(stairwell_warning_text(warnings) != nullptr, "every warning has a text");
    fuzz::require(stairwell_status_text(in.take<std::int32_t>()) != nullptr, "and every status");
    fuzz::require(stairwell_reason_text(in.take<std::int32_t>()) != nullptr, "and every reason");
}

void check(const stairwell_decision& d) {
    using namespace resolution_controller;
    fuzz::require(levelAtLeast(d.size, LevelRatio::sqrtTwo) == d.size, "the size is a level");
    fuzz::require(d.reason >= 0 && d.reason <= STAIRWELL_SWITCHED_OFF, "the reason has a name");
    fuzz::require(d.changed == (d.size != d.previous_size), "changed says so");
    fuzz::require(d.fade_weight > 0 && d.fade_weight <= 1, "the fade is a weight");
    fuzz::require(d.share_above >= 0 && d.share_above <= 1, "a share is a share");
    fuzz::require(d.cleared >= d.viewport && d.viewport == d.size, "the rectangle holds the map");
    for (const double value : {d.artifact_ratio, d.min_radius_uv, d.texture_scale, d.texel_uv,
                               d.radius_uv, d.plane_bias_uv, d.normal_offset_uv}) {
        fuzz::require(std::isfinite(value) && value >= 0, "outputs are finite");
    }
}

}  // namespace

std::vector<std::string> fuzz::seeds() {
    std::mt19937_64 random(3);
    std::vector<std::string> result(12);
    for (std::size_t i = 0; i < result.size(); ++i) {
        for (std::size_t n = 0; n < 60 * (i + 1); ++n) {
            result[i].push_back(static_cast<char>(random() % (i % 2 ? 256 : 9)));
        }
    }
    return result;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Bytes in({data, size});
    const auto count = static_cast<std::size_t>(in.below(6));
    std::vector<stairwell_settings> settings;
    for (std::size_t i = 0; i < count; ++i) settings.push_back(settingsFrom(in));
    for (const stairwell_settings& light : settings) {
        checkPoint(in, light);
        checkAudience(in, light.slope);
    }
    stairwell_lights* lights = nullptr;
    char message[80];
    if (stairwell_create(settings.data(), count, &lights, message, sizeof message)) return 0;

    std::vector<std::byte> trace(1 << 16);
    const bool tracing = stairwell_trace_start(lights, trace.data(), trace.size()) == STAIRWELL_OK;
    std::vector<stairwell_histogram> histograms(count, stairwell_histogram{});
    std::vector<Recent> recent;
    recent.reserve(count);
    for (std::size_t i = 0; i < count; ++i) recent.emplace_back(in);
    std::vector<stairwell_light> frame(count);
    std::vector<stairwell_decision> decisions(count);
    for (int call = 0; call < 200 && !in.empty(); ++call) {
        if (in.below(10) == 0) {
            const stairwell_settings changed = settingsFrom(in);
            stairwell_reconfigure(lights, in.take<std::uint8_t>() % 8, &changed, message,
                                  sizeof message);
            continue;
        }
        for (std::size_t i = 0; i < count; ++i) {
            frame[i] = lightFrom(in, histograms[i]);
            if (in.below(3) == 0) frame[i].histogram = &recent[i].add(in, histograms[i]);
        }
        const std::int64_t budget =
            in.below(8) == 0 ? in.take<std::int64_t>() : std::int64_t{100'000} * in.below(255);
        const bool limited = in.below(3) > 0;
        stairwell_summary summary;
        if (stairwell_update(lights, frame.data(), count, limited ? &budget : nullptr,
                             decisions.data(), sizeof(stairwell_decision), &summary)) {
            continue;
        }
        for (const stairwell_decision& d : decisions) check(d);
        if (limited && summary.feasible) {
            const auto available = static_cast<std::uint64_t>(std::max<std::int64_t>(budget, 0));
            fuzz::require(summary.used <= available, "the budget holds");
        }
    }
    std::size_t bytes = 0;
    stairwell_trace_stop(lights, &bytes, nullptr);
    stairwell_destroy(lights);
    if (tracing) {
        fuzz::require(stairwell_trace_replay(trace.data(), bytes, nullptr, message,
                                             sizeof message) == STAIRWELL_OK,
                      "a trace replays");
    }
    return 0;
}

// SPDX-License-Identifier: MIT
#include "resolution_controller/trace.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>
#include <stdexcept>
#include <vector>

#include "resolution_controller/sentence.h"
#include "resolution_controller/trace_bytes.h"

namespace resolution_controller {
namespace {

constexpr std::array<std::uint8_t, 8> kMagic{'S', 'T', 'W', 'T', 'R', 'A', 'C', 'E'};
constexpr std::uint8_t kFrameRecord = 1, kSettingsRecord = 2;

void write(ByteWriter& out, const std::optional<std::int32_t>& value) noexcept {
    out.number(value.has_value());
    out.number(value.value_or(0));
}

void write(ByteWriter& out, const Frame& f) noexcept {
    write(out, f.budgetSize);
    numbers(out, f.cameraCut, f.dataAgeFrames, f.contrast, f.footprintUv, f.detailTexels,
            f.largestRadiusUv);
}

void write(ByteWriter& out, const LightData& data) noexcept {
    const bool histogram = data.kind == LightData::Kind::histogram && data.histogram;
    numbers(out, data.kind, data.radiusUv, histogram);
    write(out, data.frame);
    if (!histogram) return;
    // Only the bins that hold something, after a mask of which these are.
    std::uint64_t mask = 0;
    const auto& counts = data.histogram->counts;
    for (std::size_t b = 0; b < counts.size(); ++b) {
        mask |= static_cast<std::uint64_t>(counts[b] > 0) << b;
    }
    numbers(out, mask, data.histogram->rejected);
    for (const std::uint32_t count : counts) {
        if (count > 0) out.number(count);
    }
}

struct ReadData {
    LightData data;
    DemandHistogram histogram;
};

void read(ByteReader& in, Frame& f) noexcept {
    const bool limited = in.take<bool>();
    const auto size = in.take<std::int32_t>();
    if (limited) f.budgetSize = size;
    numbers(in, f.cameraCut, f.dataAgeFrames, f.contrast, f.footprintUv, f.detailTexels,
            f.largestRadiusUv);
}

void read(ByteReader& in, ReadData& into) noexcept {
    into = {};
    bool histogram = false;
    numbers(in, into.data.kind, into.data.radiusUv, histogram);
    read(in, into.data.frame);
    if (!histogram) return;
    std::uint64_t mask = 0;
    numbers(in, mask, into.histogram.rejected);
    for (std::size_t b = 0; b < into.histogram.counts.size(); ++b) {
        if ((mask >> b & 1) != 0) in.number(into.histogram.counts[b]);
    }
    into.data.histogram = &into.histogram;
}

/// Reads a trace and makes its decisions again; what stops it is a std::runtime_error.
class Replay {
  public:
    explicit Replay(std::span<const std::byte> bytes) : in_(bytes) {}

    void run(ReplayReport& report) {
        readHeader();
        while (!in_.atEnd()) {
            const auto kind = in_.take<std::uint8_t>();
            if (kind == kFrameRecord) {
                frame(report);
            } else if (kind == kSettingsRecord) {
                settings();
            } else {
                fail("unknown kind of record, " + std::to_string(kind));
            }
        }
    }

  private:
    [[noreturn]] void fail(const std::string& what) const {
        throw std::runtime_error("trace, byte " + std::to_string(in_.used()) + ": " + what);
    }
    void requireGood() const {
        if (!in_.good()) fail("the trace ends within a record, or holds a flag other than 0 and 1");
    }

    void readHeader() {
        for (const std::uint8_t letter : kMagic) {
            if (in_.take<std::uint8_t>() != letter) fail("not a trace: must begin with STWTRACE");
        }
        const auto major = in_.take<std::uint16_t>();
        minor_ = in_.take<std::uint16_t>();
        const auto count = in_.take<std::uint32_t>();
        requireGood();
        if (major != kTraceMajor) {
            fail("major version is " + std::to_string(major) + ": must be " +
                 std::to_string(kTraceMajor));
        }
        if (minor_ > kTraceMinor) {
            fail("minor version is " + std::to_string(minor_) + ": must be at most " +
                 std::to_string(kTraceMinor) + ", since newer ones decide by other rules");
        }
        // Before anything is allocated: no light takes less than a hundred bytes.
        if (count > kMostLights || count > in_.left() / 100) {
            fail("number of lights is " + std::to_string(count) +
                 ": must be at most 4096 and fit into the trace");
        }
        readLights(count);
    }

    void readLights(std::size_t count) {
        std::vector<Settings> settings(count);
        std::vector<ControllerState> states(count);
        std::vector<HeldNeed> needs(count);
        for (std::size_t i = 0; i < count; ++i) {
            fields(in_, settings[i]);
            fields(in_, states[i], rules());
            fields(in_, needs[i], rules());
        }
        requireGood();
        try {
            lights_.emplace(settings);
            lights_->decideBy(rules());
            for (std::size_t i = 0; i < count; ++i) {
                lights_->restore(i, states[i], needs[i]);
                last_.emplace_back(states[i].last);
            }
        } catch (const std::invalid_argument& problem) {
            fail(problem.what());
        }
        read_.resize(count);
        data_.resize(count);
        decisions_.resize(count);
    }

    /// Those of 1.0 are 1.1's and what decidedAgain() makes of them.
    Rules rules() const { return static_cast<Rules>(std::max<std::uint16_t>(minor_, 1)); }

    void frame(ReplayReport& report) {
        Budget budget;
        const bool limited = in_.take<bool>();
        const auto texels = in_.take<std::int64_t>();
        if (limited) budget.texels = texels;
        for (std::size_t i = 0; i < read_.size(); ++i) {
            read(in_, read_[i]);
            data_[i] = read_[i].data;
        }
        requireGood();
        lights_->update(data_, decisions_, budget);
        for (std::size_t i = 0; i < read_.size(); ++i) {
            TracedDecision recorded;
            fields(in_, recorded);
            requireGood();
            last_[i] = decidedAgain(i);
            compare(report, i, recorded, last_[i]);
        }
        ++report.frames;
    }

    /// What the rules of the trace's version make of the light's present decision.
    TracedDecision decidedAgain(std::size_t light) const {
        const Decision& now = decisions_[light];
        TracedDecision decision(now);
        if (minor_ >= 1) return decision;
        const TracedDecision& last = last_[light];
        if (isHeld(now.reason) && now.size == last.size) {
            decision.minRadiusUv = last.minRadiusUv;
        } else {
            const bool limited = now.shareAbove > 0 || now.artifactRatio > 1;
            decision.minRadiusUv =
                limited ? lights_->light(light).settings().slope.c / now.size : 0;
        }
        return decision;
    }

    static void compare(ReplayReport& report, std::size_t light, const TracedDecision& recorded,
                        const TracedDecision& now) {
        if (recorded == now) return;
        if (report.differences++ > 0) return;
        report.firstFrame = report.frames;
        report.firstLight = light;
        const auto words = [](const TracedDecision& d) {
            char numbers[100];
            std::snprintf(numbers, sizeof numbers, ", need %d, fade %.17g, least radius %.17g)",
                          d.need, d.fadeWeight, d.minRadiusUv);
            return std::to_string(d.size) + " (" + text(d.reason) + numbers;
        };
        report.problem = "frame " + std::to_string(report.frames) + ", light " +
                         std::to_string(light) + ": recorded " + words(recorded) + ", now " +
                         words(now);
    }

    void settings() {
        const auto light = in_.take<std::uint32_t>();
        Settings settings;
        fields(in_, settings);
        requireGood();
        if (light >= read_.size()) fail("settings for light " + std::to_string(light));
        lights_->reconfigure(light, settings);  // what was refused then is refused now
    }

    ByteReader in_;
    std::uint16_t minor_ = 0;
    std::optional<LightSet> lights_;
    std::vector<ReadData> read_;
    std::vector<LightData> data_;
    std::vector<Decision> decisions_;
    std::vector<TracedDecision> last_;
};

}  // namespace

bool TraceWriter::begin(const LightSet& lights) noexcept {
    ByteWriter out(buffer_);
    for (const std::uint8_t letter : kMagic) out.number(letter);
    const Rules rules = lights.rules();
    const auto minor = static_cast<std::uint16_t>(rules);
    numbers(out, kTraceMajor, minor);
    out.number(static_cast<std::uint32_t>(lights.count()));
    for (std::size_t i = 0; i < lights.count(); ++i) {
        fields(out, lights.light(i).settings());
        fields(out, lights.light(i).state(), rules);
        fields(out, lights.heldNeed(i), rules);
    }
    frames_ = lost_ = 0;
    lights_ = lights.count();
    open_ = out.good();
    used_ = open_ ? out.used() : 0;
    return open_;
}

bool TraceWriter::frame(std::span<const LightData> data, const Budget& budget,
                        std::span<const Decision> decisions) noexcept {
    open_ = open_ && data.size() == lights_ && decisions.size() == lights_;
    ByteWriter out(open_ ? buffer_.subspan(used_) : std::span<std::byte>{});
    out.number(kFrameRecord);
    out.number(budget.texels.has_value());
    out.number(budget.texels.value_or(0));
    for (const LightData& d : data) write(out, d);
    for (const Decision& d : decisions) {
        const TracedDecision traced(d);
        fields(out, traced);
    }
    open_ = open_ && out.good();
    if (!open_) {
        ++lost_;
        return false;
    }
    used_ += out.used();
    ++frames_;
    return true;
}

bool TraceWriter::reconfigured(std::size_t light, const Settings& settings) noexcept {
    ByteWriter out(open_ ? buffer_.subspan(used_) : std::span<std::byte>{});
    out.number(kSettingsRecord);
    out.number(static_cast<std::uint32_t>(light));
    fields(out, settings);
    open_ = open_ && out.good() && light < lights_;
    if (open_) used_ += out.used();
    return open_;
}

ReplayReport replay(std::span<const std::byte> bytes) {
    ReplayReport report;
    try {
        Replay(bytes).run(report);
        report.same = report.differences == 0;
    } catch (const std::runtime_error& problem) {
        if (!report.problem.empty()) report.problem += "; then ";
        report.problem += problem.what();
    }
    return report;
}

}  // namespace resolution_controller

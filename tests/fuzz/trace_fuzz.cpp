// SPDX-License-Identifier: MIT
// Any bytes as a trace: a verdict, never a crash.
#include <random>
#include <span>

#include "resolution_controller/trace.h"
#include "tests/fuzz/fuzz_target.h"

namespace rc = resolution_controller;

namespace {

std::string traceOf(const std::vector<rc::Settings>& settings, rc::Rules rules,
                    std::mt19937_64& random) {
    const std::size_t lights = settings.size();
    rc::LightSet set(settings);
    set.decideBy(rules);
    std::vector<std::byte> buffer(1 << 16);
    rc::TraceWriter writer(buffer);
    writer.begin(set);
    rc::DemandHistogram histogram;
    std::vector<rc::LightData> data(lights);
    std::vector<rc::Decision> decisions(lights);
    const auto frame = [&](const rc::Budget& budget) {
        set.update(data, decisions, budget);
        writer.frame(data, budget, decisions);
    };
    for (int i = 0; i < 6; ++i) {
        histogram.add(static_cast<float>(random() % 3000));
        for (auto& light : data) {
            light = {.kind = rc::LightData::Kind(random() % 4),
                     .radiusUv = 0.01,
                     .histogram = &histogram,
                     .frame = {.cameraCut = i == 3}};
        }
        frame({.texels = 3'000'000});
    }
    const rc::Settings other{.slope = {.c = 5}, .maxSize = 512};
    set.reconfigure(0, other);  // refused where there is no light
    if (lights > 0) writer.reconfigured(0, other);
    data.assign(lights, {});
    frame({});
    const auto bytes = writer.bytes();
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

std::vector<std::string> fuzz::seeds() {
    std::mt19937_64 random(5);
    std::vector<std::string> result;
    for (std::vector<rc::Settings> settings; settings.size() < 4;
         settings.push_back({.crossFadeFrames = 3})) {
        using enum rc::Rules;
        for (const rc::Rules rules : {fallsRemembered, needsRemembered, nothingRemembered})
            result.push_back(traceOf(settings, rules, random));
        result.push_back(result.back());
        constexpr std::size_t kMinorAt = 10;
        result.back()[kMinorAt] = 0;  // as 1.1 in form
    }
    return result;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const rc::ReplayReport report = rc::replay(std::as_bytes(std::span(data, size)));
    fuzz::require(report.same == report.problem.empty(), "a problem has a sentence");
    return 0;
}

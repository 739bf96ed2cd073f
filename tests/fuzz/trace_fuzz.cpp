// SPDX-License-Identifier: MIT
// Any bytes as a trace: a verdict, never a crash.
#include <random>
#include <span>

#include "resolution_controller/trace.h"
#include "tests/fuzz/fuzz_target.h"

namespace rc = resolution_controller;

std::vector<std::string> fuzz::seeds() {
    std::mt19937_64 random(5);
    std::vector<std::string> result;
    for (std::size_t lights = 0; lights < 4; ++lights) {
        const std::vector<rc::Settings> settings(lights, {.crossFadeFrames = 3});
        rc::LightSet set(settings);
        std::vector<std::byte> buffer(1 << 16);
        rc::TraceWriter writer(buffer);
        writer.begin(set);
        rc::DemandHistogram histogram;
        std::vector<rc::LightData> data(lights);
        std::vector<rc::Decision> decisions(lights);
        for (int frame = 0; frame < 6; ++frame) {
            histogram.add(static_cast<float>(random() % 3000));
            for (auto& light : data) {
                light = {.kind = rc::LightData::Kind(random() % 4),
                         .radiusUv = 0.01,
                         .histogram = &histogram,
                         .frame = {.cameraCut = frame == 3}};
            }
            const rc::Budget budget{.texels = 3'000'000};
            set.update(data, decisions, budget);
            writer.frame(data, budget, decisions);
        }
        if (lights > 0) writer.reconfigured(0, {.maxSize = 512});
        const auto bytes = writer.bytes();
        result.emplace_back(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    }
    return result;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const rc::ReplayReport report = rc::replay(std::as_bytes(std::span(data, size)));
    fuzz::require(report.same == report.problem.empty(), "a problem has a sentence");
    return 0;
}

// SPDX-License-Identifier: MIT
#include "tests/study_app/mutated_designs.h"

#include <vector>

namespace tests {

using nlohmann::json;

namespace {

const std::vector<json>& oddValues() {
    static const std::vector<json> values{nullptr,
                                          true,
                                          false,
                                          0,
                                          1,
                                          -1,
                                          2,
                                          3,
                                          0.5,
                                          0.25,
                                          45,
                                          600,
                                          1e-300,
                                          1e300,
                                          -0.0,
                                          2147483648,
                                          9007199254740993,
                                          "",
                                          "stair",
                                          "line",
                                          "disc",
                                          "poisson8",
                                          "yes_no",
                                          "mask",
                                          "a\tb",
                                          "\xc3\xa9",
                                          json::array(),
                                          json::object(),
                                          {1, 2},
                                          {"step", "stair"},
                                          {{"pattern", "line"}, {"angle_deg", 20}},
                                          {{"correct", 2}, {"of_last", 2}}};
    return values;
}

}  // namespace

json fullDesign() {
    return json::parse(R"({
        "schema": {"name": "stairwell design", "major": 1, "minor": 0},
        "name": "angles", "description": "everything", "task": "yes_no", "encoding": "srgb",
        "window_px": 200, "artifact_px": [4, 8],
        "patterns": [{"pattern": "step", "orientation": "vertical"},
                     {"pattern": "line", "angle_deg": 22.5, "orientation": "horizontal"}, "stair"],
        "lit_levels": [1, 0.5], "kernels": ["disc", "poisson16"], "noise_levels": [0, 4],
        "dither": false, "localise": true, "trials_per_condition": 3, "catch_share": 0.3,
        "quest": {"preset": "default", "guess_ratio": 3, "prior_sd": 0.4,
                  "threshold_probability": 0.65, "beta": 3.5, "delta": 0.02, "gamma": 0.05,
                  "grain": 0.01, "range": 6},
        "radius_px": {"min": 0.5, "max": 100, "step": 0.25},
        "roving": {"shift": true, "quarter_turn": true, "mirror": true, "tilt": false},
        "only_conditions": ["stair-a4-lit1-disc-noise0", "stair-a8-lit0.5-poisson16-noise4"],
        "screening": {"false_alarm_rate": 0.1, "catch_failure_share": 0.2},
        "presentation": {"blank_s": 0.3, "fixation_s": 0.5, "between": "mask", "time_limit_s": 10,
            "too_fast_s": 0.15, "feedback": false, "feedback_s": 0.5, "background_code": 64,
            "break_every_trials": 60, "break_minimum_s": 15,
            "practice": {"correct": 4, "of_last": 5, "at_most": 30},
            "resumed_practice": {"correct": 2, "of_last": 3, "at_most": 15}}})");
}

json mutated(std::mt19937_64& random, const json& design) {
    json result = design;
    for (std::uint64_t count = 1 + random() % 3; count > 0; --count) {
        // Down from the top until one place is left alone no longer.
        json* at = &result;
        while (at->is_structured() && !at->empty()) {
            auto item = at->begin();
            std::advance(item, static_cast<std::ptrdiff_t>(random() % at->size()));
            const std::uint64_t what = random() % 12;
            if (what == 0) {
                at->erase(item);
                break;
            }
            if (what == 1 && at->is_array()) {
                at->push_back(*item);
                break;
            }
            if (what == 2) {
                *item = oddValues()[random() % oddValues().size()];
                break;
            }
            at = &*item;
        }
        if (!at->is_structured()) *at = oddValues()[random() % oddValues().size()];
    }
    return result;
}

}  // namespace tests

// SPDX-License-Identifier: MIT
#include "tests/renderer/hard_cases.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>

#include "tests/renderer/exact_technique.h"

namespace tests {
namespace {

using renderer::Technique;

// The box reaches 4.25 texels: over the whole map of 9 x 9, its rim with three quarters, and no
// further.
constexpr int kEdge = 9;
const double kRadius = 4.25 / kEdge * 2 / std::sqrt(3.0);

HardCase caseOf(std::string name, const std::function<double(int)>& depth,
                std::vector<HardReceiver> receivers, int edge = kEdge, double radiusUv = kRadius) {
    HardCase hard{std::move(name), edge, radiusUv, {}, std::move(receivers)};
    for (int i = 0; i < edge * edge; ++i) hard.depths.push_back(static_cast<float>(depth(i)));
    return hard;
}

/// Clear of the technique's biases on both sides, so that no case asks which way a step falls.
std::vector<HardReceiver> around(std::initializer_list<double> depths,
                                 glm::dvec2 gradient = glm::dvec2(0)) {
    std::vector<HardReceiver> receivers;
    for (const double depth : depths)
        for (const double step : {-0.1, -0.01, 0.0, 0.01, 0.1})
            if (depth + step >= 0 && depth + step <= 1.2)
                receivers.push_back({depth + step, gradient});
    return receivers;
}

/// From the middle of the map, in texels.
struct Place {
    double right, up;
    const char* name;
};
constexpr Place kPlaces[] = {
    {0, 0, ""}, {0.21, -0.37, ", between texels"}, {4.2, -1.37, ", at the map's edge"}};

template <class Real>
void widen(HardError& found, const Technique& technique, const HardCase& hard,
           const Variant& variant, renderer::Storage storage) {
    DepthMap map(hard.edge, [](double, double) { return 0; });
    map.texels = hard.depths;
    renderer::ParameterValues parameters = technique.standardParameters();
    for (const char* unknown : {"derivative", "rotated"})  // to exact_technique.h
        if (technique.parameterSlot(unknown)) setParameter(technique, parameters, unknown, 0);
    for (const auto& [name, value] : variant) setParameter(technique, parameters, name, value);
    const auto constants = constantsFor(technique, hard.edge, hard.radiusUv, parameters);
    const CpuTechnique<Real> filter(technique, map, constants, storage);
    const CpuTechnique<double> wide(technique, map, constants, renderer::Storage::exact);
    for (const HardReceiver& at : hard.receivers)
        for (const Place& place : kPlaces) {
            const auto receiver = receiverAt(0.5 + place.right / hard.edge,
                                             0.5 + place.up / hard.edge, at.depth, at.gradient);
            // The formulas are those of a kernel around the middle of a texel.
            const auto exact = place.right == 0 && place.up == 0
                                   ? exactVisibility(technique, map, receiver, constants)
                                   : std::nullopt;
            const double truth = exact ? static_cast<double>(*exact) : wide(receiver);
            const double error = std::abs(filter(receiver) - truth);
            if (error <= found.worst) continue;
            char text[96];
            std::snprintf(text, sizeof text, "%s, receiver %.6g%s", hard.name.c_str(), at.depth,
                          place.name);
            found = {error, text};
        }
}

}  // namespace

std::string toText(Precision precision) {
    switch (precision) {
        case Precision::half:
            return "map in halves";
        case Precision::asStored:
            return "as stored";
        case Precision::doubles:
            return "double";
    }
    return "unknown precision";
}

std::string toText(const Variant& variant) {
    std::string text;
    for (const auto& [name, value] : variant) {
        char number[32];
        std::snprintf(number, sizeof number, "%g", static_cast<double>(value));
        text += (text.empty() ? "" : " ") + std::string(name) + "=" + number;
    }
    return text;
}

std::vector<Variant> variantsOf(const Technique& technique) {
    const std::string_view file = technique.fileName();
    if (file == "pcf_grid")
        return {{}, {{"bilinear", 0}}, {{"gaussian", 1}}, {{"bilinear", 0}, {"gaussian", 1}}};
    if (file == "pcf_taps") return {{}, {{"pattern", 0}}, {{"bilinear", 0}}};
    if (file == "gsm")
        return {{},
                {{"gradient", 0}},
                {{"gradient", 1}},
                {{"gradient", 1}, {"pattern", 1}},
                {{"gradient", 1}, {"pattern", 2}},
                {{"gradient", 1}, {"pattern", 1}, {"offsets", 0}}};
    if (file == "gsm_stored") return {{}, {{"pattern", 1}}, {{"pattern", 2}}};
    if (file == "vsm") return {{}, {{"bleeding", 0.3F}}};
    if (file == "vsm_samples") return {{}, {{"samples", 1}}, {{"samples", 4}}};
    if (file == "lvsm") return {{}, {{"layers", 1}}, {{"layers", 16}}};
    if (file == "power_cdf") return {{}, {{"layers", 4}}, {{"layers", 16}}};
    if (file == "csm") return {{}, {{"terms", 1}, {"damping", 0}}};
    return {{}};
}

std::vector<HardCase> hardCases() {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const auto flat = [](std::string name, double depth) {
        return caseOf(
            std::move(name), [=](int) { return depth; }, around({depth}));
    };
    const auto split = [](std::string name, double low, double high, int every) {
        return caseOf(
            std::move(name), [=](int i) { return i % every == 0 ? low : high; },
            around({low, 0.5 * (low + high), high}));
    };
    const auto twoDepths = [](int i) { return i % 2 == 0 ? 0.3 : 0.7; };
    const auto slope = [](int i) { return 0.4 + 0.02 * (i % kEdge); };
    return {
        flat("flat", 0.4),
        flat("flat at the light", 0),
        flat("flat near the far end", 0.9996),
        flat("cleared", 1),
        caseOf("no blockers", [](int) { return 0.8; }, {{0.1}, {0.5}, {0.79}}),
        split("two depths", 0.3, 0.7, 2),
        split("two depths 1e-6 apart", 0.5, 0.500001, 2),
        split("two depths near 1", 0.95, 0.999, 2),
        caseOf("contact", [](int i) { return i % 2 == 0 ? 0.5 : 0.52; },
               {{0.505}, {0.51}, {0.515}, {0.53}}),
        split("one blocker texel (b to infinity)", 0.2, 0.8, 1000),
        split("blocker at the light", 0, 0.6, 3),
        caseOf(
            "one far texel (b to 0)", [](int i) { return i == 40 ? 0.9 : 0.3; },
            around({0.3, 0.6, 0.9})),
        caseOf(
            "three depths", [](int i) { return 0.1 + 0.4 * (i % 3); }, around({0.1, 0.5, 0.9})),
        caseOf(
            "three occluders over a receiver", [](int i) { return 0.2 * (1 + i % 4); },
            around({0.2, 0.4, 0.6, 0.8})),
        caseOf("slope", slope, around({0.4, 0.48, 0.56})),
        caseOf("slope, receiver's plane along it", slope, around({0.48}, {0.02 * kEdge, 0})),
        caseOf("slope, receiver's plane nearly along the map", slope,
               around({0.48}, {1e-30, -1e-20})),
        caseOf(
            "steep slope", [](int i) { return 0.1 + 0.1 * (i % kEdge); }, around({0.1, 0.5, 0.9})),
        caseOf(
            "grazing receiver", [](int) { return 0.5; }, around({0.5}, {30, -7})),
        caseOf(
            "no number, out of range",
            [=](int i) {
                const double odd[] = {kNan, kInfinity, -kInfinity, -2, 7, 0.5};
                return odd[i % 6];
            },
            around({0.2, 0.5, 0.8})),
        caseOf(
            "map of one texel", [](int) { return 0.5; }, around({0.5}), 1, 0.3),
        caseOf("kernel of no width", twoDepths, around({0.3, 0.7}), kEdge, 0),
        caseOf("kernel of less than a texel", twoDepths, around({0.3, 0.7}), kEdge, 0.45 / kEdge),
        caseOf("kernel wider than the map", twoDepths, around({0.3, 0.7}), kEdge, 2.5),
    };
}

HardError worstError(const Technique& technique, Precision precision, const Variant& variant) {
    HardError found;
    for (const HardCase& hard : hardCases()) {
        if (precision == Precision::doubles)
            widen<double>(found, technique, hard, variant, renderer::Storage::exact);
        else
            widen<float>(found, technique, hard, variant,
                         precision == Precision::half ? renderer::Storage::half
                                                      : renderer::Storage::asFormat);
    }
    return found;
}

}  // namespace tests

// SPDX-License-Identifier: MIT
#include "tests/renderer/hard_cases.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>

#include "tests/renderer/technique_case.h"

namespace tests {
namespace {

using Wide = long double;
using renderer::Prefilter;
using renderer::Technique;

constexpr int kEdge = 9;
// The box reaches 4.25 texels: over the whole map, its rim with three quarters, and no further.
constexpr double kReach = 4.25;
const double kRadius = kReach / kEdge * 2 / std::sqrt(3.0);

Wide weightAt(std::size_t texel) {
    const auto rim = [](std::size_t i) -> Wide { return i % (kEdge - 1) == 0 ? 0.75L : 1; };
    return rim(texel % kEdge) * rim(texel / kEdge) / (2 * kReach * 2 * kReach);
}

HardCase caseOf(std::string name, const std::function<double(int)>& depth,
                std::vector<double> receivers) {
    HardCase hard{std::move(name), {}, std::move(receivers)};
    for (int i = 0; i < kEdge * kEdge; ++i) hard.depths.push_back(static_cast<float>(depth(i)));
    return hard;
}

/// Clear of the technique's biases on both sides, so that no case asks which way a step falls.
std::vector<double> around(std::initializer_list<double> depths) {
    std::vector<double> receivers;
    for (const double depth : depths)
        for (const double step : {-0.1, -0.01, 0.0, 0.01, 0.1})
            if (depth + step >= 0 && depth + step <= 1.2) receivers.push_back(depth + step);
    return receivers;
}

double caster(double depth) {
    return std::isnan(depth) ? 1 : std::clamp(depth, 0.0, 1.0);
}

/// What the long double formulas start from.
struct Distribution {
    std::vector<Wide> depths, weights;

    template <class Value>
    Wide mean(const Value& value) const {
        Wide sum = 0;
        for (std::size_t i = 0; i < depths.size(); ++i) sum += weights[i] * value(depths[i]);
        return sum;
    }
    Wide least() const { return *std::min_element(depths.begin(), depths.end()); }
    Wide greatest() const { return *std::max_element(depths.begin(), depths.end()); }
};

Distribution distributionOf(const HardCase& hard) {
    Distribution all;
    for (std::size_t i = 0; i < hard.depths.size(); ++i) {
        all.depths.push_back(caster(static_cast<double>(hard.depths[i])));
        all.weights.push_back(weightAt(i));
    }
    return all;
}

Wide unit(Wide visibility) {
    return std::clamp(visibility, static_cast<Wide>(0), static_cast<Wide>(1));
}

Wide chebyshev(Wide mean, Wide variance, Wide depth) {
    if (depth <= mean) return 1;
    return variance / (variance + (depth - mean) * (depth - mean));
}

Wide parameter(const Technique& technique, const char* name) {
    return technique.standardParameters()[technique.parameterSlot(name).value()];
}

Wide depthOf(const Technique& technique, double receiver, Wide error) {
    const auto slot = technique.parameterSlot("bias_depth");
    const Wide bias = slot ? technique.standardParameters()[*slot] : 0;
    return std::min(static_cast<Wide>(receiver), static_cast<Wide>(1)) - error - bias;
}

Wide variance(const Technique& technique, const Distribution& all, Wide depth) {
    const Wide mean = all.mean([](Wide z) { return z; });
    const Wide about = all.mean([&](Wide z) { return (z - mean) * (z - mean); });
    return chebyshev(mean, std::max(about, parameter(technique, "least_variance")), depth);
}

Wide exponential(const Technique& technique, const Distribution& all, Wide depth) {
    const Wide c = parameter(technique, "exponent");
    return unit(all.mean([&](Wide z) { return std::exp(c * (z - depth)); }));
}

/// One of the two bounds; a negative exponent warps down.
Wide warped(const Technique& technique, const Distribution& all, Wide depth, Wide exponent) {
    const auto warp = [&](Wide z) {
        return std::copysign(std::exp(exponent * (2 * z - 1)), exponent);
    };
    const Wide mean = all.mean(warp);
    const Wide about = all.mean([&](Wide z) { return (warp(z) - mean) * (warp(z) - mean); });
    const Wide least = 2 * parameter(technique, "least_deviation") * exponent * warp(depth);
    return chebyshev(mean, std::max(about, least * least), warp(depth));
}

/// The extremal distribution through `depth` of four moments, in central form: its other two points
/// are the roots of the polynomial of degree 2 that is orthogonal to all of degree 1 under the
/// weight (z - depth).
Wide hamburger(const Technique& technique, const Distribution& all, Wide depth) {
    const Wide alpha = parameter(technique, "moment_bias");
    const auto z = [](Wide x) { return 2 * x - 1; };
    const Wide towards[5] = {1, 0, 0.628L, 0, 0.628L};
    Wide b[5];
    for (int k = 0; k < 5; ++k)
        b[k] =
            (1 - alpha) * all.mean([&](Wide x) { return std::pow(z(x), k); }) + alpha * towards[k];
    const Wide d = z(depth);
    // m_k of the weight; p z + q with m_2 + p m_1 + q m_0 = 0 and m_3 + p m_2 + q m_1 = 0.
    Wide m[4];
    for (int k = 0; k < 4; ++k) m[k] = b[k + 1] - d * b[k];
    const Wide determinant = m[1] * m[1] - m[0] * m[2];
    const Wide p = (m[0] * m[3] - m[1] * m[2]) / determinant;
    const Wide q = (m[2] * m[2] - m[1] * m[3]) / determinant;
    const Wide root = std::sqrt(std::max(p * p / 4 - q, static_cast<Wide>(0)));
    const Wide points[3] = {d, -p / 2 - root, -p / 2 + root};
    Wide shadow = 0;
    for (int i = 1; i < 3; ++i) {
        if (points[i] >= d) continue;
        const Wide r = points[3 - i];
        shadow += (b[2] - (d + r) * b[1] + d * r) / ((points[i] - d) * (points[i] - r));
    }
    return unit(1 - shadow);
}

/// The series, term by term on every depth.
Wide series(const Technique& technique, const Distribution& all, Wide depth) {
    const int terms = static_cast<int>(parameter(technique, "terms"));
    const auto moved = [](Wide z) { return 0.05L + 0.9L * z; };
    const Wide step = all.mean([&](Wide z) {
        Wide sum = 0.5L;
        for (int k = 1; k <= terms; ++k) {
            const Wide c = std::numbers::pi_v<Wide> * (2 * k - 1);
            const Wide share = static_cast<Wide>(k) / terms;
            sum += 2 * std::exp(-parameter(technique, "damping") * share * share) *
                   std::sin(c * (moved(z) - moved(std::max(depth, static_cast<Wide>(0))))) / c;
        }
        return sum;
    });
    return unit(step * parameter(technique, "scale"));
}

Wide layered(const Technique& technique, const Distribution& all, Wide depth) {
    const Wide layers = parameter(technique, "layers");
    if (depth <= 0) return 1;
    const Wide last = std::min(std::ceil(depth * layers), layers) - 1;
    Wide bound = 1;
    for (Wide layer = 0; layer <= last; ++layer) {
        const auto warp = [&](Wide z) { return unit(z * layers - layer); };
        const Wide mean = all.mean(warp);
        const Wide about = all.mean([&](Wide z) { return (warp(z) - mean) * (warp(z) - mean); });
        bound = std::min(
            bound,
            chebyshev(mean, std::max(about, parameter(technique, "least_variance")), warp(depth)));
    }
    return bound;
}

Wide powerFunction(const Distribution& all, Wide depth) {
    const Wide mean = all.mean([](Wide z) { return z; });
    const Wide range = all.greatest() - all.least();
    if (depth <= mean) return 1;
    if (depth >= all.greatest()) return 0;
    const Wide beta = (mean - all.least()) / (all.greatest() - mean);
    const Wide t = (depth - all.least()) / range;
    const Wide m = beta / (beta + 1);
    return unit(std::expm1(beta * std::log(t)) / std::expm1(beta * std::log(m)));
}

/// Absent for a technique whose kernel is no box or that samples it at places of its own.
std::optional<Wide> formula(const Technique& technique, const HardCase& hard, double receiver,
                            Wide error) {
    const Distribution all = distributionOf(hard);
    const Wide depth = depthOf(technique, receiver, error);
    const std::string_view file = technique.fileName();
    if (file == "hard")
        return caster(static_cast<double>(hard.depths[hard.depths.size() / 2])) >= depth ? 1 : 0;
    if (file == "vsm") return variance(technique, all, depth);
    if (file == "esm") return exponential(technique, all, depth);
    if (file == "evsm2")
        return warped(technique, all, depth, parameter(technique, "positive_exponent"));
    if (file == "evsm4")
        return std::min(warped(technique, all, depth, parameter(technique, "positive_exponent")),
                        warped(technique, all, depth, -parameter(technique, "negative_exponent")));
    if (file == "msm" || file == "msm16") return hamburger(technique, all, depth);
    if (file == "csm") return series(technique, all, depth);
    if (file == "lvsm") return layered(technique, all, depth);
    if (file == "power_cdf") return powerFunction(all, depth);
    return std::nullopt;
}

template <class Real>
void widen(HardError& found, const Technique& technique, const HardCase& hard,
           renderer::Storage storage) {
    DepthMap map(kEdge, [](double, double) { return 0; });
    map.texels = hard.depths;
    renderer::ParameterValues parameters = technique.standardParameters();
    if (technique.parameterSlot("derivative")) setParameter(technique, parameters, "derivative", 0);
    const auto constants = constantsFor(technique, kEdge, kRadius, parameters);
    const CpuTechnique<Real> filter(technique, map, constants, storage);
    const CpuTechnique<double> exact(technique, map, constants, renderer::Storage::exact);
    for (const double depth : hard.receivers) {
        const auto receiver = receiverAt(0.5, 0.5, depth);
        const auto expected =
            formula(technique, hard, depth, static_cast<Wide>(receiver.depthError));
        const double truth = expected ? static_cast<double>(*expected) : exact(receiver);
        const double error = std::abs(filter(receiver) - truth);
        if (error <= found.worst) continue;
        char text[64];
        std::snprintf(text, sizeof text, "%s, receiver %.6g", hard.name.c_str(), depth);
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
    return {
        flat("flat", 0.4),
        flat("flat at the light", 0),
        flat("flat near the far end", 0.9996),
        flat("cleared", 1),
        split("two depths", 0.3, 0.7, 2),
        split("two depths 1e-6 apart", 0.5, 0.500001, 2),
        split("two depths near 1", 0.95, 0.999, 2),
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
        caseOf(
            "slope", [](int i) { return 0.4 + 0.02 * (i % kEdge); }, around({0.4, 0.48, 0.56})),
        caseOf(
            "steep slope", [](int i) { return 0.1 + 0.1 * (i % kEdge); }, around({0.1, 0.5, 0.9})),
        caseOf(
            "no number, out of range",
            [=](int i) {
                const double odd[] = {kNan, kInfinity, -kInfinity, -2, 7, 0.5};
                return odd[i % 6];
            },
            around({0.2, 0.5, 0.8})),
    };
}

HardError worstError(const Technique& technique, Precision precision) {
    HardError found;
    for (const HardCase& hard : hardCases()) {
        if (precision == Precision::doubles)
            widen<double>(found, technique, hard, renderer::Storage::exact);
        else
            widen<float>(found, technique, hard,
                         precision == Precision::half ? renderer::Storage::half
                                                      : renderer::Storage::asFormat);
    }
    return found;
}

}  // namespace tests

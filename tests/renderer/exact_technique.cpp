// SPDX-License-Identifier: MIT
#include "tests/renderer/exact_technique.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "tests/renderer/exact_disc.h"

namespace tests {
namespace {

using renderer::Technique;
using Wide = long double;
using Receiver = renderer::f64::ShadowReceiver;
using Constants = renderer::f64::ShadowConstants;

Wide unit(Wide visibility) {
    return std::clamp(visibility, static_cast<Wide>(0), static_cast<Wide>(1));
}

Wide caster(float depth) {
    return std::isnan(depth) ? 1 : unit(static_cast<Wide>(depth));
}

/// One technique over one map at one receiver.
struct Situation {
    const Technique& technique;
    const DepthMap& map;
    const Receiver& receiver;
    const Constants& constants;

    Wide parameter(std::string_view name) const {
        const std::size_t slot = technique.parameterSlot(name).value();
        return constants.parameters[slot / 4][static_cast<int>(slot % 4)];
    }
    Wide parameterOr(std::string_view name, Wide otherwise) const {
        return technique.parameterSlot(name) ? parameter(name) : otherwise;
    }
    bool inside(int column, int row) const {
        return column >= 0 && row >= 0 && column < map.edge && row < map.edge;
    }
    float stored(int column, int row) const { return map.view().at(column, row); }
    Wide steepness() const {
        return std::abs(static_cast<Wide>(receiver.depthGradient.x)) +
               std::abs(static_cast<Wide>(receiver.depthGradient.y));
    }
};

// --- Filtered maps: functions of the distribution of depths under the box ---

Wide boxReach(const Constants& constants) {
    return static_cast<Wide>(constants.prefilter.x) * std::numbers::sqrt3_v<Wide>;
}

/// The depth of the caster in a texel; nothing is in the way outside the map.
Wide casterAt(const Situation& s, int column, int row) {
    return s.inside(column, row) ? caster(s.stored(column, row)) : 1;
}

/// Of a box that reaches so far, in texels, to either side of the middle of a texel.
Distribution underTheBox(const Situation& s, Wide reach, int column, int row) {
    const auto share = [&](int i) {  // of the box, in a texel so far from its middle
        if (reach <= 0.5L) return static_cast<Wide>(i == 0);
        return std::max(std::min(i + 0.5L, reach) - std::max(i - 0.5L, -reach), 0.0L) / (2 * reach);
    };
    const int far = static_cast<int>(std::ceil(reach)) + 1;
    Distribution all;
    for (int j = -far; j <= far; ++j)
        for (int i = -far; i <= far; ++i) {
            const Wide weight = share(i) * share(j);
            if (weight == 0) continue;
            all.depths.push_back(casterAt(s, column + i, row + j));
            all.weights.push_back(weight);
        }
    return all;
}

Distribution underTheBox(const Situation& s, Wide reach) {
    return underTheBox(s, reach, s.map.edge / 2, s.map.edge / 2);
}

void add(Distribution& all, const Distribution& part, Wide weight) {
    for (std::size_t i = 0; i < part.depths.size(); ++i) {
        all.depths.push_back(part.depths[i]);
        all.weights.push_back(weight * part.weights[i]);
    }
}

/// A place's four nearest texels with their bilinear weights.
template <class Visit>
void nearestFour(Wide x, Wide y, const Visit& visit) {
    const int column = static_cast<int>(std::floor(x - 0.5L));
    const int row = static_cast<int>(std::floor(y - 0.5L));
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i)
            visit(column + i, row + j,
                  (1 - std::abs(x - 0.5L - column - i)) * (1 - std::abs(y - 0.5L - row - j)));
}

/// Between texels, the boxes around the four nearest ones.
Distribution underTheBoxes(const Situation& s, Wide reach, Wide x, Wide y) {
    Distribution all;
    nearestFour(x, y, [&](int column, int row, Wide weight) {
        if (weight > 0) add(all, underTheBox(s, reach, column, row), weight);
    });
    return all;
}

/// Of the box around the place itself, the outermost texels by the share of them that it covers;
/// no narrower than a texel.
Distribution underTheWidth(const Situation& s, Wide reach, Wide x, Wide y) {
    const Wide half = std::max(reach, 0.5L);
    const auto share = [&](int i, Wide centre) {
        return std::max(std::min(i + 1.0L, centre + half) - std::max(i + 0.0L, centre - half),
                        0.0L) /
               (2 * half);
    };
    Distribution all;
    for (int j = static_cast<int>(std::floor(y - half)); j < y + half; ++j)
        for (int i = static_cast<int>(std::floor(x - half)); i < x + half; ++i) {
            all.depths.push_back(casterAt(s, i, j));
            all.weights.push_back(share(i, x) * share(j, y));
        }
    return all;
}

/// Of the mip level whose texels are as large as the radius, between the levels and texels around
/// it. Levels are counted from the corner of the map's texture, which lies in the guard band.
Distribution underTheMips(const Situation& s, Wide radiusUv) {
    const Wide texels = std::max(radiusUv * s.map.edge, static_cast<Wide>(1));
    const Wide level = std::min(std::log2(texels), -static_cast<Wide>(s.constants.prefilter.w));
    const int guard = static_cast<int>(s.constants.prefilter.z);
    Distribution all;
    for (const int of : {static_cast<int>(level), static_cast<int>(level) + 1}) {
        const Wide share = 1 - std::abs(level - of);
        if (share <= 0) continue;
        const int size = 1 << of;
        const Wide x = (static_cast<Wide>(s.receiver.uv.x) * s.map.edge + guard) / size;
        const Wide y = (static_cast<Wide>(s.receiver.uv.y) * s.map.edge + guard) / size;
        nearestFour(x, y, [&](int column, int row, Wide weight) {
            for (int j = 0; j < size; ++j)
                for (int i = 0; i < size; ++i) {
                    all.depths.push_back(
                        casterAt(s, column * size + i - guard, row * size + j - guard));
                    all.weights.push_back(share * weight / (static_cast<Wide>(size) * size));
                }
        });
    }
    return all;
}

/// No sharper than a pixel sees; the receiver's pixel is as long as wide.
Wide mipRadius(const Situation& s) {
    const Wide pixel = glm::length(s.receiver.longestStep) * s.constants.kernel.z;
    return std::max(2 * static_cast<Wide>(s.constants.prefilter.x) / s.map.edge, pixel);
}

Wide chebyshev(Wide mean, Wide variance, Wide depth) {
    if (depth <= mean) return 1;
    return variance / (variance + (depth - mean) * (depth - mean));
}

Wide withoutBleeding(const Situation& s, Wide visibility) {
    const Wide cut = s.parameter("bleeding");
    return unit((visibility - cut) / (1 - cut));
}

Wide variance(const Situation& s, const Distribution& all, Wide depth) {
    const auto z = [](Wide x) { return x; };
    return withoutBleeding(
        s, chebyshev(all.mean(z), std::max(all.variance(z), s.parameter("least_variance")), depth));
}

/// The mean of the bound over boxes side by side, each against the receiver's plane in its middle.
Wide sampledVariance(const Situation& s, Wide depth) {
    const int samples = static_cast<int>(s.parameter("samples"));
    const Wide reach = boxReach(s.constants);
    const Wide middle = 0.5L * s.map.edge;
    const auto z = [](Wide x) { return x; };
    Wide sum = 0;
    for (int row = 0; row < samples; ++row)
        for (int column = 0; column < samples; ++column) {
            const Wide x = (2 * column + 1 - samples) * reach;
            const Wide y = (2 * row + 1 - samples) * reach;
            const Distribution all = underTheBoxes(s, reach, middle + x, middle + y);
            const Wide there =
                std::min(depth + (x * s.receiver.depthGradient.x + y * s.receiver.depthGradient.y) /
                                     s.map.edge,
                         static_cast<Wide>(1));
            sum += chebyshev(all.mean(z), std::max(all.variance(z), s.parameter("least_variance")),
                             there);
        }
    return withoutBleeding(s, sum / (samples * samples));
}

/// The sun's penumbra from the blockers' mean under the widest kernel, which Chebyshev's bound
/// tells apart from the receiver.
Wide varianceSoftShadow(const Situation& s, Wide depth,
                        const std::function<Distribution(Wide radiusUv)>& under) {
    const Wide softness = static_cast<Wide>(s.constants.kernel.x) / s.parameter("distance");
    const Distribution around = under(std::min(softness, static_cast<Wide>(1)));
    const auto z = [](Wide x) { return x; };
    const Wide beyond = depth - around.mean(z);
    Wide gap = 0;
    if (beyond > 0)
        gap = unit(beyond + std::max(around.variance(z), s.parameter("least_variance")) / beyond);
    return variance(s, under(std::min(softness * gap, static_cast<Wide>(1))), depth);
}

Wide exponential(const Situation& s, const Distribution& all, Wide depth) {
    const Wide c = s.parameter("exponent");
    return unit(all.mean([&](Wide z) { return std::exp(c * (z - depth)); }));
}

/// One of the two bounds; a negative exponent warps down.
Wide warped(const Situation& s, const Distribution& all, Wide depth, Wide exponent) {
    const auto warp = [&](Wide z) {
        return std::copysign(std::exp(exponent * (2 * z - 1)), exponent);
    };
    const Wide at = warp(unit(depth));
    const Wide least = 2 * s.parameter("least_deviation") * exponent * at;
    return chebyshev(all.mean(warp), std::max(all.variance(warp), least * least), at);
}

/// The extremal distribution through `depth` of four moments, in central form: its other two points
/// are the roots of the polynomial of degree 2 that is orthogonal to all of degree 1 under the
/// weight (z - depth).
Wide hamburger(const Situation& s, const Distribution& all, Wide depth) {
    const Wide alpha = s.parameter("moment_bias");
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
Wide series(const Situation& s, const Distribution& all, Wide depth) {
    const int terms = static_cast<int>(s.parameter("terms"));
    const auto moved = [](Wide z) { return 0.05L + 0.9L * z; };
    const Wide step = all.mean([&](Wide z) {
        Wide sum = 0.5L;
        for (int k = 1; k <= terms; ++k) {
            const Wide c = std::numbers::pi_v<Wide> * (2 * k - 1);
            const Wide share = static_cast<Wide>(k) / terms;
            sum += 2 * std::exp(-s.parameter("damping") * share * share) *
                   std::sin(c * (moved(z) - moved(std::max(depth, static_cast<Wide>(0))))) / c;
        }
        return sum;
    });
    return unit(step * s.parameter("scale"));
}

struct Layer {
    Wide begin = 0, end = 1;
    Wide operator()(Wide depth) const { return unit((depth - begin) / (end - begin)); }
};

/// Those up to the one that holds the depth.
std::vector<Layer> layersUpTo(const Situation& s, Wide depth) {
    const int count = static_cast<int>(s.parameter("layers"));
    std::vector<Layer> layers;
    Wide begin = 0;
    for (int i = 0; i < count; ++i) {
        layers.push_back({begin, s.constants.layerEnds[i / 4][i % 4]});
        begin = layers.back().end;
        if (depth <= begin) break;
    }
    return layers;
}

Wide layered(const Situation& s, const Distribution& all, Wide depth) {
    if (depth <= 0) return 1;
    Wide bound = 1;
    for (const Layer& layer : layersUpTo(s, depth))
        bound =
            std::min(bound, chebyshev(all.mean(layer),
                                      std::max(all.variance(layer), s.parameter("least_variance")),
                                      layer(depth)));
    return withoutBleeding(s, bound);
}

Wide powerFunction(const Situation& s, const Distribution& all, Wide depth) {
    const Layer layer = layersUpTo(s, depth).back();
    const Wide mean = all.mean(layer);
    const auto [nearest, farthest] = std::minmax_element(all.depths.begin(), all.depths.end());
    const Wide least = layer(*nearest);
    const Wide greatest = layer(*farthest);
    const Wide d = depth <= 0 ? depth : layer(depth);
    if (d <= mean) return 1;
    if (d >= greatest) return 0;
    const Wide beta = (mean - least) / (greatest - mean);
    const Wide t = (d - least) / (greatest - least);
    const Wide m = beta / (beta + 1);
    return unit(std::expm1(beta * std::log(t)) / std::expm1(beta * std::log(m)));
}

std::optional<Wide> filteredVisibility(const Situation& s) {
    const Distribution all = underTheBox(s, boxReach(s.constants));
    // Texel centres to either side that the box touches, and one that the lookup between texels
    // adds.
    const Wide farthest = std::ceil(std::max(boxReach(s.constants) - 0.5L, 0.0L)) + 1;
    const Wide span = s.parameterOr("bias_texels", 0) + s.parameterOr("bias_reaches", 0) * farthest;
    const Wide depth = std::min(static_cast<Wide>(s.receiver.depth), static_cast<Wide>(1)) -
                       s.receiver.depthError - s.parameterOr("bias_depth", 0) -
                       span * s.steepness() / s.map.edge;
    const std::string_view file = s.technique.fileName();
    if (file == "vsm" || file == "vsm_sat") return variance(s, all, depth);
    if (file == "vsm_samples") return sampledVariance(s, depth);
    if (file == "vsm_mip") return variance(s, underTheMips(s, mipRadius(s)), depth);
    if (file == "pcss_mip")
        return varianceSoftShadow(s, depth, [&](Wide radius) { return underTheMips(s, radius); });
    if (file == "pcss_sat")
        return varianceSoftShadow(s, depth, [&](Wide radius) {
            return underTheBox(s, radius * std::numbers::sqrt3_v<Wide> / 2 * s.map.edge);
        });
    if (file == "esm") return exponential(s, all, depth);
    if (file == "evsm2") return warped(s, all, depth, s.parameter("positive_exponent"));
    if (file == "evsm4")
        return std::min(warped(s, all, depth, s.parameter("positive_exponent")),
                        warped(s, all, depth, -s.parameter("negative_exponent")));
    if (file == "msm" || file == "msm16") return hamburger(s, all, depth);
    if (file == "csm") return series(s, all, depth);
    if (file == "lvsm") return layered(s, all, depth);
    if (file == "power_cdf") return powerFunction(s, all, depth);
    return std::nullopt;
}

// --- Depth maps: sums of compares ---

Wide kernelRadius(const Situation& s) {
    return std::min(static_cast<Wide>(s.constants.kernel.x), static_cast<Wide>(1));
}

/// Share of light in a texel: its depth against the receiver's plane there.
Wide compared(const Situation& s, int column, int row) {
    if (!s.inside(column, row)) return 1;
    const Wide n = s.map.edge;
    const Wide along = (column + 0.5L) / n - s.receiver.uv.x;
    const Wide across = (row + 0.5L) / n - s.receiver.uv.y;
    const Wide plane =
        s.receiver.depth - s.receiver.depthError -
        (s.parameter("bias_texels") / n + s.parameterOr("bias_reaches", 0) * kernelRadius(s)) *
            s.steepness() +
        s.receiver.depthGradient.x * along + s.receiver.depthGradient.y * across;
    return static_cast<Wide>(s.stored(column, row)) < std::min(plane, static_cast<Wide>(1)) ? 0 : 1;
}

using Sample = std::function<Wide(int column, int row)>;

Wide bilinear(const Situation& s, Wide u, Wide v, const Sample& sample) {
    Wide sum = 0;
    nearestFour(u * s.map.edge, v * s.map.edge,
                [&](int i, int j, Wide weight) { sum += weight * sample(i, j); });
    return sum;
}

Wide tapAt(const Situation& s, Wide u, Wide v) {
    if (s.parameter("bilinear") != 0)
        return bilinear(s, u, v, [&](int i, int j) { return compared(s, i, j); });
    return compared(s, static_cast<int>(std::floor(u * s.map.edge)),
                    static_cast<int>(std::floor(v * s.map.edge)));
}

Wide grid(const Situation& s) {
    const int n = static_cast<int>(s.parameter("samples"));
    const bool gaussian = s.parameter("gaussian") != 0;
    const Wide half = gaussian ? 1.25L : std::numbers::sqrt3_v<Wide> / 2;
    Wide lit = 0;
    Wide total = 0;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const Wide x = ((2 * i + 1.0L) / n - 1) * half;
            const Wide y = ((2 * j + 1.0L) / n - 1) * half;
            const Wide weight = gaussian ? std::exp(-2 * (x * x + y * y)) : 1;
            lit += weight * tapAt(s, s.receiver.uv.x + x * kernelRadius(s),
                                  s.receiver.uv.y + y * kernelRadius(s));
            total += weight;
        }
    return lit / total;
}

struct Place {
    Wide x, y;
};

Place vogel(int i, int n) {
    const Wide angle = i * 2.3999632297286533L;
    const Wide radius = std::sqrt((i + 0.5L) / n);
    return {radius * std::cos(angle), radius * std::sin(angle)};
}

Place poisson(int i) {
    const renderer::f64::real2 tap = renderer::f64::poissonTap(i);  // a table
    return {tap.x, tap.y};
}

Wide taps(const Situation& s) {
    const int n = static_cast<int>(s.parameter("taps"));
    Wide lit = 0;
    for (int i = 0; i < n; ++i) {
        const Place tap = s.parameter("pattern") == 0 ? poisson(i) : vogel(i, n);
        lit += tapAt(s, s.receiver.uv.x + tap.x * kernelRadius(s),
                     s.receiver.uv.y + tap.y * kernelRadius(s));
    }
    return lit / n;
}

/// Every texel by the share of it that the disc covers.
Wide disc(const Situation& s, Wide radiusUv) {
    const auto radius = static_cast<double>(radiusUv * s.map.edge);
    const int middle = s.map.edge / 2;
    if (radius < 1.0 / 64) return compared(s, middle, middle);
    double occluded = 0;
    for (int row = 0; row < s.map.edge; ++row)
        for (int column = 0; column < s.map.edge; ++column)
            if (compared(s, column, row) == 0)
                occluded += exactCoverage(column + 0.5 - s.receiver.uv.x * s.map.edge,
                                          row + 0.5 - s.receiver.uv.y * s.map.edge, radius);
    return unit(1 - occluded / (std::numbers::pi * radius * radius));
}

/// In distances from the sun: the penumbra is as wide as the blockers are before the receiver.
Wide softShadow(const Situation& s) {
    const Wide softness = static_cast<Wide>(s.constants.kernel.x) / s.parameter("distance");
    const Wide n = s.map.edge;
    const Wide search = std::clamp(softness * s.receiver.depth, 0.5L / n, 1.0L);
    const int count = static_cast<int>(s.parameter("search_taps"));
    Wide gaps = 0;
    int blockers = 0;
    for (int i = 0; i < count; ++i) {
        const Place tap = vogel(i, count);
        const int column = static_cast<int>(std::floor((s.receiver.uv.x + tap.x * search) * n));
        const int row = static_cast<int>(std::floor((s.receiver.uv.y + tap.y * search) * n));
        if (!s.inside(column, row) || compared(s, column, row) != 0) continue;
        const Wide plane = s.receiver.depth - s.receiver.depthError -
                           s.parameter("bias_texels") * s.steepness() / n +
                           s.receiver.depthGradient.x * ((column + 0.5L) / n - s.receiver.uv.x) +
                           s.receiver.depthGradient.y * ((row + 0.5L) / n - s.receiver.uv.y);
        const Wide gap = std::min(plane, static_cast<Wide>(1)) - caster(s.stored(column, row));
        if (gap <= 0) continue;
        gaps += gap;
        ++blockers;
    }
    if (blockers == 0) return 1;
    return disc(s, std::min(softness * gaps / blockers, static_cast<Wide>(1)));
}

/// Depth between texels.
Wide depthAt(const Situation& s, Wide u, Wide v) {
    return bilinear(s, u, v, [&](int i, int j) { return casterAt(s, i, j); });
}

/// Each texel's own slope, to the neighbour that is nearer in depth, between texels.
Place storedSlope(const Situation& s) {
    const auto at = [&](int i, int j) { return casterAt(s, i, j); };
    const auto smaller = [](Wide a, Wide b) { return std::abs(a) < std::abs(b) ? a : b; };
    const Wide u = s.receiver.uv.x;
    const Wide v = s.receiver.uv.y;
    const Wide n = s.map.edge;
    return {n * bilinear(s, u, v,
                         [&](int i, int j) {
                             return smaller(at(i + 1, j) - at(i, j), at(i, j) - at(i - 1, j));
                         }),
            n * bilinear(s, u, v, [&](int i, int j) {
                return smaller(at(i, j + 1) - at(i, j), at(i, j) - at(i, j - 1));
            })};
}

Place slopeOfTheMap(const Situation& s, const std::vector<Place>& taps, Wide radius) {
    const Wide u = s.receiver.uv.x;
    const Wide v = s.receiver.uv.y;
    const Wide texel = 1.0L / s.map.edge;
    if (s.parameter("gradient") == 0)
        return {(depthAt(s, u + texel, v) - depthAt(s, u - texel, v)) / (2 * texel),
                (depthAt(s, u, v + texel) - depthAt(s, u, v - texel)) / (2 * texel)};
    Wide xx = 0, xy = 0, yy = 0, xz = 0, yz = 0;
    for (const Place& tap : taps) {
        const Wide rise = depthAt(s, u + tap.x * radius, v + tap.y * radius) - depthAt(s, u, v);
        xx += tap.x * tap.x;
        xy += tap.x * tap.y;
        yy += tap.y * tap.y;
        xz += tap.x * rise;
        yz += tap.y * rise;
    }
    const Wide determinant = (xx * yy - xy * xy) * radius;
    return {(yy * xz - xy * yz) / determinant, (xx * yz - xy * xz) / determinant};
}

Wide gradientShadow(const Situation& s) {
    const Wide texel = 1.0L / s.map.edge;
    const Wide radius = std::max(kernelRadius(s), texel / 2);
    std::vector<Place> taps;
    const int pattern = static_cast<int>(s.parameter("pattern"));
    const int n = pattern == 1 ? 8 : (pattern == 2 ? 16 : static_cast<int>(s.parameter("taps")));
    for (int i = 0; i < n; ++i) {
        const Wide angle = std::numbers::pi_v<Wide> / 4 * i;
        taps.push_back(pattern == 0   ? vogel(i, n)
                       : pattern == 1 ? Place{std::cos(angle) / std::numbers::sqrt2_v<Wide>,
                                              std::sin(angle) / std::numbers::sqrt2_v<Wide>}
                                      : poisson(i));
    }
    Place g{s.receiver.depthGradient.x, s.receiver.depthGradient.y};
    const auto within = [&](Wide x) { return x > radius + texel && x < 1 - radius - texel; };
    bool ofTheMap = true;
    if (s.technique.fileName() == "gsm_stored")
        g = storedSlope(s);
    else if (s.parameter("gradient") != 2 && within(s.receiver.uv.x) && within(s.receiver.uv.y))
        g = slopeOfTheMap(s, taps, radius);
    else
        ofTheMap = false;
    const Wide size = std::hypot(g.x, g.y);
    const Wide most = ofTheMap ? s.parameter("most_slope") : size;
    const Wide cut = size > 0 ? std::min(size, most) / size : 0;
    g = {g.x * cut, g.y * cut};
    const Wide slope = size * cut * texel;
    const Wide depth = std::min(static_cast<Wide>(s.receiver.depth), static_cast<Wide>(1)) -
                       s.receiver.depthError - s.parameter("bias") * slope;
    Wide lit = 0;
    for (const Place& tap : taps) {
        const Wide follow =
            s.parameterOr("offsets", 1) != 0 ? radius * (tap.x * g.x + tap.y * g.y) : 0;
        const Wide above =
            depthAt(s, s.receiver.uv.x + tap.x * radius, s.receiver.uv.y + tap.y * radius) -
            std::min(depth + follow, static_cast<Wide>(1));
        lit += slope > 0 ? unit(1 + above / slope) : (above < 0 ? 0 : 1);
    }
    return lit / static_cast<Wide>(taps.size());
}

}  // namespace

Distribution depthsUnderTheKernel(const Technique& technique, const DepthMap& map,
                                  const Receiver& receiver, const Constants& constants) {
    const Situation s{technique, map, receiver, constants};
    const Wide reach = boxReach(constants);
    const Wide x = static_cast<Wide>(receiver.uv.x) * map.edge;
    const Wide y = static_cast<Wide>(receiver.uv.y) * map.edge;
    if (technique.prefilter == renderer::Prefilter::mips) return underTheMips(s, mipRadius(s));
    if (technique.prefilter == renderer::Prefilter::sums) return underTheWidth(s, reach, x, y);
    const int samples = static_cast<int>(s.parameterOr("samples", 1));
    Distribution all;
    for (int row = 0; row < samples; ++row)
        for (int column = 0; column < samples; ++column)
            add(all,
                underTheBoxes(s, reach, x + (2 * column + 1 - samples) * reach,
                              y + (2 * row + 1 - samples) * reach),
                1.0L / (samples * samples));
    return all;
}

std::optional<long double> exactVisibility(const Technique& technique, const DepthMap& map,
                                           const Receiver& receiver, const Constants& constants) {
    const Situation s{technique, map, receiver, constants};
    const std::string_view file = technique.fileName();
    if (file == "gsm" || file == "gsm_stored") return gradientShadow(s);
    if (technique.prefilter != renderer::Prefilter::none) return filteredVisibility(s);
    if (file == "hard") return compared(s, map.edge / 2, map.edge / 2);
    if (file == "pcf_disc") return disc(s, kernelRadius(s));
    if (file == "pcf_grid") return grid(s);
    if (file == "pcf_taps") return taps(s);
    if (file == "pcss") return softShadow(s);
    return std::nullopt;
}

}  // namespace tests

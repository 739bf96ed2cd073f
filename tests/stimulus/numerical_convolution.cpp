// SPDX-License-Identifier: MIT
#include "numerical_convolution.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace numerical {
namespace {

using std::numbers::pi;
using stimulus::KernelShape;
using stimulus::Pattern;

constexpr int kNodes = 24;

struct Rule {
    std::array<double, kNodes> node, weight;
};

/// Gauss-Legendre nodes as roots of P_n by Newton's method (Numerical Recipes' textbook way).
Rule gaussLegendre() {
    Rule rule{};
    for (int i = 0; i < kNodes; ++i) {
        double x = std::cos(pi * (i + 0.75) / (kNodes + 0.5)), slope = 1;
        for (int iteration = 0; iteration < 20; ++iteration) {
            double before = 1, p = x;
            for (int n = 2; n <= kNodes; ++n) {
                const double next = ((2 * n - 1) * x * p - (n - 1) * before) / n;
                before = p;
                p = next;
            }
            slope = kNodes * (x * p - before) / (x * x - 1);
            x -= p / slope;
        }
        rule.node[static_cast<std::size_t>(i)] = x;
        rule.weight[static_cast<std::size_t>(i)] = 2 / ((1 - x * x) * slope * slope);
    }
    return rule;
}

template <typename Function>
double integral(double low, double high, Function f) {
    static const Rule rule = gaussLegendre();
    const double middle = (low + high) / 2, half = (high - low) / 2;
    double sum = 0;
    for (std::size_t i = 0; i < kNodes; ++i)
        sum += rule.weight[i] * f(middle + half * rule.node[i]);
    return half * sum;
}

template <typename Function>
double integral(std::vector<double> cuts, Function f) {
    std::sort(cuts.begin(), cuts.end());
    double sum = 0;
    for (std::size_t i = 1; i < cuts.size(); ++i) sum += integral(cuts[i - 1], cuts[i], f);
    return sum;
}

double standardNormal(double t) {
    return std::exp(-t * t / 2) / std::sqrt(2 * pi);
}

/// Mass of the standard normal above t, by integration of its density.
double normalAbove(double t) {
    if (t < 0) return 1 - normalAbove(-t);
    double mass = 0;
    for (double low = t; low < 12; low += 0.5) mass += integral(low, low + 0.5, standardNormal);
    return mass;
}

/// Where a kernel begins and ends along x, radii; the Gaussian's sigma is 1/2.
double extent(KernelShape shape) {
    return shape == KernelShape::gaussian ? 5 : 1;
}

/// Density of column z of the kernel, and the share of that column above w.
double columnAbove(KernelShape shape, double z, double w) {
    if (shape == KernelShape::gaussian) return 2 * standardNormal(2 * z) * normalAbove(2 * w);
    const double half = shape == KernelShape::box ? 1 : std::sqrt(std::max(0.0, 1 - z * z));
    const double above = std::clamp(half - w, 0.0, 2 * half);
    return shape == KernelShape::box ? above / 4 : above / pi;
}

/// The z in (low, high) where the edge's height w(z), straight there, enters or leaves the kernel.
void addCrossings(KernelShape shape, double low, double high,
                  const std::function<double(double)>& w, std::vector<double>& cuts) {
    if (shape == KernelShape::gaussian) return;
    const auto outside = [&](double z) {
        return shape == KernelShape::box ? std::abs(w(z)) - 1 : z * z + w(z) * w(z) - 1;
    };
    constexpr int pieces = 64;
    for (int i = 0; i < pieces; ++i) {
        double a = low + (high - low) * i / pieces, b = low + (high - low) * (i + 1) / pieces;
        if (outside(a) * outside(b) > 0) continue;
        for (int k = 0; k < 60; ++k)
            ((outside(a) * outside((a + b) / 2) <= 0) ? b : a) = (a + b) / 2;
        cuts.push_back((a + b) / 2);
    }
}

/// Integral over the kernel's columns between two places. For the disc z = sin(angle) takes the
/// square root out of the columns' lengths.
double massAbove(KernelShape shape, double low, double high,
                 const std::function<double(double)>& w) {
    std::vector<double> cuts{low, high};
    addCrossings(shape, low, high, w, cuts);
    if (shape == KernelShape::disc) {
        for (double& cut : cuts) cut = std::asin(cut);
        return integral(cuts, [&](double angle) {
            return columnAbove(shape, std::sin(angle), w(std::sin(angle))) * std::cos(angle);
        });
    }
    if (shape == KernelShape::gaussian)
        for (double z = std::ceil(low * 2) / 2; z < high; z += 0.5)
            if (z > low) cuts.push_back(z);
    return integral(cuts, [&](double z) { return columnAbove(shape, z, w(z)); });
}

}  // namespace

EdgeCurve artifactCurve(const stimulus::SilhouetteOptions& o) {
    const double a = o.artifactPx, phase = o.verticalPhasePx;
    const double width = o.pattern == Pattern::step ? o.riserSpacingPx : a;
    const double slope = std::tan(o.angleDeg * pi / 180);
    const auto height = [=](double x) {
        const double column = std::floor(x / width);
        if (o.pattern == Pattern::stair) return a * column + phase;
        if (o.pattern == Pattern::step) return a * column + a / 2 + phase;
        return a * std::round(slope * (column + 0.5)) + phase;  // no ties at the angles tested
    };
    const auto bends = [=](double low, double high) {
        std::vector<double> at;
        for (double x = std::ceil(low / width) * width; x < high; x += width)
            if (x > low) at.push_back(x);
        return at;
    };
    return {height, bends};
}

EdgeCurve straightCurve(const stimulus::SilhouetteOptions& o) {
    const double a = o.artifactPx, phase = o.verticalPhasePx;
    double slope = 1, intercept = -a / 2;
    if (o.pattern == Pattern::step) slope = a / o.riserSpacingPx, intercept = 0;
    if (o.pattern == Pattern::line) slope = std::tan(o.angleDeg * pi / 180), intercept = 0;
    return {[=](double x) { return slope * x + intercept + phase; },
            [](double, double) { return std::vector<double>{}; }};
}

double visibility(const EdgeCurve& edge, const stimulus::Kernel& kernel, double x, double y) {
    const double r = kernel.radiusPx, end = extent(kernel.shape);
    std::vector<double> cuts{-end, end};
    for (const double bend : edge.bends(x - end * r, x + end * r)) cuts.push_back((bend - x) / r);
    std::sort(cuts.begin(), cuts.end());
    double mass = 0;
    for (std::size_t i = 1; i < cuts.size(); ++i) {
        const double low = cuts[i - 1], high = cuts[i], middle = (low + high) / 2;
        if (edge.bends(0, 1e3).empty())
            mass += massAbove(kernel.shape, low, high,
                              [&](double z) { return (edge.height(x + z * r) - y) / r; });
        else  // level between bends; taken in the middle, where rounding at the bends does no harm
            mass += massAbove(kernel.shape, low, high,
                              [w = (edge.height(x + middle * r) - y) / r](double) { return w; });
    }
    return mass;
}

double quadrantMass(KernelShape shape, double u, double v) {
    const double end = extent(shape);
    const double high = std::clamp(u, -end, end);
    if (high <= -end) return 0;
    const double all = massAbove(shape, -end, high, [](double) { return -1e3; });
    return all - massAbove(shape, -end, high, [v](double) { return v; });
}

}  // namespace numerical

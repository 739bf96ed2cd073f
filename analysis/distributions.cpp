// SPDX-License-Identifier: MIT
#include "analysis/distributions.h"

#include <cmath>
#include <limits>

namespace analysis {
namespace {

constexpr double kTiny = 1e-300;
constexpr double kPrecision = 1e-16;
constexpr int kMaxTerms = 100000;  // the fractions need about sqrt(max(a, b)) of them

double betaContinuedFraction(double a, double b, double x) {
    const auto away = [](double v) { return std::abs(v) < kTiny ? kTiny : v; };
    double c = 1.0;
    double d = 1.0 / away(1.0 - (a + b) * x / (a + 1.0));
    double fraction = d;
    for (int m = 1; m <= kMaxTerms; ++m) {
        const double even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
        d = 1.0 / away(1.0 + even * d);
        c = away(1.0 + even / c);
        fraction *= d * c;
        const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
        d = 1.0 / away(1.0 + odd * d);
        c = away(1.0 + odd / c);
        fraction *= d * c;
        if (std::abs(d * c - 1.0) < kPrecision) break;
    }
    return fraction;
}

double gammaSeries(double a, double x) {
    double term = 1.0 / a;
    double sum = term;
    for (int n = 1; n <= kMaxTerms && term > sum * kPrecision; ++n) {
        term *= x / (a + n);
        sum += term;
    }
    return sum * std::exp(a * std::log(x) - x - std::lgamma(a));
}

double gammaContinuedFraction(double a, double x) {
    double b = x + 1.0 - a;
    double c = 1.0 / kTiny;
    double d = 1.0 / b;
    double fraction = d;
    for (int n = 1; n <= kMaxTerms; ++n) {
        const double term = n * (a - n);
        b += 2.0;
        d = term * d + b;
        d = 1.0 / (std::abs(d) < kTiny ? kTiny : d);
        c = b + term / c;
        if (std::abs(c) < kTiny) c = kTiny;
        fraction *= d * c;
        if (std::abs(d * c - 1.0) < kPrecision) break;
    }
    return fraction * std::exp(a * std::log(x) - x - std::lgamma(a));
}

// The point in [low, high] where `rising` crosses `target`, to the last bit that bisection reaches.
template <typename F>
double crossing(F rising, double target, double low, double high) {
    for (int i = 0; i < 2000; ++i) {
        const double middle = low + (high - low) / 2;
        if (middle <= low || middle >= high) break;
        (rising(middle) < target ? low : high) = middle;
    }
    return low + (high - low) / 2;
}

}  // namespace

double normalCdf(double z) {
    return 0.5 * std::erfc(-z / std::sqrt(2.0));
}

double normalQuantile(double p) {
    if (p > 0.5) return -normalQuantile(1.0 - p);
    return crossing([](double z) { return normalCdf(z); }, p, -40.0, 1.0);
}

double incompleteBeta(double a, double b, double x) {
    if (x <= 0) return 0;
    if (x >= 1) return 1;
    const double front = std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) +
                                  a * std::log(x) + b * std::log1p(-x));
    if (x < (a + 1.0) / (a + b + 2.0)) return front * betaContinuedFraction(a, b, x) / a;
    return 1.0 - front * betaContinuedFraction(b, a, 1.0 - x) / b;
}

double studentCdf(double t, double df) {
    if (std::isinf(df)) return normalCdf(t);
    const double tail = 0.5 * incompleteBeta(df / 2, 0.5, df / (df + t * t));
    return t > 0 ? 1.0 - tail : tail;
}

double studentQuantile(double p, double df) {
    if (p > 0.5) return -studentQuantile(1.0 - p, df);
    double low = -2.0;
    while (studentCdf(low, df) > p && low > -1e15) low *= 2;
    return crossing([df](double t) { return studentCdf(t, df); }, p, low, 1.0);
}

double chiSquaredSurvival(double x, double df) {
    if (!(x > 0)) return 1;
    const double a = df / 2;
    if (x / 2 < a + 1) return 1.0 - gammaSeries(a, x / 2);
    return gammaContinuedFraction(a, x / 2);
}

}  // namespace analysis

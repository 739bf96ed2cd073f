// SPDX-License-Identifier: MIT
#include "tests/quest/slow_quest.h"

#include <cmath>

namespace slow {
namespace {

double weibullCurve(double u, const quest::QuestParameters& p) {
    return p.delta * p.gamma +
           (1 - p.delta) * (1 - (1 - p.gamma) * std::exp(-std::pow(10.0, p.beta * u)));
}

struct Points {
    std::vector<double> x, y;
};

double interpolate(const Points& points, double y) {
    std::size_t k = 1;
    while (k + 1 < points.y.size() && points.y[k] < y) ++k;
    return points.x[k - 1] + (y - points.y[k - 1]) / (points.y[k] - points.y[k - 1]) *
                                 (points.x[k] - points.x[k - 1]);
}

void normalise(std::vector<double>& pdf) {
    double sum = 0;
    for (const double v : pdf) sum += v;
    for (double& v : pdf) v /= sum;
}

}  // namespace

Quest::Quest(const quest::QuestParameters& parameters) : p(parameters) {
    if (p.gamma > p.pThreshold) p.gamma = 0.5;
    if (p.range) intervals = 2 * std::lround(std::ceil(*p.range / p.grain / 2));
    for (long j = 0; j <= intervals; ++j) {
        const double u = double(j - intervals / 2) * p.grain;
        t.push_back(p.priorMean + u);
        pdf.push_back(std::exp(-std::pow(u / p.priorSd, 2) / 2));
    }
    normalise(pdf);

    Points rising;
    for (long k = 0; k < 2 * intervals; ++k) {
        const double u = double(k - intervals) * p.grain;
        if (weibullCurve(u + p.grain, p) > weibullCurve(u, p)) {
            rising.x.push_back(u);
            rising.y.push_back(weibullCurve(u, p));
        }
    }
    eps = interpolate(rising, p.pThreshold);
    for (long k = 0; k <= 2 * intervals; ++k) {
        curve.push_back(weibullCurve(double(k - intervals) * p.grain + eps, p));
    }

    const double pL = curve.front(), pH = curve.back(), e = 2.2e-16;
    const double sum = pH * std::log(pH + e) - pL * std::log(pL + e) +
                       (1 - pH + e) * std::log(1 - pH + e) - (1 - pL + e) * std::log(1 - pL + e);
    const double z = 1 / (1 + std::exp(sum / (pL - pH)));
    order = (z - pL) / (pH - pL);
}

void Quest::update(double x, int response) {
    const double steps = (x - p.priorMean) / p.grain;
    const long k = long(steps < 0 ? std::ceil(steps - 0.5) : std::floor(steps + 0.5));
    std::vector<long> index;
    for (long j = 0; j <= intervals; ++j) index.push_back(intervals + k - (j - intervals / 2));
    long shift = 0;
    if (index.back() < 0) shift = -index.back();
    if (index.front() > 2 * intervals) shift = 2 * intervals - index.front();
    for (std::size_t j = 0; j < index.size(); ++j) {
        const double yes = curve[std::size_t(index[j] + shift)];
        pdf[j] *= response == 1 ? yes : 1 - yes;
    }
    normalise(pdf);
}

double Quest::quantile(double quantileOrder) const {
    Points rising;
    double sum = 0, last = -1;
    for (std::size_t j = 0; j < pdf.size(); ++j) {
        sum += pdf[j];
        if (sum > last) {
            rising.x.push_back(t[j]);
            rising.y.push_back(sum);
        }
        last = sum;
    }
    if (quantileOrder * sum <= rising.y.front()) return t.front();
    return interpolate(rising, quantileOrder * sum);
}

double Quest::mean() const {
    double result = 0;
    for (std::size_t j = 0; j < pdf.size(); ++j) result += pdf[j] * t[j];
    return result;
}

double Quest::sd() const {
    const double m = mean();
    double result = 0;
    for (std::size_t j = 0; j < pdf.size(); ++j) result += pdf[j] * (t[j] - m) * (t[j] - m);
    return std::sqrt(result);
}

}  // namespace slow

// SPDX-License-Identifier: MIT
// Who is left out of a study's slope, by rules that stand before anybody has answered: the window
// says so at a session's end, the fit acts by it.
//
//   yes/no  the lower bound of the false-alarm rate on reference trials is above falseAlarmRate; or
//           there is no reference trial, so that the rate is unknown
//   2AFC    more than catchFailureShare of the catch trials were answered wrong
#pragma once

#include <string>

namespace quest {

struct ScreeningLimits {
    double falseAlarmRate = 0.10;     ///< yes/no: that the lower bound may reach, [0, 1]
    double catchFailureShare = 0.20;  ///< 2AFC: of the catch trials, [0, 1]
    bool operator==(const ScreeningLimits&) const = default;
};

/// Of the bound of the false-alarm rate: one-sided.
inline constexpr double kScreeningConfidence = 0.95;

/// Lower end of the exact one-sided interval for a rate of which `events` in `n` were seen
/// (C. J. Clopper and E. S. Pearson, Biometrika 26, 1934): the rate at which so many or more events
/// have probability 1 - confidence. 0 for no event. events <= n, confidence in [.5, 1).
double rateLowerBound(int events, int n, double confidence = kScreeningConfidence);

/// Why an observer of a yes/no task is left out; empty where they stay.
std::string falseAlarmProblem(int falseAlarms, int references, const ScreeningLimits& limits,
                              double confidence = kScreeningConfidence);
/// The same for 2AFC. Without a catch trial they stay.
std::string catchProblem(int failures, int catchTrials, const ScreeningLimits& limits);

}  // namespace quest

// SPDX-License-Identifier: MIT
#include "study_app/session_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string_view>

#include "quest/quest.h"

namespace study_app {
namespace {

using Row = std::vector<std::string>;

template <typename... Values>
std::string formatted(const char* format, Values... values) {
    char text[160];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

struct MeanAndSd {
    double mean = 0, sd = 0;
};

MeanAndSd meanAndSd(const std::vector<double>& values) {
    const auto n = static_cast<double>(values.size());
    double sum = 0, squares = 0;
    for (const double v : values) sum += v;
    for (const double v : values) squares += (v - sum / n) * (v - sum / n);
    return {sum / n, n > 1 ? std::sqrt(squares / (n - 1)) : 0};
}

}  // namespace

std::string aligned(const std::vector<Row>& rows) {
    std::vector<std::size_t> width(rows.front().size());
    for (const Row& row : rows) {
        for (std::size_t i = 0; i < row.size(); ++i) width[i] = std::max(width[i], row[i].size());
    }
    std::string text;
    for (const Row& row : rows) {
        for (std::size_t i = 0; i < row.size(); ++i) {
            const std::string padding(width[i] - row[i].size(), ' ');
            text += i == 0 ? row[i] + padding : "  " + padding + row[i];
        }
        text += "\n";
    }
    return text;
}

std::string thresholdTable(const Session& session, const SimulatedParticipant* participant) {
    std::vector<Row> rows{{"condition", "trials", "x0", "sd", "c", "radius px"}};
    if (participant != nullptr) rows[0].push_back("true c");
    const std::vector<Threshold> results = thresholds(session);
    for (std::size_t k = 0; k < results.size(); ++k) {
        const Threshold& t = results[k];
        rows.push_back({t.condition, std::to_string(t.trials), formatted("%.3f", t.mean),
                        formatted("%.3f", t.sd), formatted("%.3f", t.c),
                        formatted("%.2f", t.radiusPx)});
        if (participant != nullptr) {
            rows.back().push_back(formatted("%.3f", trueSlope(*participant, k)));
        }
    }
    return aligned(rows);
}

std::string contextLine(const Session& session) {
    const Design& design = session.design();
    const quest::QuestParameters staircase = staircaseParameters(design);
    return formatted("%zu of %zu trials, %d of them catch trials (%d failed); ", session.answered(),
                     session.total(), session.catchAnswered(), session.catchFailed()) +
           formatted("c = r / a at criterion F* = %.4g, task %s, encoding %s, beta %g",
                     quest::criterion(staircase), std::string(records::toText(design.task)).c_str(),
                     std::string(records::toText(design.encoding)).c_str(), staircase.beta);
}

std::string studyTable(const std::vector<SimulatedSession>& sessions) {
    std::vector<Row> rows{{"condition", "observers", "mean c", "sd log10 c", "true mean c"}};
    const std::vector<Condition>& conditions = sessions.front().session.conditions();
    for (std::size_t k = 0; k < conditions.size(); ++k) {
        std::vector<double> measured, real;
        for (const SimulatedSession& s : sessions) {
            measured.push_back(-s.session.staircase(k).mean());
            real.push_back(-s.observer.threshold[k]);
        }
        const MeanAndSd log10c = meanAndSd(measured);
        rows.push_back({conditions[k].name, std::to_string(sessions.size()),
                        formatted("%.3f", std::pow(10, log10c.mean)), formatted("%.3f", log10c.sd),
                        formatted("%.3f", std::pow(10, meanAndSd(real).mean))});
    }
    return aligned(rows);
}

}  // namespace study_app

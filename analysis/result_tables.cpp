// SPDX-License-Identifier: MIT
#include "analysis/result_tables.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "analysis/estimators.h"
#include "analysis/number_text.h"
#include "analysis/observer_slopes.h"

namespace analysis {
namespace {

using Row = std::vector<std::string>;

constexpr const char* kUnknown = "n/a";
constexpr std::size_t kScreeningRows = 40;  // in the report, chosen by eye

std::string full(double value) {
    char text[64];
    std::snprintf(text, sizeof text, "%.8g", value);
    return text;
}

std::string full(const std::optional<double>& value) {
    return value ? full(*value) : kUnknown;
}

std::string rounded(const std::optional<double>& value, int decimals) {
    return value ? fixedText(*value, decimals) : kUnknown;
}

// The threshold radius of a condition, px.
std::optional<double> radiusOf(const SlopeAnalysis& analysis, std::size_t condition) {
    const ConditionResult& result = analysis.conditions[condition];
    if (!result.c) return std::nullopt;
    return std::pow(10.0, result.c->value) * analysis.study.conditions[condition].artifactPx;
}

std::optional<double> inDegrees(const Study& study, const std::optional<double>& px) {
    if (!px.has_value() || !study.pxPerDeg.has_value()) return std::nullopt;
    return px.value() / study.pxPerDeg.value();
}

// c, low, high.
void appendSlope(Row& row, const std::optional<double>& log10c,
                 const std::optional<records::Interval>& ci95) {
    row.push_back(log10c ? full(std::pow(10.0, *log10c)) : kUnknown);
    row.push_back(ci95 ? full(std::pow(10.0, ci95->low)) : kUnknown);
    row.push_back(ci95 ? full(std::pow(10.0, ci95->high)) : kUnknown);
}

TextTable groupFile(const SlopeAnalysis& analysis) {
    TextTable table{.name = "groups",
                    .caption = "",
                    .head = {"group", "pattern", "angle_deg", "lit_level", "observers", "trials",
                             "c", "c_low", "c_high", "df", "two_stage_c", "two_stage_low",
                             "two_stage_high", "censored", "through_origin_c", "flag"},
                    .rows = {}};
    for (std::size_t g = 0; g < analysis.groups.size(); ++g) {
        const Group& group = analysis.study.groups[g];
        const GroupResult& result = analysis.groups[g];
        Row row = {group.name,
                   std::string(records::toText(group.pattern)),
                   full(group.angleDeg),
                   full(group.litLevel),
                   std::to_string(result.observers),
                   std::to_string(result.trials)};
        appendSlope(row, result.c.value, result.c.ci95());
        row.push_back(result.c.degreesOfFreedom > 0 ? full(result.c.degreesOfFreedom) : kUnknown);
        appendSlope(row, result.twoStage.log10c, result.twoStage.ci95);
        row.push_back(std::to_string(result.twoStage.censored));
        row.push_back(full(result.lines.throughOrigin));
        row.push_back(result.flag.empty() ? kUnknown : result.flag);
        table.rows.push_back(row);
    }
    return table;
}

TextTable conditionFile(const SlopeAnalysis& analysis, const ReferenceSizes& reference) {
    TextTable table{.name = "conditions",
                    .caption = "",
                    .head = {"group", "artifact_px", "angle_deg", "observers", "trials", "c",
                             "c_low", "c_high", "radius_px", "artifact_deg", "radius_deg",
                             "reference_half_code_px", "reference_one_code_px", "flag"},
                    .rows = {}};
    for (std::size_t k = 0; k < analysis.conditions.size(); ++k) {
        const Condition& condition = analysis.study.conditions[k];
        const ConditionResult& result = analysis.conditions[k];
        Row row = {analysis.study.groups[condition.group].name, full(condition.artifactPx),
                   full(condition.angleDeg), std::to_string(result.observers),
                   std::to_string(result.trials)};
        const auto log10c = result.c ? std::optional(result.c->value) : std::nullopt;
        appendSlope(row, log10c, result.c ? result.c->ci95() : std::nullopt);
        const std::optional<double> radius = radiusOf(analysis, k);
        row.push_back(full(radius));
        row.push_back(full(inDegrees(analysis.study, condition.artifactPx)));
        row.push_back(full(inDegrees(analysis.study, radius)));
        const auto size = referenceSize(reference, analysis.study, k);
        row.push_back(full(size ? size->halfCode : std::nullopt));
        row.push_back(full(size ? size->oneCode : std::nullopt));
        row.push_back(result.flag.empty() ? kUnknown : result.flag);
        table.rows.push_back(row);
    }
    return table;
}

TextTable thresholdFile(const SlopeAnalysis& analysis) {
    TextTable table{.name = "thresholds",
                    .caption = "",
                    .head = {"participant", "group", "artifact_px", "trials", "yes", "c",
                             "radius_px", "log10_c", "log10_c_se", "state"},
                    .rows = {}};
    for (const CellThreshold& cell : analysis.thresholds) {
        const Condition& condition = analysis.study.conditions[cell.condition];
        const bool has = cell.state == ThresholdState::estimated;
        const auto ifHas = [has](double value) { return has ? full(value) : kUnknown; };
        table.rows.push_back({analysis.study.observers[cell.observer].id,
                              analysis.study.groups[condition.group].name,
                              full(condition.artifactPx), std::to_string(cell.trials),
                              std::to_string(cell.yes), ifHas(std::pow(10.0, cell.log10c)),
                              ifHas(cell.radiusPx), ifHas(cell.log10c), ifHas(cell.standardError),
                              toText(cell.state)});
    }
    return table;
}

TextTable observerFile(const SlopeAnalysis& analysis) {
    TextTable table{.name = "observers",
                    .caption = "",
                    .head = {"participant", "conditions", "censored", "worst_group_c", "c_low",
                             "c_high", "worst_group_c_shrunken"},
                    .rows = {}};
    const std::vector<ObserverSlope> slopes = observerSlopes(analysis);
    const double mean = analysis.slope.headline.value;
    for (std::size_t i = 0; i < slopes.size(); ++i) {
        const ObserverSlope& slope = slopes[i];
        Row row = {analysis.study.observers[i].id, std::to_string(slope.cells),
                   std::to_string(slope.censored)};
        if (slope.own) {
            const double half = kNormal95 * slope.standardError;
            appendSlope(row, mean + *slope.own,
                        records::Interval{mean + *slope.own - half, mean + *slope.own + half});
        } else {
            appendSlope(row, std::nullopt, std::nullopt);
        }
        row.push_back(full(std::pow(10.0, mean + slope.shrunken)));
        table.rows.push_back(row);
    }
    return table;
}

TextTable estimatorFile(const SlopeAnalysis& analysis) {
    TextTable table{.name = "estimators",
                    .caption = "",
                    .head = {"estimator", "assumes", "c", "c_low", "c_high"},
                    .rows = {}};
    for (const Estimator& estimator : estimators(analysis)) {
        Row row = {estimator.name, estimator.assumes};
        appendSlope(row, estimator.log10c, estimator.ci95);
        table.rows.push_back(row);
    }
    return table;
}

std::string screeningVerdict(const ScreenedObserver& row) {
    if (row.excluded) return row.reason;
    return row.reason.empty() ? "no" : std::string("kept: ").append(row.reason);
}

std::string percentText(double share) {
    return shortText(100 * share) + " %";
}

TextTable betaTable(const SlopeAnalysis& analysis, bool forPeople) {
    TextTable table{
        .name = "beta",
        .caption =
            "Psychometric slope beta of each pattern; the published study used 3.5. The prior is "
            "log-normal around 3.5 (ln sd .5); the last column takes it out again, where the "
            "trials tell more than it does.",
        .head =
            forPeople
                ? Row{"pattern", "trials", "beta", "share of the prior", "from the trials alone"}
                : Row{"pattern", "trials", "beta", "beta_low", "beta_high", "prior_share",
                      "beta_trials_alone", "beta_trials_alone_low", "beta_trials_alone_high"},
        .rows = {}};
    for (const BetaEstimate& beta : analysis.betas) {
        Row row = {std::string(records::toText(beta.pattern)), std::to_string(beta.trials)};
        const auto& alone = beta.fromTrialsAlone;
        const auto& aloneCi95 = beta.fromTrialsAloneCi95;
        if (forPeople) {
            row.push_back(estimateText(beta.beta, beta.ci95));
            row.push_back(fixedText(100 * beta.priorShare, 0) + " %");
            row.push_back(alone ? estimateText(*alone, aloneCi95) : kUnknown);
        } else {
            row.insert(row.end(), {full(beta.beta), full(beta.ci95.low), full(beta.ci95.high),
                                   full(beta.priorShare), full(alone),
                                   aloneCi95 ? full(aloneCi95->low) : kUnknown,
                                   aloneCi95 ? full(aloneCi95->high) : kUnknown});
        }
        table.rows.push_back(row);
    }
    return table;
}

TextTable audienceTable(const SlopeAnalysis& analysis, bool forPeople) {
    TextTable table{
        .name = "audience",
        .caption =
            "The slope that an audience needs: at r = c a at most so many observers detect "
            "the artifact of the worst group on at least so many of the trials (guesses "
            "taken out).",
        .head = forPeople ? Row{"observers", "trials", "c"}
                          : Row{"observer_share", "trial_share", "c", "c_low", "c_high"},
        .rows = {}};
    if (!analysis.audience || !analysis.audience->populationKnown) return table;
    for (const AudienceCurve::Need& need : analysis.audience->needs) {
        if (forPeople) {
            table.rows.push_back({percentText(need.observerShare), percentText(need.trialShare),
                                  slopeText(need.log10c, need.ci95)});
            continue;
        }
        Row row = {full(need.observerShare), full(need.trialShare)};
        appendSlope(row, need.log10c, need.ci95);
        table.rows.push_back(row);
    }
    return table;
}

TextTable screeningTable(const SlopeAnalysis& analysis) {
    TextTable table{.name = "screening",
                    .caption = "Screening, by rules fixed before any slope was seen.",
                    .head = {"participant", "trials", "references", "false_alarms", "rate_lower_95",
                             "catch_trials", "catch_failures", "runs_at_a_limit", "excluded"},
                    .rows = {}};
    for (const ScreenedObserver& row : analysis.screening) {
        table.rows.push_back({row.id, std::to_string(row.trials), std::to_string(row.references),
                              std::to_string(row.falseAlarms),
                              fixedText(row.falseAlarmLowerBound, 3),
                              std::to_string(row.catchTrials), std::to_string(row.catchFailures),
                              std::to_string(row.runsAtLimit.size()), screeningVerdict(row)});
    }
    return table;
}

TextTable groupReport(const SlopeAnalysis& analysis) {
    TextTable table{
        .name = "groups",
        .caption =
            "Slope c per group (r = c a), mean observer, with 95 % interval; beside "
            "it the two-stage mean and the published method's line through the "
            "origin.",
        .head = {"group", "observers", "trials", "c", "two-stage", "censored", "through origin"},
        .rows = {}};
    if (analysis.slope.lawRejected) {
        table.caption +=
            " These take one c for all sizes of a group. The headline is not among them: since the "
            "law is rejected it comes from a second fit, in which c changes with the size, read at "
            "a = " +
            shortText(analysis.slope.worstArtifactPx.value_or(0)) + " px, where it is largest.";
    }
    for (std::size_t g = 0; g < analysis.groups.size(); ++g) {
        const GroupResult& result = analysis.groups[g];
        std::string name = analysis.study.groups[g].name;
        if (!result.flag.empty()) name += " (" + result.flag + ")";
        table.rows.push_back(
            {name, std::to_string(result.observers), std::to_string(result.trials),
             slopeText(result.c),
             result.twoStage.log10c ? slopeText(*result.twoStage.log10c, result.twoStage.ci95)
                                    : kUnknown,
             std::to_string(result.twoStage.censored), rounded(result.lines.throughOrigin, 2)});
    }
    return table;
}

std::string referenceText(const std::optional<ReferenceSize>& size,
                          std::optional<double> ReferenceSize::*radius) {
    if (!size) return kUnknown;
    return *size.*radius ? fixedText(*(*size.*radius), 1) : "> " + shortText(kReferenceBoundPx);
}

TextTable conditionReport(const SlopeAnalysis& analysis, const ReferenceSizes& reference) {
    TextTable table{
        .name = "conditions",
        .caption =
            "Each condition by itself: its slope with 95 % interval, the threshold radius, and the "
            "reference sizes from which no display code differs by more than rounding (R1/2) or by "
            "more than 1 (R1).",
        .head = {"group", "a (px)", "observers", "trials", "c", "radius (px)", "R1/2 (px)",
                 "R1 (px)"},
        .rows = {}};
    const bool degrees = analysis.study.pxPerDeg.has_value();
    if (degrees) table.head.insert(table.head.end(), {"a (deg)", "radius (deg)"});
    for (std::size_t k = 0; k < analysis.conditions.size(); ++k) {
        const Condition& condition = analysis.study.conditions[k];
        const ConditionResult& result = analysis.conditions[k];
        std::string name = analysis.study.groups[condition.group].name;
        if (!result.flag.empty()) name += " (" + result.flag + ")";
        const std::optional<double> radius = radiusOf(analysis, k);
        const auto size = referenceSize(reference, analysis.study, k);
        Row row = {name,
                   shortText(condition.artifactPx),
                   std::to_string(result.observers),
                   std::to_string(result.trials),
                   result.c ? slopeText(*result.c) : kUnknown,
                   rounded(radius, 1),
                   referenceText(size, &ReferenceSize::halfCode),
                   referenceText(size, &ReferenceSize::oneCode)};
        if (degrees) {
            row.push_back(rounded(inDegrees(analysis.study, condition.artifactPx), 2));
            row.push_back(rounded(inDegrees(analysis.study, radius), 2));
        }
        table.rows.push_back(row);
    }
    return table;
}

TextTable estimatorReport(const SlopeAnalysis& analysis) {
    TextTable table{.name = "estimators",
                    .caption = "The headline and other estimates, each with what it assumes.",
                    .head = {"estimate", "c", "assumes"},
                    .rows = {}};
    for (const Estimator& estimator : estimators(analysis)) {
        if (!estimator.log10c) continue;
        table.rows.push_back({estimator.name,
                              estimator.ci95 ? slopeText(*estimator.log10c, estimator.ci95)
                                             : fixedText(std::pow(10.0, *estimator.log10c), 2),
                              estimator.assumes});
    }
    return table;
}

// The columns of the task alone; where a table would be long, those who stand out.
TextTable screeningReport(const SlopeAnalysis& analysis) {
    const bool yesNo = analysis.study.task == records::Task::yesNo;
    TextTable table{.name = "screening",
                    .caption = "Screening, by rules fixed before any slope was seen.",
                    .head = {"participant", "trials"},
                    .rows = {}};
    const std::vector<std::string> own =
        yesNo ? std::vector<std::string>{"references", "false alarms", "lower 95 % bound"}
              : std::vector<std::string>{"catch trials", "catch failures"};
    table.head.insert(table.head.end(), own.begin(), own.end());
    table.head.insert(table.head.end(), {"runs at a display limit", "left out"});
    std::size_t unremarkable = 0;
    for (const ScreenedObserver& row : analysis.screening) {
        const bool remarkable = !row.reason.empty() || !row.runsAtLimit.empty();
        if (!remarkable && analysis.screening.size() > kScreeningRows) {
            ++unremarkable;
            continue;
        }
        Row cells = {row.id, std::to_string(row.trials)};
        if (yesNo) {
            cells.push_back(std::to_string(row.references));
            cells.push_back(std::to_string(row.falseAlarms));
            cells.push_back(fixedText(row.falseAlarmLowerBound, 3));
        } else {
            cells.push_back(std::to_string(row.catchTrials));
            cells.push_back(std::to_string(row.catchFailures));
        }
        cells.push_back(std::to_string(row.runsAtLimit.size()));
        cells.push_back(screeningVerdict(row));
        table.rows.push_back(cells);
    }
    if (unremarkable > 0) {
        table.caption.append(" The other ")
            .append(std::to_string(unremarkable))
            .append(" broke no rule: screening.tsv.");
    }
    return table;
}

struct WithAndWithout {
    std::string quantity;
    bool slope;  // log10, shown as c
    double value;
    std::optional<records::Interval> ci95;
};

std::vector<WithAndWithout> quantitiesOf(const SlopeResult& result) {
    const auto groups = static_cast<Eigen::Index>(result.groupNames.size());
    const ModelParameters& fitted = result.law.parameters;
    std::vector<WithAndWithout> rows = {
        {"headline", true, result.headline.value, result.headline.ci95},
        {"90th-percentile observer", true, result.headline.value90, result.headline.ci95For90}};
    for (Eigen::Index g = 0; g < groups; ++g) {
        const LinearEstimate c = linearEstimate(result.law, Eigen::VectorXd::Unit(groups, g));
        rows.push_back(
            {"group " + result.groupNames[static_cast<std::size_t>(g)], true, c.value, c.ci95()});
    }
    if (result.kappa) {
        rows.push_back({"exponent kappa", false, result.kappa->value, result.kappa->ci95()});
    }
    rows.push_back({"sd between observers (log10)", false, fitted.tau, {}});
    rows.push_back({"sd between an observer's conditions (log10)", false, fitted.omega, {}});
    rows.push_back({"lapse rate", false, fitted.lapse, {}});
    return rows;
}

// Everything that screening can have moved, beside what it is without screening.
TextTable everyoneTable(const SlopeAnalysis& analysis, bool forPeople) {
    TextTable table{.name = "with_everyone",
                    .caption = "What leaving observers out changes: the same fits with everyone.",
                    .head = forPeople ? Row{"quantity", "screened", "with everyone"}
                                      : Row{"quantity", "screened", "screened_low", "screened_high",
                                            "everyone", "everyone_low", "everyone_high"},
                    .rows = {}};
    if (!analysis.everyone) return table;
    const std::vector<WithAndWithout> all = quantitiesOf(*analysis.everyone);
    for (const WithAndWithout& screened : quantitiesOf(analysis.slope)) {
        const auto same = std::find_if(all.begin(), all.end(), [&](const WithAndWithout& one) {
            return one.quantity == screened.quantity;
        });
        Row row = {screened.quantity};
        for (const WithAndWithout* one : {&screened, same == all.end() ? nullptr : &*same}) {
            if (forPeople) {
                row.push_back(!one         ? kUnknown
                              : one->slope ? slopeText(one->value, one->ci95)
                              : one->ci95  ? estimateText(one->value, one->ci95)
                                           : fixedText(one->value, 3));
            } else if (one && one->slope) {
                appendSlope(row, one->value, one->ci95);
            } else {
                row.push_back(one ? full(one->value) : kUnknown);
                row.push_back(one && one->ci95 ? full(one->ci95->low) : kUnknown);
                row.push_back(one && one->ci95 ? full(one->ci95->high) : kUnknown);
            }
        }
        table.rows.push_back(row);
    }
    return table;
}

// c never stands without what it was measured as: the same in every row, for tables that are read
// apart from slope.json.
TextTable withTerms(TextTable table, const SlopeAnalysis& analysis) {
    const Study& study = analysis.study;
    std::string betas;
    for (const double beta : analysis.slope.law.parameters.beta) {
        if (!betas.empty()) betas += ',';
        betas += full(beta);
    }
    const Row terms = {
        full(analysis.options.criterion), std::string(records::toText(study.task)), study.kernel,
        study.encoding ? std::string(records::toText(*study.encoding)) : "n/a", betas};
    for (const char* name : {"fit_criterion", "task", "kernel", "encoding", "fit_beta"}) {
        table.head.emplace_back(name);
    }
    for (Row& row : table.rows) row.insert(row.end(), terms.begin(), terms.end());
    return table;
}

}  // namespace

std::vector<TextTable> fileTables(const SlopeAnalysis& analysis, const ReferenceSizes& reference) {
    std::vector<TextTable> tables = {withTerms(groupFile(analysis), analysis),
                                     withTerms(conditionFile(analysis, reference), analysis),
                                     withTerms(thresholdFile(analysis), analysis),
                                     withTerms(observerFile(analysis), analysis),
                                     withTerms(estimatorFile(analysis), analysis),
                                     betaTable(analysis, false),
                                     withTerms(audienceTable(analysis, false), analysis),
                                     screeningTable(analysis)};
    if (analysis.everyone) tables.push_back(withTerms(everyoneTable(analysis, false), analysis));
    return tables;
}

std::vector<TextTable> reportTables(const SlopeAnalysis& analysis,
                                    const ReferenceSizes& reference) {
    std::vector<TextTable> tables = {
        groupReport(analysis),         conditionReport(analysis, reference),
        estimatorReport(analysis),     betaTable(analysis, true),
        audienceTable(analysis, true), screeningReport(analysis),
        everyoneTable(analysis, true)};
    std::erase_if(tables, [](const TextTable& table) { return table.rows.empty(); });
    return tables;
}

}  // namespace analysis

// SPDX-License-Identifier: MIT
#include "analysis/estimators.h"

#include <cmath>

#include "analysis/number_text.h"

namespace analysis {

std::vector<Estimator> estimators(const SlopeAnalysis& analysis) {
    const SlopeResult& slope = analysis.slope;
    std::vector<Estimator> rows = {
        {"headline: worst group, mean observer",
         slope.lawRejected ? "largest slope over groups and measured sizes"
                           : "r = c a within a group; largest slope over groups",
         slope.headline.value, slope.headline.ci95},
        {"worst group, 90th-percentile observer", "observers normal in log10 c",
         slope.headline.value90, slope.headline.ci95For90},
        {"overall, one-stage", "mean of the groups' log10 c; random observers",
         analysis.overall.value, analysis.overall.ci95()},
        {"overall, two-stage", "mean over observers of log10 thresholds; leaves censored cells out",
         analysis.twoStage.log10c, analysis.twoStage.ci95},
        {"overall, two-stage median", "median over observers", analysis.twoStage.medianLog10c, {}}};
    if (analysis.lines.throughOrigin) {
        rows.push_back({"all conditions, least squares through the origin in px (published method)",
                        "radii scatter equally at every size; about 4 % too large; no interval",
                        std::log10(*analysis.lines.throughOrigin),
                        {}});
    }
    if (const auto& line = analysis.lines.powerLaw) {
        rows.push_back({"all conditions, least squares of log r on log a, at a = " +
                            shortText(line->referencePx) + " px, exponent " +
                            fixedText(line->exponent, 2),
                        "radii scatter by a factor; thresholds are independent; no interval",
                        line->log10c,
                        {}});
    }
    if (const auto& line = analysis.lines.affine; line && line->slope > 0) {
        rows.push_back({"slope of r = " + fixedText(line->interceptPx, 1) +
                            " px + s a, least squares in px (is not c)",
                        "radii scatter equally at every size; no interval",
                        std::log10(line->slope),
                        {}});
    }
    if (analysis.bootstrap) {
        const std::string draws = std::to_string(analysis.bootstrap->draws) + " draws";
        rows.push_back({"headline, bootstrap over observers, " + draws,
                        "no distribution of the observers; too short with few of them",
                        slope.headline.value, analysis.bootstrap->headline});
        rows.push_back({"90th-percentile observer, bootstrap over observers, " + draws, "likewise",
                        slope.headline.value90, analysis.bootstrap->ninetieth});
        rows.push_back({"overall, bootstrap over observers, " + draws, "likewise",
                        analysis.overall.value, analysis.bootstrap->overall});
    }
    if (analysis.pooled && analysis.pooled->converged) {
        rows.push_back({"overall, pooled maximum likelihood",
                        "all trials from one observer, whose curve comes out too flat; an interval "
                        "would be far "
                        "too short",
                        analysis.pooled->fixed.mean(),
                        {}});
    }
    if (analysis.everyone) {
        rows.push_back({"headline with the excluded observers", "as the headline, nobody left out",
                        analysis.everyone->headline.value, analysis.everyone->headline.ci95});
    }
    return rows;
}

}  // namespace analysis

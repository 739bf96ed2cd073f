// SPDX-License-Identifier: MIT
// Reference filter sizes without an observer, as a table on standard output.
#include <algorithm>
#include <cstdio>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "program/progress.h"
#include "program/run_program.h"
#include "records/run_context.h"
#include "records/trial_table.h"
#include "stimulus/reference_radius.h"

namespace {

using namespace stimulus;

struct Request {
    std::vector<std::string> kernels{"disc"}, patterns{"stair"};
    std::vector<double> artifactsPx{10}, litLevels{1};
    double angleDeg = 45;
    int windowPx = 600;
    std::string spacing = "window", encoding = "code";
    std::optional<double> maxRadiusPx;
    bool all = false, identical = false;
};

// The words of the trial tables, for what they mean to the stimuli.
Pattern patternFor(const std::string& word) {
    switch (*records::patternFromText(word)) {
        case records::Pattern::step:
            return Pattern::step;
        case records::Pattern::line:
            return Pattern::line;
        default:
            return Pattern::stair;
    }
}

Encoding encodingFor(const std::string& word) {
    const bool light = records::encodingFromText(word) == records::Encoding::srgb;
    return light ? Encoding::srgb : Encoding::code;
}

CLI::IsMember oneOf(const std::vector<std::string>& words) {
    CLI::IsMember member(words);
    member.description("");  // the option's help names them
    return member;
}

void addOptions(CLI::App& app, Request& request) {
    app.add_option("--kernel", request.kernels, "disc, box, gaussian (one or more; default disc)")
        ->check(oneOf({"disc", "box", "gaussian"}))
        ->delimiter(',');
    auto* pattern = app.add_option("--pattern", request.patterns,
                                   "stair, step, line (one or more; default stair)")
                        ->check(oneOf({"stair", "step", "line"}))
                        ->delimiter(',');
    app.add_option("--angle", request.angleDeg, "angle of the line, degrees in (0, 45]");
    auto* artifact = app.add_option("--artifact", request.artifactsPx,
                                    "artifact size a, screen px (one or more; default 10)")
                         ->delimiter(',');
    auto* lit = app.add_option("--lit-level", request.litLevels,
                               "share of full white on the lit side, 0..1 (one or more; default 1)")
                    ->delimiter(',');
    app.add_option("--window", request.windowPx, "edge of the stimulus, px (default 600)");
    app.add_option("--spacing", request.spacing,
                   "between a step's risers: window (a single step, default), or 8a (scale-free)")
        ->check(oneOf({"window", "8a"}));
    app.add_option("--encoding", request.encoding,
                   "what is filtered: code (code values, default, as the published figure), or "
                   "srgb (light)")
        ->check(oneOf({"code", "srgb"}));
    app.add_option("--max-radius", request.maxRadiusPx,
                   "bound of \"all larger radii\", px (default: the window)");
    app.add_flag("--identical", request.identical, "also the size for identical images");
    app.add_flag("--all", request.all,
                 "the published study's sizes 5 10 20 30, stair and step, lit levels 1 and 0.5")
        ->excludes(pattern)
        ->excludes(artifact)
        ->excludes(lit);
}

/// What the options mean together; throws where one has no effect.
void complete(Request& request, const CLI::App& app) {
    if (request.all) {
        request.patterns = {"stair", "step"};
        request.artifactsPx = {5, 10, 20, 30};
        request.litLevels = {1, 0.5};
    }
    const auto has = [&](const char* p) { return std::ranges::count(request.patterns, p) > 0; };
    if (app.count("--angle") > 0 && !has("line"))
        throw std::invalid_argument("--angle: only the pattern line has an angle of its own");
    if (has("line") && app.count("--angle") == 0)
        throw std::invalid_argument("--pattern line: needs an --angle in degrees");
    if (app.count("--spacing") > 0 && !has("step"))
        throw std::invalid_argument("--spacing: only the pattern step has risers to space");
}

struct Row {
    std::string kernel, pattern, encoding;
    ReferenceOptions options;
};

std::vector<Row> rowsOf(const Request& request) {
    std::vector<Row> rows;
    for (const std::string& kernel : request.kernels)
        for (const std::string& pattern : request.patterns)
            for (const double a : request.artifactsPx)
                for (const double lit : request.litLevels) {
                    const double spacing = request.spacing == "8a" ? 8 * a : request.windowPx;
                    const ReferenceOptions options{
                        .silhouette = {.pattern = patternFor(pattern),
                                       .artifactPx = a,
                                       .angleDeg = request.angleDeg,
                                       .riserSpacingPx = spacing},
                        .kernel = *kernelShapeFromText(kernel),
                        .litLevel = lit,
                        .encoding = encodingFor(request.encoding),
                        .windowPx = request.windowPx,
                        .maxRadiusPx = request.maxRadiusPx.value_or(request.windowPx)};
                    validate(options);
                    rows.push_back({kernel, pattern, request.encoding, options});
                }
    return rows;
}

void printHead(const Request& request, double maxRadiusPx, const std::string& context) {
    for (std::size_t start = 0; start < context.size();) {
        const std::size_t end = context.find('\n', start);
        std::printf("# %s\n", context.substr(start, end - start).c_str());
        start = end == std::string::npos ? context.size() : end + 1;
    }
    std::printf(
        "# Radius (px, grid of 0.25) from which on, up to %g px:\n"
        "# half_code_px   no code value differs by 1/2 or more before rounding (R1/2)\n"
        "# one_code_px    no 8-bit code differs by more than 1 (R1)\n",
        maxRadiusPx);
    if (request.identical) std::printf("# identical_px   the 8-bit images are the same (R0)\n");
    std::printf(
        "# n/a            not reached within that bound\n"
        "kernel\tpattern\tangle_deg\triser_spacing_px\tartifact_px\tlit_level\tencoding\t"
        "half_code_px\tone_code_px%s\n",
        request.identical ? "\tidentical_px" : "");
}

std::string radiusCell(const ReferenceOptions& options, ReferenceCriterion criterion) {
    const auto radius = referenceRadius(options, criterion);
    if (!radius) return "n/a";
    char cell[32];
    std::snprintf(cell, sizeof cell, "%.2f", *radius);
    return cell;
}

void printRow(const Row& row, bool identical) {
    const ReferenceOptions& o = row.options;
    const SilhouetteOptions& s = o.silhouette;
    char spacing[32] = "n/a";
    if (s.pattern == Pattern::step) std::snprintf(spacing, sizeof spacing, "%g", s.riserSpacingPx);
    const std::string half = radiusCell(o, ReferenceCriterion::halfCode);
    const std::string one = radiusCell(o, ReferenceCriterion::oneCode);
    std::printf("%s\t%s\t%.6g\t%s\t%g\t%g\t%s\t%s\t%s", row.kernel.c_str(), row.pattern.c_str(),
                trueAngleDeg(s), spacing, s.artifactPx, o.litLevel, row.encoding.c_str(),
                half.c_str(), one.c_str());
    if (identical) std::printf("\t%s", radiusCell(o, ReferenceCriterion::identical).c_str());
    std::printf("\n");
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{
        "The filter size from which an artifact cannot be told from a straight edge by its display "
        "codes, whoever looks: a table of tab-separated values."};
    Request request;
    addOptions(app, request);
    return program::run(app, argc, argv, [&] {
        complete(request, app);
        const std::vector<Row> rows = rowsOf(request);
        printHead(request, rows.front().options.maxRadiusPx,
                  records::contextText(records::currentRunContext(
                      "reference_filter", std::vector<std::string>(argv, argv + argc))));
        program::Progress progress("reference sizes", rows.size());
        for (const Row& row : rows) {
            printRow(row, request.identical);
            progress.advance();
        }
    });
}

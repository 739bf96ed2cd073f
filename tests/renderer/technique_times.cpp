// SPDX-License-Identifier: MIT
// Prints what the filtered techniques cost against each other and against the
// full disc, in one interleaved run at the same softness, so that whatever else
// the machine does falls on all of them: docs/results/technique-times.md.
//   technique_times SCENE RADIUS_TEXELS... [TECHNIQUE...] >> docs/results/technique-times.md
// Radius 0 is the scene's own softness. With names only these, the full disc and vsm.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

#include "program/build_info.h"
#include "renderer/renderer.h"

namespace {

constexpr int kResolution = 1024;
constexpr int kWidthPx = 1280;
constexpr int kHeightPx = 720;
constexpr int kRounds = 9;

struct Quartiles {
    double low, median, high;
};

Quartiles quartilesOf(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const auto at = [&](double share) {
        const double place = share * static_cast<double>(values.size() - 1);
        const auto low = static_cast<std::size_t>(place);
        const std::size_t high = std::min(low + 1, values.size() - 1);
        return values[low] + (values[high] - values[low]) * (place - static_cast<double>(low));
    };
    return {at(0.25), at(0.5), at(0.75)};
}

struct Row {
    const renderer::Technique* technique;
    std::array<std::vector<double>, renderer::kPasses> passesMs;
    std::vector<double> sumsMs;
    std::vector<double> wholeDepthMs;  // with every triangle in every map
    std::vector<double> wholeMs;       // prefilter of whole maps
    double share = 1;                  // of the last map's tiles that are filtered
    std::size_t bytes = 0;             // of the maps and what they are filtered in

    double median(renderer::Pass pass) const {
        return quartilesOf(passesMs[static_cast<std::size_t>(pass)]).median;
    }
};

std::string ratio(const Row& row, const Row& to) {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < row.sumsMs.size(); ++i)
        ratios.push_back(row.sumsMs[i] / to.sumsMs[i]);
    const Quartiles q = quartilesOf(ratios);
    char text[48];
    std::snprintf(text, sizeof text, "%.2f (%.2f-%.2f)", q.median, q.low, q.high);
    return text;
}

void measure(const renderer::GlInfo& info, const char* scene, double radiusTexels,
             const std::vector<std::string>& only) {
    using renderer::Pass;
    renderer::Renderer frame(info, renderer::makeScene(scene), kWidthPx, kHeightPx);
    const auto radius =
        static_cast<float>(radiusTexels > 0 ? radiusTexels / kResolution
                                            : frame.scene().softnessM / frame.window().extentM);
    std::vector<Row> rows;
    for (const renderer::Technique& technique : renderer::techniques())
        if (technique.name == "pcf_disc" || technique.name == "vsm" ||
            (only.empty() ? technique.prefilter != renderer::Prefilter::none
                          : std::find(only.begin(), only.end(), technique.name) != only.end()))
            rows.push_back({.technique = &technique,
                            .passesMs = {},
                            .sumsMs = {},
                            .wholeDepthMs = {},
                            .wholeMs = {}});
    renderer::PassClock clock(info);
    std::size_t drawn = 0;
    for (int round = -1; round < kRounds; ++round)  // the first warms up
        for (Row& row : rows) {
            const renderer::FrameSettings settings{.technique = row.technique,
                                                   .resolution = kResolution,
                                                   .radiusUv = radius,
                                                   .lit = false};
            frame.render(settings);  // allocates: one renderer goes from technique to technique
            frame.render(settings, &clock);
            const renderer::PassTimesMs times = clock.collectMs();
            row.share = frame.readFilteredShare();
            row.bytes = frame.mapBytes();
            renderer::FrameSettings whole = settings;
            whole.filterUnseen = whole.filterOutsidePenumbrae = true;
            whole.drawOutside = true;
            drawn = frame.drawnTriangles();
            frame.render(whole, &clock);
            const renderer::PassTimesMs wholeTimes = clock.collectMs();
            if (round < 0) continue;
            row.wholeDepthMs.push_back(wholeTimes[static_cast<std::size_t>(Pass::depth)]);
            row.wholeMs.push_back(wholeTimes[static_cast<std::size_t>(Pass::prefilter)]);
            double sum = 0;
            for (const Pass pass : {Pass::depth, Pass::prefilter, Pass::lookup}) {
                const auto i = static_cast<std::size_t>(pass);
                row.passesMs[i].push_back(times[i]);
                sum += times[i];
            }
            row.sumsMs.push_back(sum);
        }
    const auto find = [&](std::string_view name) -> const Row& {
        return *std::find_if(rows.begin(), rows.end(),
                             [&](const Row& row) { return row.technique->name == name; });
    };
    double screens = 0;
    for (const renderer::PixelRect& pixels : frame.servedPixels())
        screens += static_cast<double>(pixels.width) * pixels.height / (kWidthPx * kHeightPx);
    std::printf(
        "\n**%s**, %d x %d px, N = %d, radius %.5f of the map = %.1f "
        "texels, %d rounds; %zu maps, looked up over %.2f screens; %zu of %zu "
        "triangles drawn into them\n\n"
        "| technique | depth ms | of all triangles ms | prefilter ms | of it all ms | tiles filtered | "
        "lookup ms "
        "| sum ms | "
        "of pcf_disc | of vsm | maps MB |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|\n",
        scene, kWidthPx, kHeightPx, kResolution, static_cast<double>(radius),
        static_cast<double>(radius) * kResolution, kRounds, frame.lightViews().size(), screens,
        drawn, frame.drawnTriangles());
    for (const Row& row : rows)
        std::printf("| %s | %.1f | %.1f | %.1f | %.1f | %.0f %% | %.1f | %.1f | %s | %s | %.1f |\n",
                    std::string(row.technique->name).c_str(), row.median(Pass::depth),
                    quartilesOf(row.wholeDepthMs).median, row.median(Pass::prefilter),
                    quartilesOf(row.wholeMs).median, 100 * row.share, row.median(Pass::lookup),
                    quartilesOf(row.sumsMs).median, ratio(row, find("pcf_disc")).c_str(),
                    ratio(row, find("vsm")).c_str(), static_cast<double>(row.bytes) / 1e6);
}

int measure(int argc, char** argv) {
    std::vector<double> radiiTexels;
    std::vector<std::string> only;
    for (int i = 2; i < argc; ++i) {
        char* end = nullptr;
        const double radius = std::strtod(argv[i], &end);
        if (*end == 0 && radius >= 0) {
            radiiTexels.push_back(radius);
            continue;
        }
        try {
            only.emplace_back(renderer::findTechnique(argv[i]).name);
        } catch (const std::invalid_argument& error) {
            std::fprintf(stderr, "technique_times: neither a radius nor a technique: %s\n",
                         error.what());
            return 2;
        }
    }
    if (radiiTexels.empty()) {
        std::fprintf(stderr, "usage: technique_times SCENE RADIUS_TEXELS... [TECHNIQUE...]\n");
        return 2;
    }
    const renderer::HeadlessContext context;
    std::printf(
        "## Revision %s, %s, %s\n\n%s; %s. Depth pass, prefilter and lookup, "
        "each by %s; the sum "
        "is theirs and leaves out what is the\nsame for all: prepass and lit "
        "pass. Every filtered "
        "technique at its defaults, so with a box as soft as the disc. "
        "Medians;\nratios are of the "
        "same round, median and quartiles.\n",
        program::buildInfo().revision.c_str(), program::buildInfo().buildType.c_str(),
        program::buildInfo().compiler.c_str(), context.info().renderer.c_str(),
        context.info().version.c_str(),
        std::string(renderer::PassClock(context.info()).method()).c_str());
    for (const double radius : radiiTexels) measure(context.info(), argv[1], radius, only);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return measure(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "technique_times: %s\n", error.what());
        return 1;
    }
}

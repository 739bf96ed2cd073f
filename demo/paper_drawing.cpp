// SPDX-License-Identifier: MIT
#include "demo/paper_drawing.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "demo/edge_ripple.h"
#include "demo/edge_width.h"
#include "demo/error_metrics.h"
#include "demo/map_places.h"
#include "renderer/renderer.h"

namespace demo {
namespace {

using renderer::ByteImage;
using renderer::FloatImage;

FloatImage averaged(const FloatImage& image, int block) {
    if (block == 1) return image;
    FloatImage result(image.width / block, image.height / block);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            result.at(x / block, y / block) += image.at(x, y) / static_cast<float>(block * block);
    return result;
}

bool liesInMap(const FloatImage& places, int x, int y) {
    const auto inside = [](float v) { return v > 0 && v < 1; };
    return places.at(x, y, kPlaceIsSurface) != 0 && inside(places.at(x, y, kPlaceU)) &&
           inside(places.at(x, y, kPlaceV)) && places.at(x, y, kPlaceDepth) < 1;
}

/// Surfaces in the map whose surroundings all have this value in the truth.
std::vector<bool> deepIn(const FloatImage& truth, const FloatImage& places, float value,
                         int margin) {
    std::vector<bool> deep(truth.values.size());
    for (int y = margin; y + margin < truth.height; ++y)
        for (int x = margin; x + margin < truth.width; ++x) {
            bool all = true;
            for (int j = -margin; all && j <= margin; ++j)
                for (int i = -margin; all && i <= margin; ++i)
                    all = truth.at(x + i, y + j) == value && liesInMap(places, x + i, y + j);
            deep[truth.index(x, y)] = all;
        }
    return deep;
}

template <class Value>
double meanOver(const FloatImage& image, const std::vector<bool>& pixels, Value value) {
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < pixels.size(); ++i)
        if (pixels[i]) {
            sum += value(static_cast<double>(image.values[i]));
            ++count;
        }
    return count == 0 ? 0 : sum / static_cast<double>(count);
}

double measured(PaperNumber number, const FloatImage& image, const FloatImage& truth,
                const FloatImage& places, int resolution, int margin) {
    const auto itself = [](double v) { return v; };
    switch (number) {
        case PaperNumber::rmse:
            return compareVisibility(image, truth).rmse;
        case PaperNumber::umbraLight:
            return meanOver(image, deepIn(truth, places, 0, margin), itself);
        case PaperNumber::litLight:
            return meanOver(image, deepIn(truth, places, 1, margin), itself);
        case PaperNumber::litDark:
            return meanOver(image, deepIn(truth, places, 1, margin),
                            [](double v) { return v < 0.9 ? 1.0 : 0.0; });
        case PaperNumber::edgeWidth:
            return edgeWidth(image, truth, places).widthPx;
        case PaperNumber::edgeRipple:
            return summarised(edgeRipples(image, truth, places, resolution)).p95;
    }
    return 0;
}

ByteImage greyPicture(const FloatImage& visibility, double gain) {
    ByteImage picture(visibility.width, visibility.height);
    std::transform(visibility.values.begin(), visibility.values.end(), picture.values.begin(),
                   [&](float v) {
                       return static_cast<std::uint8_t>(
                           std::lround(255 * std::clamp(gain * static_cast<double>(v), 0.0, 1.0)));
                   });
    return picture;
}

/// A renderer of its own for each panel: one that changes its size would time the allocation of
/// maps.
struct Running {
    std::unique_ptr<renderer::Renderer> frame;
    std::unique_ptr<ShadowRun> run;
};

Running started(const renderer::GlInfo& info, const PaperFigure& figure, const PaperPanel& panel,
                int width, int height) {
    Running running;
    renderer::Scene scene = renderer::makeScene(figure.scene);
    if (figure.camera) scene.camera = *figure.camera;
    running.frame = std::make_unique<renderer::Renderer>(info, std::move(scene), width, height);
    running.run = std::make_unique<ShadowRun>(
        *running.frame, info, panelSettings(panel, running.frame->window().extentM));
    running.run->settle();
    return running;
}

FloatImage visibilityOf(const renderer::GlInfo& info, const PaperFigure& figure,
                        const PaperPanel& panel, int width, int height, int samples) {
    return averaged(
        started(info, figure, panel, width * samples, height * samples).frame->readVisibility(),
        samples);
}

PaperPanel onLargeMap(PaperPanel panel) {
    if (panel.radiusTexels > 0)
        panel.radiusTexels *= static_cast<double>(kTruthResolution) / panel.resolution;
    panel.resolution = kTruthResolution;
    return panel;
}

ByteImage pictureOf(const PaperFigure& figure, Running& running, const FloatImage& visibility,
                    int shrink) {
    constexpr int kSamples = 2;
    const ByteImage whole =
        figure.show == PaperShow::lit
            ? running.run->picture(figure.truthSamples > 1 ? 1 : kSamples)
            : greyPicture(visibility, figure.show == PaperShow::visibility ? 1 : kRaisedContrast);
    if (!figure.part || shrink != 1) return whole;
    return enlarged(whole, *figure.part, figure.scale);
}

}  // namespace

ShadowRun::Settings panelSettings(const PaperPanel& panel, double mapExtentM) {
    ShadowRun::Settings settings;
    settings.technique = &renderer::findTechnique(panel.technique);
    settings.parameters = settings.technique->standardParameters();
    for (const auto& [name, value] : panel.parameters)
        renderer::setParameter(*settings.technique, settings.parameters, name, value);
    settings.radiusUv =
        panel.radiusTexels > 0 ? panel.radiusTexels / panel.resolution : panel.radiusM / mapExtentM;
    if (panel.resolution > 0) settings.resolution = panel.resolution;
    return settings;
}

std::vector<DrawnPanel> drawFigure(const renderer::GlInfo& info, const PaperFigure& figure,
                                   int shrink, int rounds) {
    const int width = figure.widthPx / shrink;
    const int height = figure.heightPx / shrink;
    const int margin = std::max(figure.marginPx / shrink, 1);
    std::optional<FloatImage> truth;
    if (figure.truth)
        truth = visibilityOf(info, figure, *figure.truth, width, height, figure.truthSamples);

    std::vector<Running> running;
    std::vector<DrawnPanel> drawn;
    const auto ownTruth = [&](const PaperPanel& panel, const DrawnPanel& now) {
        const std::size_t i = drawn.size();
        if (i < figure.heldAgainst.size())
            return figure.heldAgainst[i] == i ? now.visibility
                                              : drawn[figure.heldAgainst[i]].visibility;
        return truth ? *truth : visibilityOf(info, figure, onLargeMap(panel), width, height, 1);
    };
    for (const PaperPanel& panel : figure.panels) {
        running.push_back(started(info, figure, panel, width, height));
        DrawnPanel one;
        one.resolution = running.back().run->chosen().resolution;
        one.visibility = running.back().frame->readVisibility();
        const FloatImage places = mapPlaces(*running.back().frame);
        const FloatImage own = ownTruth(panel, one);
        for (const PaperNumber number : figure.numbers)
            one.numbers.push_back(
                measured(number, one.visibility, own, places, one.resolution, margin));
        one.radiusTexels =
            static_cast<double>(running.back().run->frameSettings().radiusUv) * one.resolution;
        one.mapBytes = running.back().frame->mapBytes();
        one.picture = pictureOf(figure, running.back(), one.visibility, shrink);
        drawn.push_back(std::move(one));
    }
    if (!figure.timed) return drawn;
    std::vector<std::vector<double>> ms(running.size());
    for (int round = -1; round < rounds; ++round)  // the first warms up
        for (std::size_t i = 0; i < running.size(); ++i) {
            const double frame = running[i].run->timeWholeFrames(1).median;
            if (round >= 0) ms[i].push_back(frame);
        }
    for (std::size_t i = 0; i < running.size(); ++i) drawn[i].frameMs = spreadOf(ms[i]);
    return drawn;
}

}  // namespace demo

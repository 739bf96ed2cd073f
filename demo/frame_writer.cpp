// SPDX-License-Identifier: MIT
#include "demo/frame_writer.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <vector>

#include "demo/picture.h"
#include "records/frame_manifest.h"
#include "records/whole_file.h"

namespace demo {
namespace {

namespace fs = std::filesystem;

std::vector<double> ratios() {
    std::vector<double> all;
    for (double ratio = kLeastFrameRatio; ratio <= kMostFrameRatio * 1.001;
         ratio *= kFrameRatioStep) {
        all.push_back(ratio);
    }
    return all;
}

int sizeFor(double ratio, double radiusUv) {
    return static_cast<int>(std::lround(ratio / radiusUv));
}

double linearOf(std::uint8_t code) {
    const double c = code / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

/// sRGB code of the luminance (ITU-R BT.709), since the study's displays show codes of grey.
renderer::ByteImage grey(const renderer::ByteImage& colour) {
    renderer::ByteImage result(colour.width, colour.height, 1);
    for (int y = 0; y < result.height; ++y)
        for (int x = 0; x < result.width; ++x) {
            const double light = 0.2126 * linearOf(colour.at(x, y, 0)) +
                                 0.7152 * linearOf(colour.at(x, y, 1)) +
                                 0.0722 * linearOf(colour.at(x, y, 2));
            const double code =
                light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
            result.at(x, y) = static_cast<std::uint8_t>(std::lround(255 * code));
        }
    return result;
}

renderer::ByteImage rendered(renderer::Renderer& frame, renderer::FrameSettings settings,
                             int samples) {
    const int edge = frame.widthPx();
    frame.resize(edge * samples, edge * samples);
    settings.samplesPerPixelEdge = samples;
    frame.render(settings);
    const renderer::ByteImage large = frame.readLit();
    frame.resize(edge, edge);
    return grey(averagedInLight(large, samples));
}

/// Screen px that the map's extent spans, in the median over penumbra pixels of the last frame: the
/// root of how many pixels a patch of the map covers.
double pxPerUv(renderer::Renderer& frame) {
    const renderer::FloatImage visibility = frame.readVisibility(), at = frame.readPositions();
    const auto& m = frame.shadowConstants().shadowFromEyeRelative;
    const auto uv = [&](int x, int y) {
        const glm::vec4 p(at.at(x, y, 0), at.at(x, y, 1), at.at(x, y, 2), 1);
        const glm::vec4 s = m * p;
        return glm::dvec2(s.x, s.y);
    };
    std::vector<double> scales;
    for (int y = 0; y + 1 < at.height; ++y)
        for (int x = 0; x + 1 < at.width; ++x) {
            const float v = visibility.at(x, y);
            const bool surface =
                at.at(x, y, 3) > 0 && at.at(x + 1, y, 3) > 0 && at.at(x, y + 1, 3) > 0;
            if (!surface || v <= 0.02F || v >= 0.98F) continue;
            const glm::dvec2 dx = uv(x + 1, y) - uv(x, y), dy = uv(x, y + 1) - uv(x, y);
            const double area = std::abs(dx.x * dy.y - dx.y * dy.x);
            if (area > 0) scales.push_back(1 / std::sqrt(area));
        }
    if (scales.empty())
        throw std::invalid_argument(
            "frames: this view shows no penumbra: choose another scene or "
            "more softness");
    const auto middle = scales.begin() + static_cast<std::ptrdiff_t>(scales.size() / 2);
    std::ranges::nth_element(scales, middle);
    return *middle;
}

void requireUsable(const renderer::Renderer& frame, const renderer::GlInfo& info,
                   const FramePlan& plan) {
    if (!plan.technique->soft)
        throw std::invalid_argument("frames: technique " + std::string(plan.technique->name) +
                                    ": must have a kernel, whose radius is r");
    if (!(plan.radiusUv > 0))
        throw std::invalid_argument("frames: softness " + std::to_string(plan.radiusUv) +
                                    ": must be greater than 0");
    if (frame.widthPx() != frame.heightPx())
        throw std::invalid_argument("frames: viewport " + std::to_string(frame.widthPx()) + " x " +
                                    std::to_string(frame.heightPx()) + " px: must be square");
    const int least = sizeFor(kLeastFrameRatio, plan.radiusUv);
    if (least < 4)
        throw std::invalid_argument("frames: softness " + std::to_string(plan.radiusUv) +
                                    " of the map: the coarsest map would have " +
                                    std::to_string(least) + " texels along its edge, must be 4");
    const int converged = kConvergedFactor * sizeFor(kMostFrameRatio, plan.radiusUv);
    if (converged > info.maxResolution)
        throw std::invalid_argument("frames: softness " + std::to_string(plan.radiusUv) +
                                    " of the map: a converged map would have " +
                                    std::to_string(converged) +
                                    " texels along its edge, this "
                                    "driver's largest has " +
                                    std::to_string(info.maxResolution));
}

std::string fileName(const std::string& scene, const std::string& technique, int resolution) {
    char number[16];
    std::snprintf(number, sizeof number, "%05d", resolution);
    return scene + "-" + technique + "-n" + number + ".png";
}

}  // namespace

int frameCount() {
    return static_cast<int>(ratios().size()) + 1;
}

void writeFrames(const fs::path& folder, renderer::Renderer& frame, const renderer::GlInfo& info,
                 const FramePlan& plan, const records::RunContext& context,
                 const std::function<void()>& onFrame) {
    requireUsable(frame, info, plan);
    const fs::path manifestFile = folder / records::kManifestName;
    if (fs::exists(manifestFile))
        throw std::runtime_error(manifestFile.string() +
                                 ": is there already: frames go into a "
                                 "folder of their own");
    records::createFolders(folder);
    const std::string scene = frame.scene().name, technique(plan.technique->name);
    const auto write = [&](int resolution) {
        const std::string name = fileName(scene, technique, resolution);
        const renderer::FrameSettings settings{.technique = plan.technique,
                                               .parameters = plan.parameters,
                                               .resolution = resolution,
                                               .radiusUv = static_cast<float>(plan.radiusUv)};
        writePng(folder / name, rendered(frame, settings, plan.samples));
        if (onFrame) onFrame();
        return name;
    };
    const int converged = kConvergedFactor * sizeFor(kMostFrameRatio, plan.radiusUv);
    frame.render({.technique = plan.technique,
                  .parameters = plan.parameters,
                  .resolution = sizeFor(kMostFrameRatio, plan.radiusUv),
                  .radiusUv = static_cast<float>(plan.radiusUv)});
    // Two decimals keep the conditions' names short; the artifact follows, so that r / a stays
    // exact.
    const double radiusPx = std::max(0.01, std::round(100 * plan.radiusUv * pxPerUv(frame)) / 100);
    const std::string convergedName = write(converged);
    records::FrameManifest manifest{.context = context, .pairs = {}};
    int before = 0;
    for (const double ratio : ratios()) {
        const int resolution = sizeFor(ratio, plan.radiusUv);
        if (resolution == before) continue;  // steps finer than a texel, at the coarse end
        before = resolution;
        manifest.pairs.push_back({.artifact = write(resolution),
                                  .converged = convergedName,
                                  .artifactPx = radiusPx / (plan.radiusUv * resolution),
                                  .radiusPx = radiusPx,
                                  .scene = scene,
                                  .technique = technique});
    }
    records::writeFrameManifest(folder, manifest);
}

}  // namespace demo

// SPDX-License-Identifier: MIT
#include "demo/paper_figures.h"

#include <stdexcept>

namespace demo {
namespace {

using enum PaperNumber;

// Low and far away, so that a pixel sees many texels, and more of them along the view than across
// it.
const renderer::OrbitCamera kGrazing{.target = {0.2F, 0.0F, -1.0F},
                                     .yawDeg = 8,
                                     .pitchDeg = 3.5F,
                                     .distanceM = 16,
                                     .verticalFieldDeg = 12};
const renderer::OrbitCamera kFar{
    .target = {0, 0.5F, 0}, .yawDeg = 12, .pitchDeg = 40, .distanceM = 40, .verticalFieldDeg = 12};

constexpr double kCityRadiusM = 0.45;
/// Of variance maps as the paper has them: nothing that hides what rounding does.
const std::vector<std::pair<std::string, float>> kPlain = {{"derivative", 0}};
const std::vector<std::pair<std::string, float>> kPlain16 = {
    {"derivative", 0}, {"least_variance", 1e-6F}, {"bias_depth", 0}};

/// Samples a texel apart over 5 x 5: pcf_grid's Gaussian spans 2.5 radii.
constexpr double kRadius5 = 2;

std::vector<PaperFigure> variance() {
    const PaperPanel hard{"", "hard", {}, 1024};
    return {
        {.paper = "variance",
         .name = "variance-1",
         .title = "Fig. 1: anisotropic filtering",
         .scene = "yard",
         .camera = kGrazing,
         .widthPx = 400,
         .heightPx = 150,
         .part = Part{60, 40, 300, 50},
         .scale = 2,
         .truth = hard,
         .truthSamples = 8,
         .numbers = {rmse},
         .panels = {{"shadow map, bilinear PCF", "pcf_grid", {{"samples", 1}}},
                    {"VSM, mipmaps", "vsm_mip", {{"anisotropy", 1}}},
                    {"VSM, mipmaps, anisotropy 16", "vsm_mip", {{"anisotropy", 16}}}},
         .setting = "The yard's fence and posts from low and far away: a pixel sees many texels, "
                    "and more along the view than across it. Truth: 8 x 8 samples a pixel of the "
                    "hard shadow on the same map.",
         .finding = "As in the paper, the bilinear compare aliases, mipmaps alone blur across the "
                    "view, and probes along it keep the edges. Ours takes its probes in the shader "
                    "where the paper has the texture unit do it; no kernel but the pixel's own."},
        {.paper = "variance",
         .name = "variance-2",
         .title = "Fig. 2: mipmapping",
         .scene = "yard",
         .camera = kFar,
         .widthPx = 320,
         .heightPx = 180,
         .part = Part{90, 40, 150, 90},
         .scale = 2,
         .truth = PaperPanel{"", "hard", {}, 2048},
         .truthSamples = 8,
         .numbers = {rmse},
         .panels = {{"VSM without mipmapping", "vsm", {}, 2048},
                    {"VSM with mipmapping", "vsm_mip", {{"anisotropy", 1}}, 2048}},
         .setting = "The same yard from above and far away, a map of 2048 x 2048. Truth as before.",
         .finding = "Without mips a pixel reads four texels of the many that it covers; with them "
                    "it reads their mean. As in the paper: the fence's shadow breaks into crumbs "
                    "without mips and is even stripes with them. Where the big sphere is in a "
                    "post's shadow the wide levels let light through."},
        {.paper = "variance",
         .name = "variance-3",
         .title = "Fig. 3: 5x5 filters",
         .scene = "planar_occluder",
         .widthPx = 640,
         .heightPx = 360,
         .part = Part{330, 190, 120, 90},
         .scale = 2,
         .truth = PaperPanel{"", "pcf_grid", {{"samples", 5}, {"gaussian", 1}}, 256, kRadius5},
         .numbers = {rmse, edgeRipple},
         .panels =
             {{"standard shadow mapping", "hard", {}, 256},
              {"5x5 PCF",
               "pcf_grid",
               {{"samples", 5}, {"bilinear", 0}, {"gaussian", 1}},
               256,
               kRadius5},
              {"5x5 bilinear PCF", "pcf_grid", {{"samples", 5}, {"gaussian", 1}}, 256, kRadius5},
              {"VSM, 5x5 separable Gaussian", "vsm", {{"gaussian", 1}}, 256, kRadius5}},
         .setting = "Samples one texel apart on a map of 256 x 256, weighted by a Gaussian of one "
                    "texel's deviation. Truth: the 5x5 bilinear PCF.",
         .finding =
             "As in the paper: the map of moments, blurred once, gives what 25 bilinear compares a "
             "pixel give, since occluder and receiver are planes here; nearest compares leave "
             "steps. Our Gaussian is separable and wider than five taps, cut at three deviations."},
        {.paper = "variance",
         .name = "variance-4",
         .title = "Fig. 4: light bleeding",
         .scene = "overlapping_spheres",
         .widthPx = 480,
         .heightPx = 270,
         .show = PaperShow::raisedContrast,
         .truth = PaperPanel{"", "pcf_disc", {}, kTruthResolution, 0, 0.06},
         .numbers = {umbraLight},
         .marginPx = 1,  // the lines end at light, and are few pixels long
         .panels = {{"VSM", "vsm", {}, 1024, 0, 0.06}, {"PCF", "pcf_disc", {}, 1024, 0, 0.06}},
         .setting = "Spheres whose shadows overlap, visibility times 4: white is a quarter of the "
                    "light or more. Umbra: where PCF on a map of 4096 x 4096 is dark, in a pixel "
                    "and in those around it.",
         .finding = "As in the paper: where a shadow's edge lies inside another shadow, variance "
                    "maps let light through: the lines across the shadows, where two of them meet. "
                    "PCF leaves none there; the white dots on its spheres lie at the border of "
                    "what faces the light. The number is the mean over all of the umbra, of which "
                    "the lines are a small part. The paper shows a car, ours has spheres as in "
                    "Fig. 3 of Gumbau et al."},
        {.paper = "variance",
         .name = "variance-precision",
         .title = "Section 5.3: 16 against 32 bits",
         .scene = "city",
         .widthPx = 480,
         .heightPx = 270,
         .part = Part{120, 60, 240, 135},
         .scale = 2,
         .heldAgainst = {0, 0, 0, 0},
         .numbers = {rmse},
         .panels = {{"VSM, 32 bits", "vsm", kPlain, 1024, 0, kCityRadiusM},
                    {"VSM, 16 bits", "vsm16", kPlain16, 1024, 0, kCityRadiusM},
                    {"VSM, 16 bits in two halves", "vsm_split", kPlain16, 1024, 0, kCityRadiusM},
                    {"VSM, 16 bits, our constants", "vsm16", {}, 1024, 0, kCityRadiusM}},
         .setting = "The city, whose storeys lie close together in a large range of depths; "
                    "constants as for 32 bits (least variance 1e-6, no depth bias, no slope's "
                    "variance), last those of our table for 16 bits. RMSE against the 32 bits.",
         .finding = "As in the paper, 16 bits fail where depths lie close together, and two halves "
                    "mend most of it. Ours joins and splits the halves around each filter pass in "
                    "the arithmetic of the shader; the paper leaves filters to the texture unit. "
                    "Our constants for 16 bits hide the noise behind a larger least variance: the "
                    "light that then leaks behind casters, storey by storey, is further from the "
                    "32 bits than the noise was."},
        {.paper = "variance",
         .name = "variance-boxes",
         .title = "Filtered maps inside PCSS: mips against summed areas",
         .scene = "planar_occluder",
         .widthPx = 640,
         .heightPx = 360,
         .part = Part{330, 190, 120, 90},
         .scale = 2,
         .heldAgainst = {0, 0, 0},
         .numbers = {rmse, edgeRipple},
         .panels = {{"PCSS, full disc", "pcss", {}, 1024, 0, 0.12},
                    {"PCSS, summed areas", "pcss_sat", {}, 1024, 0, 0.12},
                    {"PCSS, mips", "pcss_mip", {}, 1024, 0, 0.12}},
         .setting = "A wide light over the plate, as in Real-Time Rendering's section on filtered "
                    "shadow maps; the kernel of each pixel is looked up in a summed-area table or "
                    "in a mip chain of moments. Numbers against the full disc.",
         .finding = "The summed areas have the penumbra's own width everywhere; the mips are boxy: "
                    "a level's texels are as large as the kernel, and their grid shows along the "
                    "edge, whatever the size of the map."},
    };
}

std::vector<PaperFigure> powerCdf() {
    return {
        {.paper = "power-cdf",
         .name = "power-cdf-2",
         .title = "Fig. 2: precision of the map",
         .scene = "city",
         .widthPx = 480,
         .heightPx = 270,
         .part = Part{120, 60, 240, 135},
         .scale = 2,
         .heldAgainst = {0, 0, 2, 2, 4, 4},
         .numbers = {rmse},
         .panels =
             {{"VSM, 32 bits", "vsm", kPlain, 1024, 0, kCityRadiusM},
              {"VSM, 16 bits", "vsm16", kPlain16, 1024, 0, kCityRadiusM},
              {"ESM, 32 bits", "esm", {}, 1024, 0, kCityRadiusM},
              {"ESM, 16 bits",
               "esm16",
               {{"bias_depth", 0}, {"exponent", 80}},
               1024,
               0,
               kCityRadiusM},
              {"Power CDF, 32 bits", "power_cdf", {}, 1024, 0, kCityRadiusM},
              {"Power CDF, 16 bits", "power_cdf16", {{"bias_depth", 0}}, 1024, 0, kCityRadiusM}},
         .setting = "The city; in 16 bits with the constants of 32 bits. RMSE of each technique "
                    "against itself in 32 bits.",
         .finding = "As in the paper, 16 bits harm variance maps much and the power CDF little. "
                    "Our exponential map keeps logarithms: what 16 bits take of it is the same "
                    "share of a depth that they take of the power CDF, times the exponent."},
        {.paper = "power-cdf",
         .name = "power-cdf-4",
         .title = "Fig. 4: sharpness",
         .scene = "planar_occluder",
         .widthPx = 640,
         .heightPx = 360,
         .part = Part{330, 190, 120, 90},
         .scale = 2,
         .truth = PaperPanel{"", "pcf_grid", {{"samples", 9}}, 512, 4},
         .numbers = {edgeWidth, edgeRipple},
         .panels = {{"PCF", "pcf_grid", {{"samples", 9}}, 512, 4},
                    {"VSM", "vsm", {}, 512, 4},
                    {"Power CDF", "power_cdf", {}, 512, 4},
                    {"Power CDF, half the map", "power_cdf", {}, 256, 4},
                    {"Power CDF, a quarter of the map", "power_cdf", {}, 128, 4}},
         .setting = "A kernel of 4 texels radius on each map, PCF with 9 x 9 bilinear compares. "
                    "Edge widths across the contour of PCF at 512, ripple against it.",
         .finding =
             "As in the paper the power CDF has sharper edges than PCF under the same kernel. Ours "
             "differs in what follows from it: half the map is already softer than PCF on the "
             "whole one, and at every size the edge carries stair-steps that PCF does not have, "
             "because a receiver that is the greatest depth under the kernel turns dark at once "
             "(docs/techniques.md). A lower resolution does not suffice here."},
    };
}

std::vector<PaperFigure> gradient() {
    const PaperPanel hard{"", "hard", {}, kTruthResolution};
    return {
        {.paper = "gradient",
         .name = "gradient-2",
         .title = "Fig. 4.2.2: free of acne with a tiny bias",
         .scene = "terrain",
         .widthPx = 400,
         .heightPx = 225,
         .truth = hard,
         .numbers = {litLight, litDark},
         .panels =
             {{"GSM, circle of 8, gradient of the receiver", "gsm", {{"pattern", 1}}, 1024, 0.5},
              {"GSM, circle of 8, gradient of the neighbours",
               "gsm",
               {{"gradient", 0}, {"pattern", 1}},
               1024,
               0.5}},
         .setting = "Hills in grazing light, N = 1024, the paper's circle of eight at half a texel "
                    "and our bias of 1/32 of a texel's slope. Lit surfaces: those that a map of "
                    "4096 x 4096 says are lit all around.",
         .finding =
             "The paper shows a picture free of acne; so are ours on lit surfaces but for a few "
             "pixels in a thousand, with the receiver's own gradient and with that of the map's "
             "neighbours, which the paper proposes. Where light hardly touches the hills, near the "
             "edges of their own shadows, a faint moire remains with either."},
        {.paper = "gradient",
         .name = "gradient-3",
         .title = "Fig. 4.2.3: without the offset",
         .scene = "planar_occluder",
         .widthPx = 400,
         .heightPx = 225,
         .truth = hard,
         .numbers = {litLight, litDark},
         .panels =
             {{"depth offset along the gradient", "gsm", {{"gradient", 0}, {"pattern", 1}}, 512, 3},
              {"without", "gsm", {{"gradient", 0}, {"pattern", 1}, {"offsets", 0}}, 512, 3}},
         .setting = "A plate over a plane, N = 512, a circle of eight with a radius of 3 texels, "
                    "gradient of the neighbours.",
         .finding =
             "The failure is the paper's: without the offset the kernel cuts into the receiver, "
             "and lit planes keep little more than half of their light. With it they are lit but "
             "for dots along the plates' rims, where a neighbour's depth is another surface's."},
        {.paper = "gradient",
         .name = "gradient-5",
         .title = "Fig. 4.2.5: rings on a concave surface",
         .scene = "knob",
         .camera = renderer::OrbitCamera{.target = {-0.4F, 0.85F, 0.1F},
                                         .yawDeg = 60,
                                         .pitchDeg = 26,
                                         .distanceM = 4,
                                         .verticalFieldDeg = 36},
         .widthPx = 320,
         .heightPx = 240,
         .truth = hard,
         .numbers = {litLight, litDark},
         .panels =
             {{"gradient of the point, half a texel", "gsm", {{"pattern", 1}}, 256, 0.5},
              {"average gradient, half a texel",
               "gsm",
               {{"gradient", 1}, {"pattern", 1}},
               256,
               0.5},
              {"gradient of the point, 4 texels", "gsm", {{"pattern", 1}}, 256, 4},
              {"average gradient, 4 texels", "gsm", {{"gradient", 1}, {"pattern", 1}}, 256, 4}},
         .setting = "The knob's hollow neck, N = 256. Half a texel is the paper's kernel.",
         .finding = "Ours differs: the rings are there, but the average gradient of the kernel, "
                    "with which the paper finds them less severe, does not lighten them here. Next "
                    "to a hollow it also averages the wall on the other side. With four texels a "
                    "sixth of the lit knob is dark with either: hollow surfaces rise over the "
                    "receiver's plane within the kernel."},
    };
}

std::vector<PaperFigure> perception() {
    constexpr double kSmallM = 0.02, kLargeM = 0.08;
    const auto disc = [](const char* caption, int resolution, double radiusM) {
        return PaperPanel{caption, "pcf_disc", {}, resolution, 0, radiusM};
    };
    const auto soft = [](const char* caption, int resolution, double radiusM) {
        return PaperPanel{caption, "pcss", {}, resolution, 0, radiusM};
    };
    return {
        {.paper = "perception",
         .name = "perception-1",
         .title = "Fig. 1: twice the penumbra, half the map",
         .scene = "planar_occluder",
         .widthPx = 640,
         .heightPx = 360,
         .part = Part{330, 190, 120, 90},
         .scale = 2,
         .numbers = {edgeRipple, rmse},
         .panels = {disc("r, N", 256, 0.04), disc("r, N / 2", 128, 0.04), disc("2 r, N", 256, 0.08),
                    disc("2 r, N / 2", 128, 0.08)},
         .setting = "A disc's kernel of .04 and .08 m on maps of 256 and 128 texels. Ripple is the "
                    "stair-steps along the edge, against the same kernel on a map of 4096 x 4096.",
         .finding = "As in the paper: twice the radius with half the map (last) has the steps and "
                    "the error of the small radius with the full map (first), since both go with r "
                    "/ a alone."},
        {.paper = "perception",
         .name = "perception-7",
         .title = "Fig. 7: full against reduced maps",
         .scene = "yard",
         .widthPx = 480,
         .heightPx = 270,
         .show = PaperShow::lit,
         .numbers = {rmse, edgeRipple},
         .timed = true,
         .panels = {disc("PCF, small filter, full", kTruthResolution, kSmallM),
                    disc("PCF, small filter, reduced", 0, kSmallM),
                    disc("PCF, large filter, full", kTruthResolution, kLargeM),
                    disc("PCF, large filter, reduced", 0, kLargeM),
                    soft("PCSS, small light, full", kTruthResolution, kSmallM),
                    soft("PCSS, small light, reduced", 0, kSmallM),
                    soft("PCSS, large light, full", kTruthResolution, kLargeM),
                    soft("PCSS, large light, reduced", 0, kLargeM)},
         .setting = "The yard at 480 x 270, small (.02 m) and large (.08 m) filters; full maps of "
                    "4096 x 4096, reduced ones as the controller picks them with the published c = "
                    "3.47. Times are of whole frames, all eight in turn.",
         .finding = "The paper reports up to twice the frames on a GeForce GTX 960. Ours gains "
                    "more where the full map has a wide filter, since the full disc reads every "
                    "texel of its kernel, and a software rasteriser pays for each. PCSS looks for "
                    "blockers with 32 texels whatever the map, so full and reduced also differ in "
                    "what the search finds: its RMSE is more than that of the size alone."},
    };
}

}  // namespace

std::string toText(PaperNumber number) {
    switch (number) {
        case rmse:
            return "RMSE";
        case umbraLight:
            return "light in the umbra";
        case litLight:
            return "light on lit surfaces";
        case litDark:
            return "lit surfaces darker than .9, %";
        case edgeWidth:
            return "edge width, px";
        case edgeRipple:
            return "ripple along edges";
    }
    return "unknown number";
}

const std::vector<PaperFigure>& paperFigures() {
    static const std::vector<PaperFigure> all = [] {
        std::vector<PaperFigure> figures;
        for (const auto& paper : {variance(), powerCdf(), gradient(), perception()})
            figures.insert(figures.end(), paper.begin(), paper.end());
        return figures;
    }();
    return all;
}

const PaperFigure& findPaperFigure(const std::string& name) {
    std::string known;
    for (const PaperFigure& figure : paperFigures()) {
        if (figure.name == name) return figure;
        known += (known.empty() ? "" : ", ") + figure.name;
    }
    throw std::invalid_argument("figure \"" + name + "\" is not known; known are: " + known);
}

}  // namespace demo

// SPDX-License-Identifier: MIT
// The table of techniques (technique.h): parameters, exemptions with their reasons, rows.
#include "renderer/technique.h"

namespace renderer {
namespace {

constexpr TechniqueParameter biasTexels(float standard) {
    return {.name = "bias_texels",
            .meaning = "depth bias: change of the receiver plane's depth over this many texels",
            .low = 0,
            .high = 4,
            .standard = standard};
}
/// A rasteriser that snaps vertices to 1/256 texel (GL_SUBPIXEL_BITS 8, as today's do) moves no
/// point of a triangle by more; one with fewer bits needs 2^-bits. More than is needed lights
/// hollow surfaces, which rise over a kernel by little more than the bias: 1/32 left an error of
/// .06 RMSE in the knob at its automatic size, 1/256 leaves .02.
constexpr TechniqueParameter kBiasTexels = biasTexels(1.0F / 256);
/// Of a compare that may see one texel alone: its centre, up to half a texel from the receiver on
/// either axis, may lie on the next facet, whose slope may differ by half from the receiver's.
/// Without it hollow meshes and ground at grazing light have specks along their creases at every N:
/// .39 RMSE in the knob under PCSS at N = 512, .10 with it. Wide kernels have kHollowReaches.
constexpr TechniqueParameter kFacetBiasTexels = biasTexels(0.25F);
/// Of a mean of compares under a wide kernel, beside that: hollow ground rises over the receiver's
/// plane within the kernel and is in its own way at every N, in a pattern of its facets; on rolling
/// terrain at grazing light an eighth of the kernel's radius hides it. A shadow begins that share
/// of its softness later where a caster touches a slope.
constexpr float kHollowReaches = 1.0F / 8;
constexpr TechniqueParameter kGaussian{
    .name = "gaussian",
    .meaning = "prefilter: 0 a box, 1 a Gaussian, of the disc's standard deviation",
    .whole = true};

/// Of PCF kHollowReaches; of a filtered map, whose kernel holds depths before and behind the
/// receiver's own on a sloped plane: a whole reach keeps every plane lit, and takes a shadow away
/// as far from the caster's foot as a slope rises by it, which at grazing light is most of a small
/// shadow. So moments, which nearly tell a plane from two depths, take as little as leaves planes
/// of the built-in scenes lit to the eye; what is left on the steepest ones is `steepDarkening`.
/// (RMSE against the full disc over the terrain at N = 1024: EVSM4 .17 at a whole reach and .11 at
/// a quarter, MSM .18 and .13 at 3/8.)
constexpr TechniqueParameter biasReaches(float standard) {
    return {
        .name = "bias_reaches",
        .meaning = "depth bias: change of the receiver plane's depth over this many kernel reaches",
        .low = 0,
        .high = 2,
        .standard = standard};
}

/// For what a format rounds off a depth in three passes. A GL may round towards zero: a whole step
/// each. ESM stores depths in units of 1/c.
constexpr TechniqueParameter biasDepth(float standard) {
    return {.name = "bias_depth",
            .meaning = "depth bias, as a share of the map's depth range",
            .low = 0,
            .high = 0.1F,
            .standard = standard};
}
/// Of any map that is filtered: what a texel's depths come to is joined as the prefilter joins
/// texels.
constexpr TechniqueParameter kMapSamples{
    .name = "map_samples",
    .meaning =
        "depths in a texel that are averaged, as many as the driver has: 4, or 8; 1 has one "
        "map",
    .low = 1,
    .high = 16,
    .standard = 1,
    .whole = true};
constexpr float kHalfRounding = 3.0F / 2048;  // 11 bits: a step is 2^-11 near 1
constexpr float kSplitRounding = 3.0F / (1 << 20);

constexpr TechniqueParameter kDiscParameters[] = {kBiasTexels, biasReaches(kHollowReaches)};
constexpr TechniqueParameter kHardParameters[] = {kFacetBiasTexels};
constexpr Exemption kHardDoesNot[] = {
    {Property::softnessIndependentOfN, "it has no kernel: its edge is as wide as a texel"}};

constexpr TechniqueParameter kBilinear{
    .name = "bilinear",
    .meaning = "a sample is 0 the nearest texel's compare, 1 the tent of four",
    .standard = 1,
    .whole = true};
constexpr TechniqueParameter kGridParameters[] = {
    kBiasTexels,
    biasReaches(kHollowReaches),
    {.name = "samples",
     .meaning = "samples along the kernel's edge",
     .low = 1,
     .high = 16,
     .standard = 5,
     .whole = true},
    kBilinear,
    {.name = "gaussian",
     .meaning = "weights: 0 alike, 1 a Gaussian of the disc's standard deviation",
     .whole = true}};

constexpr TechniqueParameter kTapParameters[] = {
    kBiasTexels,
    biasReaches(kHollowReaches),
    {.name = "pattern",
     .meaning = "taps of 0 Poisson's, 1 Vogel's pattern",
     .standard = 1,
     .whole = true},
    {.name = "taps",
     .meaning = "taps in the disc",
     .low = 4,
     .high = 64,
     .standard = 25,
     .whole = true},
    kBilinear,
    {.name = "rotated",
     .meaning = "1 turns the taps from pixel to pixel: noise in place of bands",
     .standard = 1,
     .whole = true}};
constexpr Exemption kTapsDoNot[] = {
    {Property::errorFallsWithN, "a fixed number of samples does not see more of a finer map"}};

constexpr TechniqueParameter kPenumbraDistance{
    .name = "distance",
    .meaning =
        "share of the depth range between a blocker and the receiver at which the penumbra "
        "has the kernel's radius",
    .low = 0.001F,
    .high = 10,
    .standard = 0.25F};
constexpr TechniqueParameter kPcssParameters[] = {
    kFacetBiasTexels,
    kPenumbraDistance,
    {.name = "search_taps",
     .meaning = "texels that the search for blockers reads",
     .low = 1,
     .high = 256,
     .standard = 32,
     .whole = true}};
constexpr Exemption kPcssDoesNot[] = {
    {Property::monotoneInDepth, "farther receivers have wider penumbrae"}};

constexpr TechniqueParameter kGradientParameters[] = {
    {.name = "bias",
     .meaning = "depth bias, in texels' worth of slope",
     .low = 0,
     .high = 4,
     .standard = 1.0F / 32},
    {.name = "gradient",
     .meaning = "slope from 0 the map's neighbours, 1 a regression over the taps, 2 the receiver",
     .low = 0,
     .high = 2,
     .standard = 2,
     .whole = true},
    {.name = "pattern",
     .meaning = "places of the taps: 0 Vogel's spiral, 1 a circle of 8, 2 16 of Poisson's",
     .low = 0,
     .high = 2,
     .whole = true},
    {.name = "taps",
     .meaning = "taps of the spiral",
     .low = 3,
     .high = 64,
     .standard = 16,
     .whole = true},
    {.name = "offsets",
     .meaning = "1 lets the receiver's depth follow the slope to each tap",
     .standard = 1,
     .whole = true},
    {.name = "most_slope",
     .meaning = "steepest slope of the map's, in depth ranges per extent of the map",
     .low = 0.1F,
     .high = 100,
     .standard = 4}};
constexpr TechniqueParameter kStoredGradientParameters[] = {
    kGradientParameters[0], kGradientParameters[2], kGradientParameters[3], kGradientParameters[5]};
constexpr Exemption kStoredGradientDoesNot[] = {
    kTapsDoNot[0],
    {Property::planeLit,
     "at a surface's rim the stored slope is partly that of what lies behind it"}};

/// vsm.glsl. The floor of the variance lies above what rounding makes of it: some steps of the mean
/// square, each 2^-24 near 1 in 32 bits and 2^-12 in 16.
struct VarianceParameters {
    TechniqueParameter all[7];
};
constexpr VarianceParameters varianceParameters(float depthBias, float leastVariance) {
    return {{kBiasTexels,
             biasDepth(depthBias),
             kGaussian,
             {.name = "least_variance",
              .meaning = "least variance, in squares of the map's depth range",
              .low = 0,
              .high = 0.01F,
              .standard = leastVariance},
             {.name = "bleeding",
              .meaning = "light bleeding reduction: visibility that becomes 0",
              .low = 0,
              .high = 0.95F,
              .standard = 0},
             {.name = "derivative",
              .meaning = "weight of the variance that a texel's own slope has",
              .low = 0,
              .high = 1,
              .standard = 1},
             kMapSamples}};
}
constexpr TechniqueParameter kLeastVariance = varianceParameters(0, 1e-6F).all[3];
constexpr TechniqueParameter kBleeding = varianceParameters(0, 1e-6F).all[4];
constexpr TechniqueParameter kDerivative = varianceParameters(0, 1e-6F).all[5];
constexpr VarianceParameters kVariance32 = varianceParameters(0, 1e-6F);
constexpr VarianceParameters kVariance16 = varianceParameters(kHalfRounding, 1.0F / 2048);
constexpr VarianceParameters kVarianceSplit = varianceParameters(kSplitRounding, 1.0F / (1 << 19));

constexpr TechniqueParameter kSampledVarianceParameters[] = {
    kBiasTexels,
    kGaussian,
    kLeastVariance,
    kBleeding,
    kDerivative,
    {.name = "samples",
     .meaning = "smaller kernels along the kernel's edge",
     .low = 1,
     .high = 8,
     .standard = 3,
     .whole = true},
    kMapSamples};
/// A box of any width over texels of even depth: on a slope its mean is off by
/// up to f (1 - f) / (2 w) of a texel, w its width and f what w has beyond a
/// whole number. A mip level's mean is exact.
constexpr TechniqueParameter kBoxBiasTexels = biasTexels(1.0F / 8);
constexpr TechniqueParameter kSummedVarianceParameters[] = {kBoxBiasTexels, kLeastVariance,
                                                            kBleeding, kDerivative, kMapSamples};
constexpr TechniqueParameter kMipVarianceParameters[] = {
    kBiasTexels,
    kLeastVariance,
    kBleeding,
    kDerivative,
    {.name = "anisotropy",
     .meaning = "most probes along the longer side of a pixel's footprint; 1 "
                "takes its level there",
     .low = 1,
     .high = 16,
     .standard = 16,
     .whole = true},
    kMapSamples};
constexpr Exemption kMipsDoNot[] = {
    {Property::errorFallsWithN,
     "the level of a kernel has texels as large as the kernel, whatever N"}};
constexpr TechniqueParameter kVariancePenumbraParameters[] = {
    kBoxBiasTexels, kLeastVariance, kBleeding, kDerivative, kPenumbraDistance, kMapSamples};
constexpr Exemption kMipPenumbraDoesNot[] = {kPcssDoesNot[0], kMipsDoNot[0]};

/// esm.glsl.
struct ExponentialParameters {
    TechniqueParameter all[5];
};
constexpr ExponentialParameters exponentialParameters(float depthBias, float exponent) {
    return {{kBiasTexels,
             biasDepth(depthBias),
             kGaussian,
             {.name = "exponent",
              .meaning = "c of exp(c (z - d)), per depth range: light leaks within about 1/c",
              .low = 1,
              .high = 1000,
              .standard = exponent},
             kMapSamples}};
}
constexpr ExponentialParameters kExponential32 = exponentialParameters(0, 80);
/// Up to 64 a step is 1/32, which is 2^-11 of the depth range; beyond, twice as much.
constexpr ExponentialParameters kExponential16 = exponentialParameters(kHalfRounding, 64);
constexpr Exemption kExponential16DoesNot[] = {
    {Property::errorFallsWithN,
     "the depth bias for what 16 bits round off, times the exponent, lightens penumbrae by a "
     "tenth, whatever N"},
    {Property::softnessIndependentOfN, "that bias narrows penumbrae"}};

/// Beyond this one the squares of a wide kernel's texels, summed before they are divided, are not
/// finite in 32 bits: those of 6,000 texels are.
constexpr float kMostWarp = 40;
constexpr TechniqueParameter kPositiveExponent{.name = "positive_exponent",
                                               .meaning = "c of the warp exp(c (2 z - 1))",
                                               .low = 1,
                                               .high = kMostWarp,
                                               .standard = 40};
constexpr TechniqueParameter kLeastDeviation{
    .name = "least_deviation",
    .meaning = "least standard deviation of depth, as a share of the depth range",
    .low = 0,
    .high = 0.1F,
    .standard = 1e-4F};
constexpr TechniqueParameter kEvsm2Parameters[] = {kBiasTexels, kGaussian, kPositiveExponent,
                                                   kLeastDeviation, kMapSamples};
constexpr TechniqueParameter kEvsm4Parameters[] = {kBiasTexels,
                                                   biasReaches(0.25F),
                                                   kGaussian,
                                                   kPositiveExponent,
                                                   {.name = "negative_exponent",
                                                    .meaning = "k of the warp -exp(-k (2 z - 1))",
                                                    .low = 1,
                                                    .high = kMostWarp,
                                                    .standard = 20},
                                                   kLeastDeviation,
                                                   kMapSamples};

/// msm.glsl and msm16.glsl.
struct MomentParameters {
    TechniqueParameter all[6];
};
constexpr MomentParameters momentParameters(float depthBias, float momentBias) {
    return {{kBiasTexels,
             biasReaches(0.375F),
             biasDepth(depthBias),
             kGaussian,
             {.name = "moment_bias",
              .meaning = "alpha: how far moments are moved towards possible ones",
              .low = 0,
              .high = 0.1F,
              .standard = momentBias},
             kMapSamples}};
}
constexpr float kMomentDarkening = 1.0F / 512;  // half an 8-bit level, of the moments' bias
// Smaller ones leave noise where the kernel finds depths that are nearly one: at 3e-7 in 32 bits up
// to .07 of visibility, at 1e-5 in 16 bits anything.
constexpr MomentParameters kMoments32 = momentParameters(0, 3e-6F);
constexpr MomentParameters kMoments16 = momentParameters(2e-4F, 6e-5F);

/// The series of few terms is steep where a plane lies, so it asks for more.
constexpr TechniqueParameter kConvolutionParameters[] = {
    biasTexels(1.0F / 32),
    biasDepth(1e-3F),
    kGaussian,
    {.name = "terms",
     .meaning = "M, terms of the series",
     .low = 1,
     .high = 8,
     .standard = 8,
     .whole = true},
    {.name = "damping",
     .meaning = "a of exp(-a (k/M)^2): less ringing, more light close behind occluders",
     .low = 0,
     .high = 10,
     .standard = 1},
    {.name = "scale",
     .meaning = "factor of the series, which is 1/2 where a receiver is its own occluder",
     .low = 1,
     .high = 4,
     .standard = 2},
    kMapSamples};
constexpr std::string_view kRings = "a series of few terms rings behind occluders, whatever N";
constexpr Exemption kConvolutionDoesNot[] = {{Property::monotoneInDepth, kRings},
                                             {Property::errorFallsWithN, kRings}};

constexpr TechniqueParameter depthLayers(float standard) {
    return {.name = "layers",
            .meaning =
                "layers of depth, cut where the map's depths lie; auto: as few as layer_deviation "
                "asks for",
            .low = 0,
            .high = 16,
            .standard = standard,
            .whole = true,
            .zeroIsAuto = true};
}
/// A bound bleeds v / (v + g^2) of light at a distance g behind depths of variance v: at .05 a
/// fifth at a tenth of the range, a hundredth at half of it.
constexpr TechniqueParameter kLayerDeviation{
    .name = "layer_deviation",
    .meaning =
        "of automatic layers: the depths' standard deviation within them, as a share of the depth "
        "range",
    .low = 0.005F,
    .high = 0.3F,
    .standard = 0.05F};

constexpr TechniqueParameter kLayerParameters[] = {
    kBiasTexels,
    biasReaches(0.75F),
    kGaussian,
    depthLayers(0),
    kLayerDeviation,
    {.name = "least_variance",
     .meaning = "least variance, in squares of a layer's depth range",
     .low = 0,
     .high = 0.01F,
     .standard = 1e-6F},
    {.name = "bleeding",
     .meaning = "light bleeding reduction: visibility that becomes 0",
     .low = 0,
     .high = 0.95F,
     .standard = 0},
    kMapSamples};

struct PowerParameters {
    TechniqueParameter all[7];
};
constexpr PowerParameters powerParameters(float depthBias) {
    return {{kBiasTexels, biasReaches(1), biasDepth(depthBias), kGaussian, depthLayers(1),
             kLayerDeviation, kMapSamples}};
}
constexpr PowerParameters kPower32 = powerParameters(0);
constexpr PowerParameters kPower16 = powerParameters(kHalfRounding);
constexpr Exemption kPowerDoesNot[] = {
    {Property::errorFallsWithN,
     "a receiver that is the greatest depth under the kernel is dark: shadows are wider by the "
     "kernel, whatever N"},
    {Property::softnessIndependentOfN,
     "for that, on a receiver parallel to the map a shadow's edge is as wide as a texel"}};

constexpr std::string_view kPcfPaper =
    "Reeves, Salesin, Cook 1987, Rendering antialiased shadows with depth maps";
constexpr std::string_view kVariancePaper = "Donnelly, Lauritzen 2006, Variance shadow maps";
constexpr std::string_view kVariancePenumbraPaper =
    "Yang, Dong, Feng, Seidel, Kautz 2010, Variance soft shadow mapping";
constexpr std::string_view kWarpedPaper = "Lauritzen, McCool 2008, Layered variance shadow maps";
constexpr std::string_view kMomentPaper = "Peters, Klein 2015, Moment shadow mapping";
constexpr std::string_view kPowerPaper =
    "Gumbau, Szirmay-Kalos, Sbert, Chover 2011, Improving shadow map filtering with statistical "
    "analysis";
constexpr std::string_view kSeparableCost =
    "4 texels a pixel; the prefilter 2 (1.7 r/a + 1) texels a texel: grows with N^3 at constant "
    "softness";

constexpr Technique kTechniques[] = {
    {.name = "hard",
     .title = "Hard shadow",
     .paper = "Williams 1978, Casting curved shadows on curved surfaces",
     .soft = false,
     .parameters = kHardParameters,
     .doNotHold = kHardDoesNot,
     .cost = "1 texel a pixel"},
    {.name = "pcf_disc",
     .title = "PCF, full disc",
     .paper = kPcfPaper,
     .parameters = kDiscParameters,
     .cost = "pi (r/a)^2 texels a pixel, four to a gather: grows with N^2 at constant softness"},
    {.name = "pcf_grid",
     .title = "PCF, grid",
     .paper = kPcfPaper,
     .parameters = kGridParameters,
     .doNotHold = kTapsDoNot,
     .cost = "samples^2 texels a pixel, four times as many bilinearly; independent of N"},
    {.name = "pcf_taps",
     .title = "PCF, Poisson or Vogel taps",
     .paper = kPcfPaper,
     .parameters = kTapParameters,
     .doNotHold = kTapsDoNot,
     .cost = "one texel a tap, four bilinearly; independent of N"},
    {.name = "pcss",
     .title = "PCSS, full disc",
     .paper = "Fernando 2005, Percentage-closer soft shadows",
     .parameters = kPcssParameters,
     .doNotHold = kPcssDoesNot,
     .cost = "search_taps texels a pixel and where blockers are pi (r/a)^2 of the local radius"},
    {.name = "gsm",
     .title = "Gradient PCF",
     .paper = "Schueler 2006, Multisampling extension for gradient shadow maps",
     .parameters = kGradientParameters,
     .doNotHold = kTapsDoNot,
     .cost = "4 texels a tap, 8 with regression; independent of N"},
    {.name = "gsm_stored",
     .title = "Gradient PCF, stored gradient",
     .paper = "Schueler 2006, Multisampling extension for gradient shadow maps",
     .format = MapFormat::rgba32f,
     .prefilter = Prefilter::converted,
     .parameters = kStoredGradientParameters,
     .doNotHold = kStoredGradientDoesNot,
     .cost = "4 texels a tap and 4 more, each four times as large; independent of N"},
    {.name = "vsm",
     .title = "Variance, 32 bits",
     .paper = kVariancePaper,
     .format = MapFormat::rg32f,
     .prefilter = Prefilter::mean,
     .parameters = kVariance32.all,
     .cost = kSeparableCost},
    {.name = "vsm16",
     .title = "Variance, 16 bits",
     .paper = kVariancePaper,
     .file = "vsm",
     .format = MapFormat::rg16f,
     .prefilter = Prefilter::mean,
     .parameters = kVariance16.all,
     .cost = kSeparableCost},
    {.name = "vsm_split",
     .title = "Variance, 2 x 16 bits",
     .paper = kVariancePaper,
     .file = "vsm",
     .format = MapFormat::rg16fSplit,
     .prefilter = Prefilter::mean,
     .parameters = kVarianceSplit.all,
     .cost = kSeparableCost},
    {.name = "vsm_samples",
     .title = "Variance, several samples",
     .paper = "Akenine-Moeller, Haines, Hoffman, Real-Time Rendering, Filtered "
              "shadow maps",
     .format = MapFormat::rg32f,
     .prefilter = Prefilter::mean,
     .parameters = kSampledVarianceParameters,
     .cost = "4 texels a sample; the prefilter that of a kernel as many times "
             "narrower"},
    {.name = "vsm_mip",
     .title = "Variance, mip chain",
     .paper = kVariancePaper,
     .format = MapFormat::rg32f,
     .prefilter = Prefilter::mips,
     .parameters = kMipVarianceParameters,
     .doNotHold = kMipsDoNot,
     .cost = "8 texels a probe; the prefilter 4/3 texels a texel, whatever the "
             "kernel"},
    {.name = "vsm_sat",
     .title = "Variance, summed-area table",
     .paper = "Lauritzen 2007, Summed-area variance shadow maps",
     .format = MapFormat::rg32ui,
     .prefilter = Prefilter::sums,
     .parameters = kSummedVarianceParameters,
     .cost = "16 texels a pixel; the prefilter 2 texels a texel, whatever the "
             "kernel"},
    {.name = "pcss_sat",
     .title = "PCSS, variance by sums",
     .paper = kVariancePenumbraPaper,
     .format = MapFormat::rg32ui,
     .prefilter = Prefilter::sums,
     .parameters = kVariancePenumbraParameters,
     .doNotHold = kPcssDoesNot,
     .cost = "32 texels a pixel; the prefilter 2 texels a texel, whatever the "
             "kernel"},
    {.name = "pcss_mip",
     .title = "PCSS, variance by mips",
     .paper = kVariancePenumbraPaper,
     .format = MapFormat::rg32f,
     .prefilter = Prefilter::mips,
     .parameters = kVariancePenumbraParameters,
     .doNotHold = kMipPenumbraDoesNot,
     .cost = "16 texels a pixel; the prefilter 4/3 texels a texel, whatever "
             "the kernel"},
    {.name = "esm",
     .title = "Exponential",
     .paper = "Annen, Mertens, Seidel, Flerackers, Kautz 2008, Exponential shadow maps",
     .format = MapFormat::r32f,
     .prefilter = Prefilter::logMean,
     .parameters = kExponential32.all,
     .cost = kSeparableCost},
    {.name = "esm16",
     .title = "Exponential, 16 bits",
     .paper = "Annen, Mertens, Seidel, Flerackers, Kautz 2008, Exponential shadow maps",
     .file = "esm",
     .format = MapFormat::r16f,
     .prefilter = Prefilter::logMean,
     .parameters = kExponential16.all,
     .doNotHold = kExponential16DoesNot,
     .cost = kSeparableCost},
    {.name = "evsm2",
     .title = "Exponential variance, 2 moments",
     .paper = kWarpedPaper,
     .format = MapFormat::rg32f,
     .prefilter = Prefilter::mean,
     .parameters = kEvsm2Parameters,
     .cost = kSeparableCost},
    {.name = "evsm4",
     .title = "Exponential variance, 4 moments",
     .paper = kWarpedPaper,
     .format = MapFormat::rgba32f,
     .prefilter = Prefilter::mean,
     .parameters = kEvsm4Parameters,
     .steepDarkening = 0.01F,
     .cost = kSeparableCost},
    {.name = "msm",
     .title = "Moments, 32 bits",
     .paper = kMomentPaper,
     .format = MapFormat::rgba32f,
     .prefilter = Prefilter::mean,
     .parameters = kMoments32.all,
     .planeDarkening = kMomentDarkening,
     .steepDarkening = 0.25F,
     .cost = kSeparableCost},
    {.name = "msm16",
     .title = "Moments, 16 bits",
     .paper = kMomentPaper,
     .format = MapFormat::rgba16,
     .prefilter = Prefilter::mean,
     .parameters = kMoments16.all,
     .planeDarkening = kMomentDarkening,
     .steepDarkening = 0.02F,
     .cost = kSeparableCost},
    {.name = "csm",
     .title = "Convolution",
     .paper = "Annen, Mertens, Bekaert, Seidel, Kautz 2007, Convolution shadow maps",
     .format = MapFormat::rgba16f,
     .prefilter = Prefilter::mean,
     .termsParameter = "terms",
     .parameters = kConvolutionParameters,
     .doNotHold = kConvolutionDoesNot,
     .cost = "4 texels a pixel and two terms; the prefilter that of a map for every two terms"},
    {.name = "lvsm",
     .title = "Layered variance",
     .paper = kWarpedPaper,
     .format = MapFormat::rgba32f,
     .prefilter = Prefilter::mean,
     .termsParameter = "layers",
     .parameters = kLayerParameters,
     .planeDarkening = 1e-6F,  // rounding of a full layer before the receiver's
     .steepDarkening = 0.2F,
     .cost = "4 texels a pixel and two layers; the prefilter that of a map for every two layers"},
    {.name = "power_cdf",
     .title = "Power CDF, 32 bits",
     .paper = kPowerPaper,
     .format = MapFormat::rgba32f,
     .prefilter = Prefilter::minMaxMean,
     .termsParameter = "layers",
     .termsPerTexel = 1,
     .parameters = kPower32.all,
     .doNotHold = kPowerDoesNot,
     .cost = "4 texels a pixel; the prefilter that of a map for every layer"},
    {.name = "power_cdf16",
     .title = "Power CDF, 16 bits",
     .paper = kPowerPaper,
     .file = "power_cdf",
     .format = MapFormat::rgba16f,
     .prefilter = Prefilter::minMaxMean,
     .termsParameter = "layers",
     .termsPerTexel = 1,
     .parameters = kPower16.all,
     .doNotHold = kPowerDoesNot,
     .cost = "4 texels a pixel; the prefilter that of a map for every layer"},
};

}  // namespace

std::span<const Technique> techniques() {
    return kTechniques;
}

}  // namespace renderer

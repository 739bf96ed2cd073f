// SPDX-License-Identifier: MIT
// What a visible point asks of the shadow map, and the histogram of that over a frame.
//
// A point in penumbra whose filter radius is r (as a fraction of the map's extent) asks for
// N = c / r texels (F. Kreuzer, "Using Perception-Based Filtering to Hide Shadow Artifacts",
// section 6). A texel smaller than a screen pixel cannot be seen, so it never asks for more than
// k / sigma, sigma being the pixel's footprint on the map. That also answers contact shadows, where
// r -> 0 would ask for an infinite map.
//
//     resolution_controller::DemandHistogram histogram;
//     for (each sampled pixel in penumbra) {
//         const float sigma = pixelFootprint(duvDpixel);
//         histogram.add(demand(c, radiusUv, sigma), demandWeight(shownRadiusUv, sigma));
//     }
//
// shownRadiusUv is max(radiusUv, minRadiusUv) where a texel is larger than a pixel, radiusUv
// elsewhere: what is asked is for the filter as the light would have it, what is seen is as drawn.
//
// What is seen is the edge of a shadow, so points count by how much of it they stand for: one whose
// penumbra is forty pixels across counts a fortieth of one at a sharp edge. Counted by area, the
// widest penumbrae, which ask for the least, would outvote all others.
//
// The bins are found from the bits of the float, without a logarithm, so that a GPU that does the
// same fills the same histogram; from there on there are only integers.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace resolution_controller {

/// d(uv) / d(pixel) of the light-space coordinate, as dFdx and dFdy give it.
struct UvDerivatives {
    float dudx = 0, dvdx = 0, dudy = 0, dvdy = 0;
};

/// sigma: the smaller singular value of the derivatives, but at least a quarter of the larger one
/// (grazing light would otherwise ask for infinity where N.L leaves little contrast). In uv per
/// pixel; 0, which stands for "no bound", when the derivatives are all zero or not finite.
float pixelFootprint(const UvDerivatives& derivatives) noexcept;

/// N(p) = min(c / radiusUv, pixelBound / footprint), in texels. radiusUv 0 is a hard contact and
/// asks for as much as the pixel shows (+inf without a footprint). `pixelBound` is k, 1 by default.
/// 0, which add() rejects, when radiusUv is NaN, negative or infinite, or c is not positive and
/// finite. A footprint that is not positive and finite sets no bound.
float demand(float c, float radiusUv, float footprint, float pixelBound = 1) noexcept;

/// Weight of a point that stands for a pixel of a shadow's edge, and the largest.
inline constexpr std::uint32_t kWholeDemandWeight = 64;

/// How much of a shadow's edge a point in penumbra stands for, in 64ths of a pixel: 1 pixel over
/// the penumbra's width across, 2 shownRadiusUv / footprint; rounded, 1 to kWholeDemandWeight. 1
/// where the footprint is not positive and finite or the radius is NaN, negative or infinite, so
/// that all points count alike where nothing is known of pixels.
///
/// The radius is the one that the picture shows, after enlargement to minRadiusUv: the points of a
/// contact whose filter is enlarged to a band of 14 pixels count a 14th each, as that band has 14
/// of them for each pixel of its edge.
std::uint32_t demandWeight(float shownRadiusUv, float footprint) noexcept;

/// What a light asks of every point, fixed for a frame; demandRule() of resolution_controller.h
/// fills it from settings.
struct DemandRule {
    float c = 3.47f;             ///< slope of r = c a
    float pixelBound = 1;        ///< k: texels per pixel that can still be seen
    float contrastExponent = 0;  ///< e of c(C) = c max(C, .02)^e; 0: off
    float texelsPerCaster = 2;   ///< texels across the thinnest caster; 0: off
};

/// What one visible point in penumbra brings along.
struct DemandPoint {
    float radiusUv = 0;   ///< filter radius, as a fraction of the map's extent
    float footprint = 0;  ///< pixelFootprint(); 0: no bound
    float contrast = 1;   ///< of the shadow's edge here, [0, 1]: 1 is full light against none
    /// Width on the map of the thinnest caster that shades the point, as a fraction of the map's
    /// extent; 0: not known, or none is thin. A wide filter lets the law ask for texels that a thin
    /// bar slips through (Kreuzer, section 7); this asks for enough to hit it.
    float casterWidthUv = 0;
};

/// N(p) = min(max(c(C) / r, texels per caster / its width), k / sigma), with what the plain form
/// above makes of unusable numbers: a contrast outside [0, 1] counts as 1 and a width that is not
/// positive and finite as none.
float demand(const DemandRule& rule, const DemandPoint& point) noexcept;

/// log2 histogram of demands: bin b counts N in (2^(b/4), 2^((b+1)/4)]; the first also what is
/// smaller, the last also what is larger. Points count by their demandWeight(), or all alike.
/// Laid out as the buffer that a GPU fills; 67 million whole weights fill a counter.
struct DemandHistogram {
    static constexpr std::size_t kBins = 64;

    std::array<std::uint32_t, kBins> counts{};
    std::uint32_t rejected = 0;  ///< demands that were NaN, zero or negative

    constexpr void add(float demandedTexels, std::uint32_t weight = 1) noexcept {
        const int bin = binOf(demandedTexels);
        (bin < 0 ? rejected : counts[static_cast<std::size_t>(bin)]) += weight;
    }

    constexpr DemandHistogram& operator+=(const DemandHistogram& other) noexcept {
        for (std::size_t b = 0; b < kBins; ++b) counts[b] += other.counts[b];
        rejected += other.rejected;
        return *this;
    }

    /// Takes back what was added earlier.
    constexpr DemandHistogram& operator-=(const DemandHistogram& other) noexcept {
        for (std::size_t b = 0; b < kBins; ++b) counts[b] -= other.counts[b];
        rejected -= other.rejected;
        return *this;
    }

    constexpr std::uint64_t total() const noexcept {
        std::uint64_t sum = 0;
        for (const std::uint32_t count : counts) sum += count;
        return sum;
    }

    /// -1 for NaN, zero and negative numbers.
    static constexpr int binOf(float demandedTexels) noexcept {
        const auto bits = std::bit_cast<std::uint32_t>(demandedTexels);
        constexpr std::uint32_t infinity = 0x7f800000u;
        if (bits == 0 || bits > infinity) return -1;  // the sign bit makes it larger, too
        // The mantissas of the largest floats up to 2^(1/4), 2^(1/2) and 2^(3/4).
        const std::uint32_t mantissa = bits & 0x7fffffu;
        const int quarter =
            (mantissa > 0) + (mantissa > 1587184u) + (mantissa > 3474675u) + (mantissa > 5719292u);
        const int bin = 4 * (static_cast<int>(bits >> 23) - 127) + quarter - 1;
        return bin < 0 ? 0 : bin >= static_cast<int>(kBins) ? static_cast<int>(kBins) - 1 : bin;
    }

    /// Texels that satisfy every demand of the bin: its upper edge, rounded up. Of the last bin,
    /// which has no upper edge, 65536.
    static constexpr std::int32_t upperEdge(std::size_t bin) noexcept {
        constexpr std::array<double, 4> quarters{1.189207115002721, 1.4142135623730951,
                                                 1.681792830507429, 2.0};
        const double edge = quarters[bin % 4] * static_cast<double>(1 << (bin / 4));
        const auto whole = static_cast<std::int32_t>(edge);
        return whole < edge ? whole + 1 : whole;
    }

    bool operator==(const DemandHistogram&) const = default;
};
static_assert(sizeof(DemandHistogram) == 65 * sizeof(std::uint32_t));

/// The histograms of the last frames together. Where a frame asks a share of its pixels, others
/// each time, its own histogram leaves the percentile to the few pixels that happened to be asked,
/// and since sizes rise at once the largest of such guesses would stand. As many frames as it takes
/// to ask every pixel once say the same in every frame of a still view as long as every reading is
/// added; where a ring of read-backs overwrites or skips one, the pixels it asked are missing until
/// their turn comes again.
///
/// What is new is heard once it has (1 - percentile) of the sum's weight: an edge with a share s of
/// the weight after about frames x (1 - percentile) / s frames. With 16 frames and .98, an edge of
/// 5 % after 7 frames, one of a third or more in the next.
///
///     RecentDemand recent(16);  // once for each light
///     while (reading = ...) recent.add(*reading);  // every frame: all that the GPU has finished
///     controller.update(recent.sum());
///     recent.clear();  // at a camera cut; then add nothing drawn before it
class RecentDemand {
  public:
    static constexpr int kMostFrames = 64;

    /// `frames` that count, 1 to kMostFrames; what is outside is taken to the nearer end.
    explicit constexpr RecentDemand(int frames = 1) noexcept
        : frames_(frames < 1 ? 1 : frames > kMostFrames ? kMostFrames : frames) {}

    constexpr int frames() const noexcept { return frames_; }

    /// The sum with the newest frame's histogram in place of the oldest's. `newest` may be sum().
    constexpr const DemandHistogram& add(const DemandHistogram& newest) noexcept {
        DemandHistogram& oldest = last_[static_cast<std::size_t>(next_)];
        const DemandHistogram added = newest;  // which changes with the sum where it is the sum
        sum_ += added;
        sum_ -= oldest;
        oldest = added;
        next_ = (next_ + 1) % frames_;
        return sum_;
    }

    constexpr const DemandHistogram& sum() const noexcept { return sum_; }

    constexpr void clear() noexcept { *this = RecentDemand(frames_); }

  private:
    std::array<DemandHistogram, kMostFrames> last_{};
    DemandHistogram sum_{};
    int frames_ = 1;
    int next_ = 0;
};

}  // namespace resolution_controller

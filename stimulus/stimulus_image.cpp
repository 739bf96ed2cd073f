// SPDX-License-Identifier: MIT
#include "stimulus/stimulus_image.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "stimulus/sentence.h"

namespace stimulus {
namespace {

enum class Edge { artifact, straight };

void validate(const StimulusOptions& o) {
    Silhouette{o.silhouette};  // throws
    validate(o.kernel);
    validateLitLevel(o.litLevel);
    require(o.windowPx >= 1 && o.windowPx <= kMaxWindowPx, "window", o.windowPx, " px",
            "must be in 1..8192");
    require(std::abs(o.roving.shiftPx) <= o.windowPx, "shift", o.roving.shiftPx, " px",
            "must lie within plus or minus the window");
    require(o.roving.quarterTurns >= 0 && o.roving.quarterTurns <= 3, "number of quarter turns",
            o.roving.quarterTurns, "", "must be 0, 1, 2 or 3");
    const double texels = 2 * reach(o.kernel.shape) * o.kernel.radiusPx / o.silhouette.artifactPx;
    require(texels <= 20000, "number of texels across the kernel", texels, "",
            "must be at most 20000 (smaller radius or larger artifact)");
    require(!o.taps || (o.taps->taps >= 1 && o.taps->taps <= kMostTaps), "number of taps",
            o.taps ? o.taps->taps : 0, "", "must be in 1..256");
    require(!o.taps || o.kernel.shape == KernelShape::disc, "kernel of turned taps",
            static_cast<double>(o.kernel.shape), "", "must be the disc");
    require(o.noiseLevels >= 0 && o.noiseLevels <= 255, "noise", o.noiseLevels, " levels",
            "must be in [0, 255]");
}

enum class Purpose : std::uint32_t { taps, noise, dither };

/// A generator for each purpose and image, so that one does not shift the numbers of another.
std::mt19937_64 engineFor(const StimulusOptions& o, Edge edge, Purpose purpose) {
    std::seed_seq seeds{static_cast<std::uint32_t>(o.seed),
                        static_cast<std::uint32_t>(o.seed >> 32), static_cast<std::uint32_t>(edge),
                        static_cast<std::uint32_t>(purpose)};
    return std::mt19937_64(seeds);
}

double uniform(std::mt19937_64& rng) {
    return static_cast<double>(rng() >> 11) * 0x1p-53;
}

/// Standard normal numbers, two at a time (G. Marsaglia, T. Bray, "A convenient method for
/// generating normal variables", SIAM Review 1964); std::normal_distribution is not the same
/// everywhere.
class NormalNumbers {
  public:
    explicit NormalNumbers(const std::mt19937_64& rng) : rng_(rng) {}

    double next() {
        if (spare_) return *std::exchange(spare_, std::nullopt);
        while (true) {
            const double x = 2 * uniform(rng_) - 1, y = 2 * uniform(rng_) - 1;
            const double square = x * x + y * y;
            if (square >= 1 || square == 0) continue;
            const double scale = std::sqrt(-2 * std::log(square) / square);
            spare_ = y * scale;
            return x * scale;
        }
    }

  private:
    std::mt19937_64 rng_;
    std::optional<double> spare_;
};

/// Columns of pixels of one period, each a run of values from the lowest row that any copy needs.
/// Pixel (column, row above the bottom) of the image is at
/// columns[column % dx][row - (column / dx) * dy + rowsBelow].
template <typename Value>
struct PeriodColumns {
    int dx = 0, dy = 0;
    int rowsBelow = 0;
    std::vector<std::vector<Value>> columns;
};

struct Grid {
    double left, bottom;  // centre of the lowest, leftmost pixel before shifts
};

Grid gridOf(int windowPx) {
    const double corner = -(windowPx / 2) + 0.5;
    return {corner, corner};
}

template <typename Value>
PeriodColumns<Value> emptyPeriod(const std::optional<Period>& period, int windowPx) {
    PeriodColumns<Value> result{.dx = windowPx, .dy = 0, .rowsBelow = 0, .columns = {}};
    if (period && period->dx < windowPx) {
        result.dx = period->dx;
        result.dy = period->dy;
        result.rowsBelow = (windowPx - 1) / period->dx * period->dy;
    }
    result.columns.resize(static_cast<std::size_t>(result.dx));
    return result;
}

/// The straight edge at the angle that the observer sees.
Silhouette silhouetteOf(const StimulusOptions& o, Edge edge) {
    const Silhouette silhouette(o.silhouette);
    const bool tilted = edge == Edge::straight && o.roving.straightTiltDeg;
    return tilted ? silhouette.withStraightEdgeAt(*o.roving.straightTiltDeg) : silhouette;
}

/// Fills the columns with toValue(V). Columns of pixels that are known to be equal are converted
/// once.
template <typename Value, typename ToValue>
PeriodColumns<Value> evaluatePeriod(const StimulusOptions& o, Edge edge, ToValue toValue) {
    const Silhouette silhouette = silhouetteOf(o, edge);
    auto result = emptyPeriod<Value>(
        edge == Edge::artifact ? silhouette.artifactPeriod() : silhouette.straightPeriod(),
        o.windowPx);

    const auto [left, imageBottom] = gridOf(o.windowPx);
    const double bottom = imageBottom - o.roving.shiftPx - result.rowsBelow;
    const auto rows = static_cast<std::size_t>(o.windowPx + result.rowsBelow);
    std::vector<double> values(rows);
    ArtifactColumns artifact(silhouette, o.kernel, bottom, rows);
    std::optional<std::int64_t> lastSoleTexel;
    for (std::size_t c = 0; c < result.columns.size(); ++c) {
        const double x = left + static_cast<double>(c);
        if (edge == Edge::artifact) {
            const auto soleTexel = artifact.soleTexel(x);
            if (soleTexel && soleTexel == lastSoleTexel) {
                result.columns[c] = result.columns[c - 1];
                continue;
            }
            lastSoleTexel = soleTexel;
            artifact.evaluate(x, values);
        } else {
            for (std::size_t row = 0; row < rows; ++row)
                values[row] =
                    straightVisibility(silhouette, o.kernel, x, bottom + static_cast<double>(row));
        }
        result.columns[c].resize(rows);
        std::transform(values.begin(), values.end(), result.columns[c].begin(), toValue);
    }
    return result;
}

template <typename Value>
cv::Mat copied(const PeriodColumns<Value>& period, int windowPx) {
    cv::Mat image(windowPx, windowPx, cv::DataType<Value>::type);
    for (int row = 0; row < windowPx; ++row) {
        Value* pixels = image.ptr<Value>(windowPx - 1 - row);
        int source = row + period.rowsBelow;
        for (int start = 0; start < windowPx; start += period.dx, source -= period.dy) {
            const int count = std::min(period.dx, windowPx - start);
            for (int c = 0; c < count; ++c)
                pixels[start + c] =
                    period.columns[static_cast<std::size_t>(c)][static_cast<std::size_t>(source)];
        }
    }
    return image;
}

/// Mirror and quarter turns: permutations of the pixels.
cv::Mat oriented(cv::Mat image, const Roving& roving) {
    if (roving.mirror) cv::flip(image, image, 1);
    if (roving.quarterTurns == 1) cv::rotate(image, image, cv::ROTATE_90_COUNTERCLOCKWISE);
    if (roving.quarterTurns == 2) cv::rotate(image, image, cv::ROTATE_180);
    if (roving.quarterTurns == 3) cv::rotate(image, image, cv::ROTATE_90_CLOCKWISE);
    return image;
}

/// Every pixel the mean of its taps.
cv::Mat tapVisibilityImage(const StimulusOptions& o, Edge edge) {
    const double radius = o.kernel.radiusPx;
    const SharpEdges edges(silhouetteOf(o, edge), o.windowPx / 2.0 + 1 + radius);
    const std::vector<Point> taps = poissonTaps(o.taps->taps);
    std::mt19937_64 rng = engineFor(o, edge, Purpose::taps);
    Point turn = randomDirection(rng);
    const auto [left, bottom] = gridOf(o.windowPx);
    cv::Mat image(o.windowPx, o.windowPx, CV_64FC1);
    for (int row = 0; row < image.rows; ++row) {
        const double y = bottom - o.roving.shiftPx + (o.windowPx - 1 - row);
        for (int c = 0; c < image.cols; ++c) {
            if (o.taps->turn == TapTurn::perPixel) turn = randomDirection(rng);
            const double atX = left + c;
            if (const auto all = edge == Edge::artifact ? edges.artifactAround(atX, y, radius)
                                                        : edges.straightAround(atX, y, radius)) {
                image.at<double>(row, c) = *all;
                continue;
            }
            double lit = 0;
            for (const Point& tap : taps) {
                const double x = atX + radius * (turn.x * tap.x - turn.y * tap.y);
                const double tapY = y + radius * (turn.y * tap.x + turn.x * tap.y);
                lit += edge == Edge::artifact ? edges.artifact(x, tapY) : edges.straight(x, tapY);
            }
            image.at<double>(row, c) = lit / o.taps->taps;
        }
    }
    return image;
}

cv::Mat visibilityImage(const StimulusOptions& options, Edge edge) {
    validate(options);
    if (options.taps) return tapVisibilityImage(options, edge);
    const auto same = [](double v) { return v; };
    return copied(evaluatePeriod<double>(options, edge, same), options.windowPx);
}

/// Codes with what is random about them.
cv::Mat randomCodes(const StimulusOptions& o, Edge edge) {
    const cv::Mat visibility = visibilityImage(o, edge);
    cv::Mat codes(visibility.size(), CV_8UC1);
    std::mt19937_64 dither = engineFor(o, edge, Purpose::dither);
    NormalNumbers noise(engineFor(o, edge, Purpose::noise));
    for (int row = 0; row < codes.rows; ++row)
        for (int c = 0; c < codes.cols; ++c) {
            const double added = o.noiseLevels > 0 ? o.noiseLevels * noise.next() : 0;
            codes.at<std::uint8_t>(row, c) =
                roundedCode(visibility.at<double>(row, c), o.litLevel, o.encoding, added,
                            o.dither ? uniform(dither) : kHalfUp);
        }
    return codes;
}

cv::Mat codeImage(const StimulusOptions& options, Edge edge) {
    if (options.taps || options.noiseLevels > 0 || options.dither)
        return oriented(randomCodes(options, edge), options.roving);
    validate(options);
    const auto toCode = [&](double v) {
        return displayCode(v, options.litLevel, options.encoding);
    };
    const auto period = evaluatePeriod<std::uint8_t>(options, edge, toCode);
    return oriented(copied(period, options.windowPx), options.roving);
}

}  // namespace

cv::Mat artifactImage(const StimulusOptions& options) {
    return codeImage(options, Edge::artifact);
}

cv::Mat straightImage(const StimulusOptions& options) {
    return codeImage(options, Edge::straight);
}

cv::Mat artifactVisibilityImage(const StimulusOptions& options) {
    return oriented(visibilityImage(options, Edge::artifact), options.roving);
}

cv::Mat straightVisibilityImage(const StimulusOptions& options) {
    return oriented(visibilityImage(options, Edge::straight), options.roving);
}

}  // namespace stimulus

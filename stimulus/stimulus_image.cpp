// SPDX-License-Identifier: MIT
#include "stimulus/stimulus_image.h"

#include <algorithm>
#include <random>
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
}

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

/// Fills the columns with toValue(V). Columns of pixels that are known to be equal are converted
/// once.
template <typename Value, typename ToValue>
PeriodColumns<Value> evaluatePeriod(const StimulusOptions& o, Edge edge, ToValue toValue) {
    Silhouette silhouette(o.silhouette);
    if (edge == Edge::straight && o.roving.straightTiltDeg)
        silhouette = silhouette.withStraightEdgeAt(*o.roving.straightTiltDeg);
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

cv::Mat visibilityImage(const StimulusOptions& options, Edge edge) {
    validate(options);
    const auto same = [](double v) { return v; };
    return copied(evaluatePeriod<double>(options, edge, same), options.windowPx);
}

cv::Mat dithered(const cv::Mat& visibility, const StimulusOptions& o, std::uint64_t seed) {
    cv::Mat codes(visibility.size(), CV_8UC1);
    std::mt19937_64 rng(seed);
    for (int row = 0; row < codes.rows; ++row)
        for (int c = 0; c < codes.cols; ++c) {
            const double uniform = static_cast<double>(rng() >> 11) * 0x1p-53;
            codes.at<std::uint8_t>(row, c) =
                ditheredCode(visibility.at<double>(row, c), o.litLevel, o.encoding, uniform);
        }
    return codes;
}

cv::Mat codeImage(const StimulusOptions& options, Edge edge) {
    if (options.ditherSeed) {
        const std::uint64_t seed =
            edge == Edge::artifact ? *options.ditherSeed : ~*options.ditherSeed;
        return oriented(dithered(visibilityImage(options, edge), options, seed), options.roving);
    }
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

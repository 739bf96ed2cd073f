// SPDX-License-Identifier: MIT
// The two outlines of one stimulus: the shadow's edge as a shadow map of texel size a samples it
// (the artifact, stair-steps), and the straight edge that was sampled (the true silhouette).
// Kreuzer, "Using Perception-Based Filtering to Hide Shadow Artifacts", section 4.1: the study
// needs no scene, only these outlines and a filter.
//
//   const Silhouette stair({.pattern = Pattern::stair, .artifactPx = 10});
//   stair.height(stair.texelAt(x));     // the artifact's edge above x
//   stair.distance(x, y);               // to the true silhouette
//
// Axes: screen pixels, y up, origin at a pixel corner in the middle of the window, pixel centres at
// half-integers; lit above the edge, in shadow below. Texel column k is [k w, (k + 1) w), its edge
// is level at height(k), and heights never fall from left to right.
//
//   stair  w = a, heights k a; true silhouette y = x - a/2 (45 degrees), which bisects the stair:
//          any other phase leaves a shift that no filter removes
//   step   w = L, heights (k + 1/2) a: risers of height a at x = 0 and +-L; y = (a/L) x
//   line   w = a, heights a round(height of the line at the column's centre / a); y = tan(angle) x,
//          shifted by -a/(2q) where the slope is p/q with p and q odd. There the line passes
//          half-way between two texels in every q-th column, the rounded heights lie off it by
//          a/(2q) on average, and with the shift they are centred. line(45) is the stair.
//
// Everything is moved up by verticalPhasePx. The default keeps the edges off pixel centres and the
// filtered values off the tie at code 127.5.
#pragma once

#include <cstdint>
#include <optional>

namespace stimulus {

enum class Pattern { stair, step, line };

struct SilhouetteOptions {
    Pattern pattern = Pattern::stair;
    double artifactPx = 10;         ///< a > 0, up to kMaxSizePx; risers lie on pixel edges if whole
    double angleDeg = 45;           ///< of a line alone, in (0, 45]
    double riserSpacingPx = 600;    ///< L, of a step alone, a..kMaxSizePx; in studies the window
    double verticalPhasePx = 0.25;  ///< in [-1, 1]
};

/// Sizes above this are refused, px: larger than any screen, and safe in every index computation.
inline constexpr double kMaxSizePx = 65536;
inline constexpr int kMaxWindowPx = 8192;  ///< edge of an image

/// A translation by whole pixels that leaves a pattern as it is.
struct Period {
    int dx = 0, dy = 0;
};

class Silhouette {
  public:
    /// Throws std::invalid_argument that names the value and the rule.
    explicit Silhouette(const SilhouetteOptions& options);

    const SilhouetteOptions& options() const { return options_; }

    /// The artifact's edge.
    double texelWidth() const { return width_; }
    std::int64_t texelAt(double x) const;
    double riser(std::int64_t k) const { return width_ * static_cast<double>(k); }
    double height(std::int64_t k) const;

    /// The true silhouette: y = (rise / run) x + intercept.
    double run() const { return run_; }
    double rise() const { return rise_; }
    double intercept() const { return intercept_; }
    double angleDeg() const;
    double cosAngle() const { return run_ / length_; }
    double sinAngle() const { return rise_ / length_; }
    double distance(double x, double y) const;  ///< signed, positive on the lit side, px

    /// The farthest the two edges lie apart, measured vertically, px (an upper bound for lines).
    double maxDeviationPx() const;

    /// After how many pixels an edge and its place in the pixel grid repeat. Nothing where they do
    /// not, and where the coordinates of the copies would round differently: the copies have the
    /// same bits. Artifact: stair (a, a) and step (L, a), for whole a and L, or multiples of 1/2,
    /// 1/4 or 1/8 px two, four or eight times as far. Straight edge: stair (1, 1), step (L, a) in
    /// lowest terms.
    std::optional<Period> artifactPeriod() const;
    std::optional<Period> straightPeriod() const;

    /// The same silhouettes with the straight edge turned to another angle about (0, intercept):
    /// roving of the straight panel. Angle in (-45, 45), degrees; throws otherwise.
    Silhouette withStraightEdgeAt(double angleDeg) const;

  private:
    SilhouetteOptions options_;
    double width_ = 0, run_ = 1, rise_ = 1, length_ = 1, intercept_ = 0;
    double lineShift_ = 0;  // of the line, in texels
};

/// Angle of the true silhouette, degrees: stair 45, step atan(a/L), line its own. Throws as above.
double trueAngleDeg(const SilhouetteOptions& options);

}  // namespace stimulus

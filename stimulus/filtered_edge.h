// SPDX-License-Identifier: MIT
// The filtered stimulus at one point, in closed form: the exact continuous convolution of a
// silhouette with a kernel. Supersampling is not enough: one sample per pixel is off by up to 3.9
// codes, 8 x 8 by 0.2 to 0.75.
//
//   V = 1 - sum over texel columns k of [Q(x_{k+1} - x, h_k - y) - Q(x_k - x, h_k - y)]
//
// with risers x_k, heights h_k and Q(u, v) the kernel's mass in {x < u, y < v} (kernel.h), only the
// columns that the kernel touches. The straight edge is the kernel's mass in a half plane.
//
// Values lie in [0, 1], are exactly 1 where the kernel touches no shadow and exactly 0 where it
// touches no light. At radius 0 a point on an edge is 1/2, at a corner 1/4 or 3/4.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "stimulus/kernel.h"
#include "stimulus/silhouette.h"

namespace stimulus {

/// V at (x, y). Arguments are taken as valid: finite coordinates, a kernel that validate() accepts.
double artifactVisibility(const Silhouette& silhouette, const Kernel& kernel, double x, double y);
double straightVisibility(const Silhouette& silhouette, const Kernel& kernel, double x, double y);

/// V of the artifact within kError, several times as fast, from a table of the kernel's marginal:
/// for searches that look at a million places.
class ApproximateArtifact {
  public:
    static constexpr double kError = 5e-6;

    explicit ApproximateArtifact(KernelShape shape);

    /// The kernel must have the shape of the table and a radius > 0.
    double visibility(const Silhouette& silhouette, const Kernel& kernel, double x, double y) const;

  private:
    std::vector<double> table_;  // of the marginal, from -reach to reach
};

/// The artifact on whole columns of pixels, from left to right: the same bits as
/// artifactVisibility(), with each marginal evaluated once instead of once per pixel.
///
///   ArtifactColumns columns(silhouette, kernel, bottomY, rows);
///   for (x ascending) columns.evaluate(x, values);   // values[j] at y = bottomY + j
class ArtifactColumns {
  public:
    ArtifactColumns(const Silhouette& silhouette, const Kernel& kernel, double bottomY,
                    std::size_t rows);

    /// `values` has `rows` places. x may not fall from call to call.
    void evaluate(double x, std::span<double> values);

    /// The texel column, where the kernel at x touches one alone: V is the same for every such x.
    std::optional<std::int64_t> soleTexel(double x) const;

  private:
    // A tread as the rows see it: shadow reaches up to its height in column k.
    struct Tread {
        std::int64_t k = 0;
        std::size_t firstRow = 0;              // rows below it are in its full shadow
        std::vector<double> v{}, marginalV{};  // of the rows from there on that it partly shades
    };
    struct Riser {
        double u = 0, mass = 0;  // of the kernel to its left
    };

    Tread treadOf(std::int64_t k) const;
    void moveTo(double x);
    template <KernelShape shape>
    void addShadows(std::span<double> inShadow) const;

    Silhouette silhouette_;
    Kernel kernel_;
    double bottomY_;
    std::size_t rows_;
    std::deque<Tread> treads_;   // of the columns that the kernel touches, ascending
    std::vector<Riser> risers_;  // left of each tread, and right of the last
};

}  // namespace stimulus

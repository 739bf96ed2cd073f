// SPDX-License-Identifier: MIT
// The filtered edges by numerical integration, sharing no formula with stimulus/: the silhouettes
// and the kernels' densities are written out again from their definitions, and every mass is a
// Gauss-Legendre sum. Integrands are cut where they bend, so the rule converges to about 1e-12.
#pragma once

#include <functional>
#include <vector>

#include "stimulus/kernel.h"
#include "stimulus/silhouette.h"

namespace numerical {

/// Height of an edge above x; `bends` are the x where it jumps.
struct EdgeCurve {
    std::function<double(double x)> height;
    std::function<std::vector<double>(double low, double high)> bends;
};

EdgeCurve artifactCurve(const stimulus::SilhouetteOptions& options);
EdgeCurve straightCurve(const stimulus::SilhouetteOptions& options);

/// V at (x, y): the kernel's mass above the edge. Radius > 0.
double visibility(const EdgeCurve& edge, const stimulus::Kernel& kernel, double x, double y);

/// The kernel's mass in {x < u, y < v}, lengths in units of the radius.
double quadrantMass(stimulus::KernelShape shape, double u, double v);

}  // namespace numerical

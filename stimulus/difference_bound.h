// SPDX-License-Identifier: MIT
// How fast the difference e between the filtered artifact and the filtered straight edge can change
// from place to place and from radius to radius. With it a few evaluations prove that a whole
// region stays below a threshold, where evaluating every pixel at every radius would take minutes
// (reference_radius.cpp).
//
// Coordinates of a place, so that the kernel's features keep theirs as it grows: s along the true
// silhouette (px), delta = distance from it divided by the radius. e is the kernel's integral over
// the mismatch of the two edges (+1, -1 or 0), which lies in a band of half-width b about the
// silhouette. Its derivatives are at most the flow of the kernel's density across its boundary
// (box, disc) or of its gradient (Gaussian) inside the band, whatever the shape of the mismatch.
#pragma once

#include "stimulus/kernel.h"

namespace stimulus {

/// |de/ds| <= along / r,  |de/ddelta| <= across,  |de/dr| <= (inRadius + 2 |e|) / r at fixed delta.
struct DifferenceBound {
    double along = 0, across = 0, inRadius = 0;
};

/// Holds at every delta' within `spread` of delta, for kernels of any radius r with
/// b / r <= bandHalfWidth. The angle is that of the true silhouette to the x axis.
DifferenceBound differenceBound(KernelShape shape, double delta, double spread,
                                double bandHalfWidth, double cosAngle, double sinAngle);

}  // namespace stimulus

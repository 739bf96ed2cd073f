// SPDX-License-Identifier: MIT
// Everything that a technique's file may use, in an order in which each file needs only the ones before it;
// shader_math.h has the same list for C++.
#include "shared/blocks.glsl"
#include "shared/receiver.glsl"
#include "shared/depth_compare.glsl"
#include "shared/disc_kernel.glsl"
#include "shared/disc_visibility.glsl"
#include "shared/taps.glsl"
#include "shared/gradient_compare.glsl"
#include "shared/filtered_map.glsl"
#include "shared/chebyshev.glsl"
#include "shared/exponential_warp.glsl"
#include "shared/hamburger.glsl"
#include "shared/depth_layers.glsl"
#include "shared/summed_map.glsl"
#include "shared/mip_map.glsl"
#include "shared/penumbra_estimate.glsl"

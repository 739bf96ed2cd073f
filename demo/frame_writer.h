// SPDX-License-Identifier: MIT
// Frames for a study (records/frame_manifest.h): one view with shadow maps of many sizes at one
// softness, each beside the same view with a converged map. With them the study asks whether the
// slope measured on plane edges holds where shadows are rendered.
#pragma once

#include <filesystem>
#include <functional>

#include "records/run_context.h"
#include "renderer/renderer.h"

namespace demo {

/// r / a of the frames: from where nobody overlooks the stair-steps to where nobody should see
/// them, in steps finer than what a staircase can tell (2^(1/4); posterior sd of a run: 0.04
/// log10).
inline constexpr double kLeastFrameRatio = 0.75, kMostFrameRatio = 12,
                        kFrameRatioStep = 1.189207115;
/// The converged map has this many times the texels of the largest other one along its edge.
inline constexpr int kConvergedFactor = 3;

struct FramePlan {
    const renderer::Technique* technique = nullptr;  ///< with a kernel
    renderer::ParameterValues parameters{};
    double radiusUv = 0;  ///< > 0
    int samples = 2;      ///< along a pixel's edge
};

/// Writes pictures and manifest into the folder, created where it is missing. The view must be
/// square. a and r are given in screen px by the median footprint over the penumbra; r / a is
/// exact. `onFrame` is called after each of frameCount() renderings. Throws std::invalid_argument
/// (a technique without a kernel, a softness that this driver's largest map cannot converge, a view
/// that is not square or shows no penumbra), std::runtime_error (a manifest is there already, the
/// folder is not writable).
void writeFrames(const std::filesystem::path& folder, renderer::Renderer& frame,
                 const renderer::GlInfo& info, const FramePlan& plan,
                 const records::RunContext& context, const std::function<void()>& onFrame = {});

int frameCount();  ///< with the converged one

}  // namespace demo

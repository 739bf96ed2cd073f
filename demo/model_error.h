// SPDX-License-Identifier: MIT
// Model errors: how far each technique on a fine map is from the area light that its softness
// stands for. Independent of N, without a bound, and never mixed with the resolution error of the
// sweep.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "demo/swept_technique.h"
#include "records/run_context.h"
#include "renderer/gl_context.h"

namespace demo {

struct ModelErrorSettings {
    std::vector<std::string> scenes;
    std::vector<SweptTechnique> techniques;
    int resolution = 2048;  ///< of all maps
    int widthPx = 320, heightPx = 180;
    int raysEdge = 16;  ///< AreaLight::raysEdge
    std::filesystem::path folder;
};

inline const std::vector<std::string> kModelErrorColumns = {"scene",       "technique",
                                                            "resolution",  "sun_radius_deg",
                                                            "rays",        "standard_error",
                                                            "penumbra_px", "rmse",
                                                            "max",         "p95",
                                                            "bias"};

/// Writes model_errors.tsv into the folder, and the truth's images into its folder "truth", where
/// the next run finds them. The light is the one for which PCSS at its default `distance` has the
/// scene's softness.
void measureModelErrors(const renderer::GlInfo& info, const ModelErrorSettings& settings,
                        const records::RunContext& context);

}  // namespace demo

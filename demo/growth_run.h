// SPDX-License-Identifier: MIT
// How the cost of a frame grows with each thing that it depends on, one at a time: map size, taps,
// casters' triangles, lights, viewport pixels. Visits go round all of them in turns, so that
// whatever else the machine does falls on all.
//
// The journal growth_times.tsv in the folder holds one line for each visit; a killed run goes on
// with it.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "demo/growth_exponent.h"
#include "records/run_context.h"
#include "renderer/gl_context.h"
#include "renderer/technique.h"

namespace demo {

/// What grows, in the order of the report.
enum class GrowthAxis { mapSize, taps, triangles, lights, pixels };
inline constexpr GrowthAxis kGrowthAxes[] = {GrowthAxis::mapSize, GrowthAxis::taps,
                                             GrowthAxis::triangles, GrowthAxis::lights,
                                             GrowthAxis::pixels};
std::string_view toText(GrowthAxis axis);

struct GrowthSettings {
    std::string scene = "planar_occluder";  ///< built in, few triangles (they are split), no lamps
    /// Those with a parameter "taps" are also measured over taps.
    std::vector<const renderer::Technique*> techniques;
    int rounds = 5;                     ///< visits of each value, >= 1
    int widthPx = 640, heightPx = 360;  ///< where the viewport does not grow
    std::filesystem::path folder;
    /// Divides map edges, pixels and triangles, for tests; >= 1.
    int reduction = 1;

    /// Throws std::invalid_argument that names the field, its value and its range.
    void validate() const;
};

inline const std::vector<std::string> kGrowthColumns = {
    "axis",     "scene",        "technique",  "value",     "round", "frame_ms",
    "depth_ms", "prefilter_ms", "prepass_ms", "lookup_ms", "lit_ms"};

/// Measures what the journal does not hold yet.
void measureGrowth(const renderer::GlInfo& info, const GrowthSettings& settings,
                   const records::RunContext& context);

/// Medians over the visits of one pass ("frame_ms", "depth_ms", ...) with one technique along an
/// axis, and their power.
struct Growth {
    std::string axis, scene, technique, pass;
    std::vector<std::pair<double, double>> medians;  ///< value, ms
    GrowthExponent exponent;
};
/// Passes that a technique does not have are left out. Throws what readTsv() throws.
std::vector<Growth> readGrowth(const std::filesystem::path& folder);
/// Whether the folder has a growth_times.tsv.
bool hasGrowth(const std::filesystem::path& folder);

/// The table growth_fits.tsv beside the journal, as text.
std::string growthTable(const std::vector<Growth>& all);

}  // namespace demo

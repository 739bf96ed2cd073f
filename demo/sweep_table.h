// SPDX-License-Identifier: MIT
// What the journals of a sweep say (sweep.h), one cell for each frame, technique and size.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "demo/ripple_counts.h"
#include "demo/spread.h"
#include "demo/sweep.h"

namespace demo {

struct SweepCell {
    std::string scene;
    int frame = 0;
    std::string technique;
    int resolution = 0;

    std::string status = "ok";  ///< or why there are no numbers
    Spread frameMs;
    std::array<double, 5> passMs{};  ///< depth, prefilter, prepass, lookup, lit; 0: none
    double mapBytes = 0;

    int reference = 0;  ///< size against which the errors are; its own are 0
    double radiusUv = 0;
    double penumbraPx = 0, rmse = 0, most = 0, p95 = 0, bias = 0, ssim = 0;
    double shareBeyondLevel = 0, shareBeyond2Percent = 0, shareBeyond5Percent = 0;
    double rippleP95 = 0, rippleMost = 0;
    RippleCounts ripples;
    double edgeWidthRatio = 0, thinPx = 0, thinLost = 0, thinRmse = 0;
    double flickerLight = 0, flickerOrbit = 0, flickerSize = 0;  ///< NaN where not measured

    bool measured() const { return status == "ok"; }
    /// Quartiles further apart than a quarter of the median, or too few visits to know.
    bool noisy() const;
};

struct SweepTable {
    std::vector<std::string> scenes, techniques;  ///< in the order of the journals
    int frames = 0;
    std::vector<int> sizes;
    std::vector<SweepCell> cells;
    /// policy -> one size for each step of its parameter, by scene, frame and technique.
    std::map<std::string, std::vector<int>> policySizes;
    std::string context;

    const SweepCell* find(const std::string& scene, int frame, const std::string& technique,
                          int resolution) const;
    /// Whether errors against this cell's reference mean what those of other cells do: it is at
    /// least half of the sweep's largest size. Where larger ones were skipped it may be as coarse
    /// as the cell itself.
    bool convergedAgainst(const SweepCell& cell) const {
        return !sizes.empty() && 2 * cell.reference >= sizes.back();
    }
    /// Null where the journals do not have it.
    const std::vector<int>* sizesOf(const std::string& policy, const std::string& scene, int frame,
                                    const std::string& technique) const;

  private:
    friend SweepTable readSweep(const std::filesystem::path& folder);
    std::map<std::string, std::size_t> index_;
};

/// All journals in the folder, shards too; of a cell that is in several, the last errors count and
/// the times of all. Throws std::runtime_error where there is none or one cannot be read.
SweepTable readSweep(const std::filesystem::path& folder);

}  // namespace demo

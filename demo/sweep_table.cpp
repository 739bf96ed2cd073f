// SPDX-License-Identifier: MIT
#include "demo/sweep_table.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "demo/sweep_context.h"
#include "demo/tsv_journal.h"

namespace demo {
namespace {

constexpr double kMostSpread = 0.25;

std::string keyOf(const std::string& scene, int frame, const std::string& technique) {
    return scene + "\t" + std::to_string(frame) + "\t" + technique;
}

template <class Value>
void addIfNew(std::vector<Value>& values, const Value& value) {
    if (std::find(values.begin(), values.end(), value) == values.end()) values.push_back(value);
}

/// All journals of a name, shards too.
TsvTable readAll(const std::filesystem::path& folder, const std::string& name,
                 const std::vector<std::string>& columns) {
    std::vector<std::filesystem::path> files;
    if (std::filesystem::is_directory(folder))
        for (const auto& entry : std::filesystem::directory_iterator(folder)) {
            const std::string file = entry.path().filename().string();
            if (file.starts_with(name + ".") && file.ends_with(".tsv"))
                files.push_back(entry.path());
        }
    if (files.empty())
        throw std::runtime_error((folder / (name + ".tsv")).string() + ": there is no sweep");
    std::sort(files.begin(), files.end());
    TsvTable all(files.front().string(), columns);
    for (const auto& file : files) {
        const TsvTable one = readTsv(file);
        all.append(one);
        if (all.context().empty()) all.setContext(one.context());
        for (const std::string& difference :
             contextDifferences(all.context(), one.context(), {"plan"}))
            throw std::runtime_error(file.string() + ": is of another sweep than " +
                                     files.front().string() + ": " + difference);
    }
    return all;
}

void takeErrors(SweepCell& cell, const TsvRow& row) {
    const auto number = [&](const char* column) { return row.number(column); };
    cell.reference = row.whole("reference");
    cell.radiusUv = number("radius_uv");
    cell.penumbraPx = number("penumbra_px");
    cell.rmse = number("rmse");
    cell.most = number("max");
    cell.p95 = number("p95");
    cell.bias = number("bias");
    cell.shareBeyondLevel = number("share_beyond_level");
    cell.shareBeyond2Percent = number("share_beyond_2_percent");
    cell.shareBeyond5Percent = number("share_beyond_5_percent");
    cell.ssim = number("ssim");
    cell.rippleP95 = number("ripple_p95");
    cell.rippleMost = number("ripple_max");
    cell.ripples = row.wholes("ripple_counts");
    cell.edgeWidthRatio = number("edge_width_ratio");
    cell.thinPx = number("thin_px");
    cell.thinRmse = number("thin_rmse");
    cell.thinLost = number("thin_lost");
    cell.flickerLight = number("flicker_light");
    cell.flickerOrbit = number("flicker_orbit");
    cell.flickerSize = number("flicker_size");
}

}  // namespace

bool SweepCell::noisy() const {
    return frameMs.count < 3 || frameMs.p75 - frameMs.p25 > kMostSpread * frameMs.median;
}

const SweepCell* SweepTable::find(const std::string& scene, int frame, const std::string& technique,
                                  int resolution) const {
    const auto found =
        index_.find(keyOf(scene, frame, technique) + "\t" + std::to_string(resolution));
    return found == index_.end() ? nullptr : &cells[found->second];
}

const std::vector<int>* SweepTable::sizesOf(const std::string& policy, const std::string& scene,
                                            int frame, const std::string& technique) const {
    const auto found = policySizes.find(policy + "\t" + keyOf(scene, frame, technique));
    return found == policySizes.end() ? nullptr : &found->second;
}

SweepTable readSweep(const std::filesystem::path& folder) {
    SweepTable table;
    std::vector<std::vector<double>> frameMs;
    const TsvTable times = readAll(folder, "sweep_times", kSweepTimeColumns);
    table.context = times.context();
    const auto cellOf = [&](const TsvRow& row) -> std::size_t {
        const std::string& scene = row.text("scene");
        const std::string& technique = row.text("technique");
        const int frame = row.whole("frame");
        const int resolution = row.whole("resolution");
        const auto [found, isNew] = table.index_.try_emplace(
            keyOf(scene, frame, technique) + "\t" + std::to_string(resolution), table.cells.size());
        if (isNew) {
            SweepCell& cell = table.cells.emplace_back();
            cell.scene = scene;
            cell.frame = frame;
            cell.technique = technique;
            cell.resolution = resolution;
            frameMs.emplace_back();
            addIfNew(table.scenes, scene);
            addIfNew(table.techniques, technique);
            addIfNew(table.sizes, resolution);
            table.frames = std::max(table.frames, frame + 1);
        }
        return found->second;
    };
    for (const TsvRow& row : times.rows()) {
        const std::size_t index = cellOf(row);
        SweepCell& cell = table.cells[index];
        if (row.text("status") != "ok") {
            cell.status = row.text("status");
            continue;
        }
        frameMs[index].push_back(row.number("frame_ms"));
        if (row.whole("round") > 0) continue;
        cell.mapBytes = row.number("map_bytes");
        constexpr std::array<const char*, 5> kPassColumns = {"depth_ms", "prefilter_ms",
                                                             "prepass_ms", "lookup_ms", "lit_ms"};
        for (std::size_t pass = 0; pass < kPassColumns.size(); ++pass) {
            const double ms = row.number(kPassColumns[pass]);
            cell.passMs[pass] = std::isnan(ms) ? 0 : ms;
        }
    }
    for (std::size_t i = 0; i < table.cells.size(); ++i)
        table.cells[i].frameMs = spreadOf(frameMs[i]);
    std::sort(table.sizes.begin(), table.sizes.end());

    const TsvTable errors = readAll(folder, "sweep_errors", kSweepErrorColumns);
    for (const TsvRow& row : errors.rows()) takeErrors(table.cells[cellOf(row)], row);
    for (SweepCell& cell : table.cells)
        if (cell.measured() && cell.reference == 0) cell.status = "unfinished";

    const TsvTable policies = readAll(folder, "sweep_policies", kSweepPolicyColumns);
    for (const TsvRow& row : policies.rows())
        table.policySizes[row.text("policy") + "\t" +
                          keyOf(row.text("scene"), row.whole("frame"), row.text("technique"))] =
            row.wholes("sizes");
    return table;
}

}  // namespace demo

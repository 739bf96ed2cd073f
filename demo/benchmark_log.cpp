// SPDX-License-Identifier: MIT
#include "demo/benchmark_log.h"

#include <cstdio>
#include <sstream>

namespace demo {
namespace {

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

struct Column {
    std::string name, value;
};

std::vector<Column> columnsOf(const BenchmarkCell& cell) {
    std::vector<Column> columns = {
        {"scene", cell.scene},
        {"technique", std::string(cell.technique->name)},
        {"resolution_mode", cell.chosen.automatic ? "auto" : "fixed"},
        {"resolution", std::to_string(cell.chosen.resolution)},
        {"reason", cell.chosen.reason},
        {"radius_m", number(cell.softness.radiusM)},
        {"radius_uv", number(cell.softness.radiusUv)},
        {"min_radius_uv", number(cell.chosen.minRadiusUv)},
        {"need", cell.chosen.automatic ? std::to_string(cell.chosen.need) : "n/a"},
        {"map_bytes", std::to_string(cell.mapBytes)},
        {"frame_ms", number(cell.frameMs.median)},
        {"frame_ms_p25", number(cell.frameMs.p25)},
        {"frame_ms_p75", number(cell.frameMs.p75)},
        {"frames", std::to_string(cell.frameMs.count)}};
    for (const renderer::Pass pass : renderer::kAllPasses) {
        const Spread& spread = cell.passesMs.passes[static_cast<std::size_t>(pass)];
        const std::string name = std::string(toText(pass)) + "_ms";
        const bool had = spread.count > 0;
        columns.push_back({name, had ? number(spread.median) : "n/a"});
        columns.push_back({name + "_p25", had ? number(spread.p25) : "n/a"});
        columns.push_back({name + "_p75", had ? number(spread.p75) : "n/a"});
    }
    const VisibilityError& error = cell.error;
    columns.push_back({"is_reference", cell.isReference ? "1" : "0"});
    columns.push_back({"penumbra_px", std::to_string(error.penumbraPixels)});
    columns.push_back({"rmse", number(error.rmse)});
    columns.push_back({"max", number(error.most)});
    columns.push_back({"p95", number(error.p95)});
    columns.push_back({"bias", number(error.bias)});
    columns.push_back({"share_beyond_level", number(error.shareBeyondLevel)});
    columns.push_back({"share_beyond_2_percent", number(error.shareBeyond2Percent)});
    columns.push_back({"share_beyond_5_percent", number(error.shareBeyond5Percent)});
    return columns;
}

void addRow(std::ostringstream& out, const std::vector<Column>& columns,
            std::string Column::*part) {
    for (std::size_t i = 0; i < columns.size(); ++i)
        out << (i == 0 ? "" : "\t") << columns[i].*part;
    out << "\n";
}

}  // namespace

std::string benchmarkLog(const BenchmarkResult& result, const records::RunContext& context,
                         const LoadedSlope& slope) {
    std::ostringstream out;
    std::istringstream lines(records::contextText(context) + "\ntiming " + result.timing +
                             "\nslope " + slope.text);
    for (std::string line; std::getline(lines, line);)
        if (!line.empty()) out << "# " << line << "\n";
    bool first = true;
    for (const BenchmarkGroup& group : result.groups)
        for (const BenchmarkCell& cell : group.cells) {
            const std::vector<Column> columns = columnsOf(cell);
            if (first) addRow(out, columns, &Column::name);
            first = false;
            addRow(out, columns, &Column::value);
        }
    return out.str();
}

}  // namespace demo

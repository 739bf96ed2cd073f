// SPDX-License-Identifier: MIT
// The slope that the programs size their maps with: a study's or the published one, for the
// audience that was asked for.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "resolution_controller/audience.h"

namespace CLI {
class App;
}

namespace demo {

/// What the command line says of it.
struct SlopeOptions {
    std::optional<std::filesystem::path> file;  ///< slope.json; absent: the published slope
    std::optional<double> detection, people;    ///< of the audience, where given
};
/// --slope, --detection, --people with their ranges.
void addSlopeOptions(CLI::App& app, SlopeOptions& options);

struct LoadedSlope {
    resolution_controller::Slope slope;  ///< c for that audience
    std::string text;                    ///< c as it was measured, with its terms, for people
    std::vector<std::string> notes;      ///< in what it was measured otherwise than it is used here
    std::string file;                    ///< empty for the published slope
};

/// Throws what records::readSlope throws, and std::invalid_argument for an audience that slopeFor()
/// refuses.
LoadedSlope loadSlope(const std::optional<std::filesystem::path>& file,
                      const resolution_controller::Audience& audience = {});
LoadedSlope loadSlope(const SlopeOptions& options);

}  // namespace demo

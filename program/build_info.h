// SPDX-License-Identifier: MIT
// What was built: goes into `--version` and into the context block of every output file.
#pragma once

#include <string>

namespace program {

struct BuildInfo {
    std::string version;    ///< project version, e.g. "0.1.0"
    std::string revision;   ///< git commit, with "-dirty" when tracked files had changes; "unknown"
                            ///< outside a checkout
    std::string buildType;  ///< "Release", "Debug", ...; "Debug+address,undefined" with sanitizers
    std::string compiler;   ///< e.g. "GNU 12.2.0"
};

const BuildInfo& buildInfo();

/// What `--version` prints: "fit_slope 0.1.0 (revision 60e3d2488f4c, Release, GNU 12.2.0)".
std::string versionLine(const std::string& programName);

}  // namespace program

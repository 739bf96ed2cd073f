// SPDX-License-Identifier: MIT
#include "program/build_info.h"

#include "revision.h"

namespace program {

const BuildInfo& buildInfo() {
    static const BuildInfo info = [] {
        const std::string sanitizers = STAIRWELL_SANITIZE;
        return BuildInfo{
            .version = STAIRWELL_VERSION,
            .revision = STAIRWELL_REVISION,
            .buildType = STAIRWELL_BUILD_TYPE + (sanitizers.empty() ? "" : "+" + sanitizers),
            .compiler = STAIRWELL_COMPILER};
    }();
    return info;
}

std::string versionLine(const std::string& programName) {
    const BuildInfo& info = buildInfo();
    return programName + " " + info.version + " (revision " + info.revision + ", " +
           info.buildType + ", " + info.compiler + ")";
}

}  // namespace program

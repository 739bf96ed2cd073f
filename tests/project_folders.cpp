// SPDX-License-Identifier: MIT
#include "tests/project_folders.h"

namespace tests {

std::filesystem::path sourceFolder() { return STAIRWELL_SOURCE_DIR; }
std::filesystem::path programFolder() { return STAIRWELL_BIN_DIR; }

}  // namespace tests

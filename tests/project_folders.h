// SPDX-License-Identifier: MIT
// Where the project lies and where its programs were built. The only file that is compiled anew for
// each copy of the project: everything else comes out of the compiler cache.
#pragma once

#include <filesystem>

namespace tests {

std::filesystem::path sourceFolder();   ///< of CMakeLists.txt, absolute
std::filesystem::path programFolder();  ///< build/<preset>/bin, absolute

}  // namespace tests

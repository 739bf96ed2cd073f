// SPDX-License-Identifier: MIT
// A fuzz target: one function that takes any bytes, and valid inputs to start from. libFuzzer
// drives it (tests/fuzz/run) or, where there is only GCC, seeded_driver.cpp.
//
// A target fails by crashing: a broken promise calls require().
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace fuzz {

/// A few valid inputs.
std::vector<std::string> seeds();

inline void require(bool promise, const char* what) {
    if (promise) return;
    std::fprintf(stderr, "broken promise: %s\n", what);
    std::abort();
}

}  // namespace fuzz

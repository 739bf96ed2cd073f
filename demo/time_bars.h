// SPDX-License-Identifier: MIT
// The report's figure: one bar per size, made of the passes' median times, with N, time and error
// written beside it.
#pragma once

#include <string>

#include "demo/benchmark.h"

namespace demo {

/// An SVG picture on white paper. Groups are stacked; every group has its own time axis from 0.
std::string timeBarsSvg(const BenchmarkResult& result);

}  // namespace demo

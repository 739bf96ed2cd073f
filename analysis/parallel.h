// SPDX-License-Identifier: MIT
// Runs work(0) ... work(count - 1) on several threads. Each call writes to its own place, so that
// the result does not depend on the number of threads; fits themselves stay on one thread each.
#pragma once

#include <cstddef>
#include <functional>

namespace analysis {

/// `threads` of 0 stands for as many as there are processors. Where calls throw, the rest is still
/// run and the error of the first index is thrown.
void inParallel(std::size_t count, int threads, const std::function<void(std::size_t)>& work);

}  // namespace analysis

// SPDX-License-Identifier: MIT
// One line of progress with the time left, on standard error, for anything that takes over two
// seconds.
//
//   program::Progress progress("rendering", frames);
//   for (...) { render(); progress.advance(); }
//
// Prints nothing in the first two seconds and nothing more often than once a second (on a terminal
// the line is rewritten in place; elsewhere a new line every 10 s). The destructor ends the line.
// `advance` may be called from several threads.
#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>

namespace program {

class Progress {
  public:
    Progress(std::string what, std::size_t total);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void advance(std::size_t by = 1);

  private:
    using Clock = std::chrono::steady_clock;
    void print(Clock::time_point now);

    std::mutex mutex_;
    std::string what_;
    std::size_t total_;
    std::size_t done_ = 0;
    bool onTerminal_;
    bool printed_ = false;
    std::size_t lastLength_ = 0;
    Clock::time_point start_;
    Clock::time_point lastPrint_;
};

/// "rendering: 45 of 200 (22 %), 1 min 12 s left". The time left is what the rest takes at the pace
/// so far; it is left out as long as nothing is done or when everything is.
std::string progressLine(const std::string& what, std::size_t done, std::size_t total,
                         double elapsedSeconds);

}  // namespace program

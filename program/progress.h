// SPDX-License-Identifier: MIT
// One line of progress with the time left, on standard error, for anything that takes over two seconds.
//
//   program::Progress progress("rendering", frames);
//   for (...) { render(); progress.advance(); }
//
// Prints nothing in the first two seconds and nothing more often than once a second (on a terminal the line is
// rewritten in place; elsewhere a new line every 10 s). The destructor ends the line.
#pragma once

#include <chrono>
#include <cstddef>
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
    void print(std::chrono::steady_clock::time_point now);

    std::string what_;
    std::size_t total_;
    std::size_t done_ = 0;
    bool onTerminal_;
    bool printed_ = false;
    std::chrono::steady_clock::time_point start_;
    std::chrono::steady_clock::time_point lastPrint_;
};

}  // namespace program

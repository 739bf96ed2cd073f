// SPDX-License-Identifier: MIT
#include "program/progress.h"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <utility>

namespace program {

namespace {

using namespace std::chrono_literals;

constexpr auto kQuietTime = 2s;
constexpr auto kTerminalPeriod = 1s;
constexpr auto kLogPeriod = 10s;

std::string durationText(double seconds) {
    const auto whole = static_cast<long long>(std::ceil(seconds));
    if (whole < 60) return std::to_string(whole) + " s";
    if (whole < 3600)
        return std::to_string(whole / 60) + " min " + std::to_string(whole % 60) + " s";
    return std::to_string(whole / 3600) + " h " + std::to_string(whole / 60 % 60) + " min";
}

}  // namespace

std::string progressLine(const std::string& what, std::size_t done, std::size_t total,
                         double elapsedSeconds) {
    std::string line = what + ": " + std::to_string(done) + " of " + std::to_string(total);
    if (total == 0) return line;
    const double share = static_cast<double>(done) / static_cast<double>(total);
    line += " (" + std::to_string(static_cast<int>(100 * share)) + " %)";
    if (done == 0 || done >= total) return line;
    return line + ", " + durationText(elapsedSeconds * (1 - share) / share) + " left";
}

Progress::Progress(std::string what, std::size_t total)
    : what_(std::move(what)),
      total_(total),
      onTerminal_(isatty(STDERR_FILENO) == 1),
      start_(Clock::now()),
      lastPrint_(start_) {}

Progress::~Progress() {
    if (printed_ && onTerminal_) std::fputc('\n', stderr);
}

void Progress::advance(std::size_t by) {
    const std::lock_guard lock(mutex_);
    done_ += by;
    const Clock::time_point now = Clock::now();
    if (now - start_ < kQuietTime) return;
    if (printed_ && now - lastPrint_ < (onTerminal_ ? kTerminalPeriod : kLogPeriod)) return;
    print(now);
}

void Progress::print(Clock::time_point now) {
    const std::string line =
        progressLine(what_, done_, total_, std::chrono::duration<double>(now - start_).count());
    if (onTerminal_) {
        const std::size_t blanks = lastLength_ > line.size() ? lastLength_ - line.size() : 0;
        std::fprintf(stderr, "\r%s%s", line.c_str(), std::string(blanks, ' ').c_str());
    } else {
        std::fprintf(stderr, "%s\n", line.c_str());
    }
    std::fflush(stderr);
    lastLength_ = line.size();
    printed_ = true;
    lastPrint_ = now;
}

}  // namespace program

// SPDX-License-Identifier: MIT
// Where a run's time goes: lap("fit") names the time since the last lap.
#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace analysis {

class StageTimes {
  public:
    void lap(std::string stage) {
        const auto now = std::chrono::steady_clock::now();
        seconds_.emplace_back(std::move(stage), std::chrono::duration<double>(now - last_).count());
        last_ = now;
    }
    const std::vector<std::pair<std::string, double>>& seconds() const { return seconds_; }

  private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
    std::vector<std::pair<std::string, double>> seconds_;
};

}  // namespace analysis

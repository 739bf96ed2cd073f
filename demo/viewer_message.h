// SPDX-License-Identifier: MIT
// The last thing that happened in the viewer's window, for as long as it takes to read it.
#pragma once

#include <optional>
#include <string>
#include <utility>

namespace demo {

class ViewerMessage {
  public:
    /// From the next frame that is drawn on this one, from the beginning: what it took to do what
    /// it is about does not count.
    void say(std::string text) {
        text_ = std::move(text);
        shownSinceS_.reset();
    }
    /// For a frame that is drawn at this time; empty where there is none.
    const std::string& shownAt(double seconds) {
        if (!shownSinceS_) shownSinceS_ = seconds;
        const double longestS = kLeastS + kPerLetterS * static_cast<double>(text_.size());
        if (seconds - *shownSinceS_ > longestS) text_.clear();
        return text_;
    }

  private:
    // Some 20 letters a second are read (chosen by eye).
    static constexpr double kLeastS = 4, kPerLetterS = 0.05;

    std::string text_;
    std::optional<double> shownSinceS_;
};

}  // namespace demo

// SPDX-License-Identifier: MIT
// The last thing that happened in the viewer's window, for as long as it takes to read it.
#pragma once

#include <string>
#include <utility>

namespace demo {

class ViewerMessage {
  public:
    /// From now on this one, from the beginning.
    void say(std::string text) {
        text_ = std::move(text);
        shownS_ = 0;
    }
    void pass(double seconds) {
        shownS_ += seconds;
        if (shownS_ > kLeastS + kPerLetterS * static_cast<double>(text_.size())) text_.clear();
    }
    /// Empty where there is none.
    const std::string& text() const { return text_; }

  private:
    // Some 20 letters a second are read (chosen by eye).
    static constexpr double kLeastS = 4, kPerLetterS = 0.05;

    std::string text_;
    double shownS_ = 0;
};

}  // namespace demo

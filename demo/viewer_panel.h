// SPDX-License-Identifier: MIT
// The viewer's panel (Dear ImGui): draws the state's controls and what came out of it, and says
// what the user asked for that the state does not hold.
#pragma once

#include <array>
#include <deque>
#include <string>

#include "demo/viewer.h"

namespace demo {

/// What the plots show: the last frames.
struct FrameHistory {
    static constexpr std::size_t kFrames = 240;
    struct Entry {
        float frameMs = 0;
        float resolution = 0;              ///< of the sun's map
        float artifactRatio = 0;           ///< the worst of all maps
        float mapTexels = 0;               ///< of all maps together
        renderer::PassTimesMs passesMs{};  ///< 0 where not timed
    };
    std::deque<Entry> entries;

    void add(const Entry& entry) {
        entries.push_back(entry);
        if (entries.size() > kFrames) entries.pop_front();
    }
};

/// What is being typed.
struct PanelTexts {
    std::array<char, 1024> slopeFile{};
};

struct PanelRequest {
    bool screenshot = false;
    bool useTypedSlope = false, usePublishedSlope = false;
};

/// Changes `state` as the user does. `message`: the last thing that happened, shown at the bottom.
PanelRequest drawPanel(const Viewer& viewer, const FrameHistory& history,
                       const std::string& message, PanelTexts& texts, ViewerState& state);

}  // namespace demo

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
        float resolution = 0;
        float artifactRatio = 0;
        renderer::PassTimesMs passesMs{};  ///< 0 where not timed
    };
    std::deque<Entry> entries;

    void add(const Entry& entry) {
        entries.push_back(entry);
        if (entries.size() > kFrames) entries.pop_front();
    }
};

struct PanelRequest {
    bool screenshot = false;
};

/// Changes `state` as the user does. `message`: the last thing that happened, shown at the bottom.
PanelRequest drawPanel(const Viewer& viewer, const FrameHistory& history,
                       const std::string& message, ViewerState& state);

}  // namespace demo

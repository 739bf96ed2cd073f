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

/// Changes `state` as the user does. The panel stays within the window.
PanelRequest drawPanel(const Viewer& viewer, const FrameHistory& history, PanelTexts& texts,
                       ViewerState& state);

/// At the bottom of the window, over all else; nothing where it is empty.
void drawMessage(const std::string& message);

/// Where along an axis a panel stands within a window: where it would, unless it would be partly
/// outside; at the window's beginning where it is too long for it.
float keptInside(float place, float length, float windowLength);

}  // namespace demo

// SPDX-License-Identifier: MIT
// The interactive window: a scene that the mouse turns, and keys for technique, scene and size.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "demo/shadow_run.h"
#include "renderer/window.h"

namespace demo {

/// What the window shows; changed by the keys.
struct ViewState {
    std::size_t scene = 0;                    ///< row of renderer::builtInScenes()
    std::size_t technique = 0;                ///< row of renderer::techniques()
    ResolutionOption resolution;              ///< absent: automatic
    std::optional<double> radiusM, radiusUv;  ///< absent: the scene's own
};

/// One line per key, for --help and the terminal.
std::string keyHelp();

/// What a key does to the state. Returns false for a key that means nothing.
bool applyKey(char key, ViewState& state);

/// Shows the window until it is closed or Esc is pressed, or for `frames` frames where that is not
/// 0. `onEnd` runs with the last frame still there.
void showWindow(renderer::Window& window, const ViewState& start,
                const resolution_controller::Slope& slope,
                const renderer::ParameterValues& parameters, int widthPx, int heightPx, int frames,
                const std::function<void(renderer::Renderer&, ShadowRun&)>& onEnd);

}  // namespace demo

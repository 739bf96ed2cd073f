// SPDX-License-Identifier: MIT
// The viewer in its window: picture, panel, keys, the mouse that turns the scene.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "demo/viewer.h"
#include "renderer/window.h"

namespace demo {

struct ViewerWindowOptions {
    int frames = 0;                       ///< after which to close; 0: when the user does
    std::filesystem::path pictureFolder;  ///< where "Save a picture" writes
    /// Picture of the window, panel and all, in the last of `frames`; absent: none.
    std::optional<std::filesystem::path> windowPicture = {};
    /// Where L reads the shaders again; absent: they are those of the program.
    std::optional<std::filesystem::path> shaderFolder = {};
};

/// Shows the window until it is closed or Esc is pressed. A frame that is refused is a message in
/// it; so that a window does not open on nothing, let the viewer draw one before.
void showViewer(renderer::Window& window, Viewer& viewer, const ViewerWindowOptions& options);

}  // namespace demo

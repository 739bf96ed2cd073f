// SPDX-License-Identifier: MIT
// Monitors: which one a window stands on, what it is like, and where a second window finds room.
#pragma once

#include <span>
#include <vector>

#include "study_app/viewing_geometry.h"

struct GLFWmonitor;
struct GLFWwindow;

namespace study_app {

/// Of the desktop, in the window system's units, from its top left.
struct DesktopRect {
    int x = 0, y = 0, width = 0, height = 0;
    bool operator==(const DesktopRect&) const = default;
};

std::vector<GLFWmonitor*> connectedMonitors();
std::vector<DesktopRect> workAreas();  ///< of the connected monitors, without task bars
DesktopRect desktopRect(GLFWwindow* window);

/// The corner of a monitor in which a window of this size hides least of `first`, cut to the
/// monitor's work area. `areas` must not be empty.
DesktopRect placeBeside(const DesktopRect& first, std::span<const DesktopRect> areas, int width,
                        int height);

/// What the monitor that holds most of the window says of itself.
DisplayState displayStateOf(GLFWwindow* window);
/// Its name and resolution; the window's own size where there is no monitor.
DisplayProfile displayProfileOf(GLFWwindow* window);

}  // namespace study_app

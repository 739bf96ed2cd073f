// SPDX-License-Identifier: MIT
#include "study_app/monitors.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>

namespace study_app {
namespace {

long sharedArea(const DesktopRect& a, const DesktopRect& b) {
    const long width = std::min(a.x + a.width, b.x + b.width) - std::max(a.x, b.x);
    const long height = std::min(a.y + a.height, b.y + b.height) - std::max(a.y, b.y);
    return std::max(0L, width) * std::max(0L, height);
}

/// The monitor that holds most of the window; null where none is connected.
GLFWmonitor* monitorOf(GLFWwindow* window) {
    if (GLFWmonitor* own = glfwGetWindowMonitor(window)) return own;
    const DesktopRect place = desktopRect(window);
    GLFWmonitor* best = glfwGetPrimaryMonitor();
    long most = 0;
    for (GLFWmonitor* monitor : connectedMonitors()) {
        const GLFWvidmode* mode = glfwGetVideoMode(monitor);
        if (mode == nullptr) continue;
        DesktopRect whole{.width = mode->width, .height = mode->height};
        glfwGetMonitorPos(monitor, &whole.x, &whole.y);
        const long area = sharedArea(place, whole);
        if (area > most) {
            most = area;
            best = monitor;
        }
    }
    return best;
}

const GLFWvidmode* modeOf(GLFWmonitor* monitor) {
    return monitor == nullptr ? nullptr : glfwGetVideoMode(monitor);
}

}  // namespace

std::vector<GLFWmonitor*> connectedMonitors() {
    int count = 0;
    GLFWmonitor** monitors = glfwGetMonitors(&count);
    return {monitors, monitors + count};
}

std::vector<DesktopRect> workAreas() {
    std::vector<DesktopRect> areas;
    for (GLFWmonitor* monitor : connectedMonitors()) {
        DesktopRect& area = areas.emplace_back();
        glfwGetMonitorWorkarea(monitor, &area.x, &area.y, &area.width, &area.height);
    }
    return areas;
}

DesktopRect desktopRect(GLFWwindow* window) {
    DesktopRect rect;
    glfwGetWindowPos(window, &rect.x, &rect.y);
    glfwGetWindowSize(window, &rect.width, &rect.height);
    return rect;
}

DesktopRect placeBeside(const DesktopRect& first, std::span<const DesktopRect> areas, int width,
                        int height) {
    std::vector<DesktopRect> corners;
    for (const DesktopRect& area : areas) {
        const int w = std::min(width, area.width), h = std::min(height, area.height);
        const int right = area.x + area.width - w, bottom = area.y + area.height - h;
        for (const int x : {right, area.x}) {
            for (const int y : {area.y, bottom}) corners.push_back({x, y, w, h});
        }
    }
    return *std::ranges::min_element(
        corners, {}, [&](const DesktopRect& corner) { return sharedArea(corner, first); });
}

DisplayState displayStateOf(GLFWwindow* window) {
    DisplayState state;
    glfwGetFramebufferSize(window, &state.framebufferWidthPx, &state.framebufferHeightPx);
    glfwGetWindowSize(window, &state.windowWidth, &state.windowHeight);
    float x = 1, y = 1;
    glfwGetWindowContentScale(window, &x, &y);
    state.contentScale = x;
    GLFWmonitor* monitor = monitorOf(window);
    const GLFWvidmode* mode = modeOf(monitor);
    if (mode == nullptr) return state;
    state.modeWidthPx = state.nativeWidthPx = mode->width;
    state.modeHeightPx = state.nativeHeightPx = mode->height;
    state.bitsPerChannel = std::min({mode->redBits, mode->greenBits, mode->blueBits});
    int count = 0;
    const GLFWvidmode* modes = glfwGetVideoModes(monitor, &count);
    for (const GLFWvidmode& other : std::span(modes, static_cast<std::size_t>(count))) {
        if (other.width * other.height <= state.nativeWidthPx * state.nativeHeightPx) continue;
        state.nativeWidthPx = other.width;
        state.nativeHeightPx = other.height;
    }
    return state;
}

DisplayProfile displayProfileOf(GLFWwindow* window) {
    DisplayProfile profile{.name = "unknown display"};
    glfwGetFramebufferSize(window, &profile.widthPx, &profile.heightPx);
    GLFWmonitor* monitor = monitorOf(window);
    const GLFWvidmode* mode = modeOf(monitor);
    if (mode == nullptr) return profile;
    const char* name = glfwGetMonitorName(monitor);
    if (name != nullptr && *name != '\0') profile.name = name;
    profile.widthPx = mode->width;
    profile.heightPx = mode->height;
    return profile;
}

}  // namespace study_app

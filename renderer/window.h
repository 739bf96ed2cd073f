// SPDX-License-Identifier: MIT
// A window with an OpenGL 4.5 core context (GLFW), and which keys were pressed in it since the last
// look.
//
//   renderer::Window window("shadow_demo", 1280, 720);
//   while (!window.closeWanted()) {
//       const auto input = window.poll();  ...
//       window.copyFrom(framebuffer, w, h);  ... an interface over it ...  window.swap();
//   }
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "renderer/gl_context.h"

struct GLFWwindow;

namespace renderer {

struct WindowInput {
    std::vector<char> keys;  ///< letters and digits pressed, upper case; '\x1b' is Esc
    /// Where the mouse was when its left button went down, in the window's units from its upper
    /// left corner: in a slow frame it is elsewhere by now.
    std::optional<glm::dvec2> pressedAt;
    int widthPx = 0, heightPx = 0;  ///< of the framebuffer now; 0 while minimised
};

class Window {
  public:
    /// Throws std::runtime_error with GLFW's reason: no display, no OpenGL 4.5.
    Window(const std::string& title, int widthPx, int heightPx);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    const GlInfo& info() const { return info_; }
    bool closeWanted() const;
    WindowInput poll();
    void setTitle(const std::string& title);
    /// Copies a framebuffer object of that size into the window, scaled where sizes differ.
    void copyFrom(unsigned framebuffer, int widthPx, int heightPx);
    void swap();
    /// For an interface library that listens to it.
    GLFWwindow* glfw() const;

  private:
    struct Handle;
    std::unique_ptr<Handle> handle_;
    GlInfo info_;
};

}  // namespace renderer

// SPDX-License-Identifier: MIT
// The window: GLFW, an OpenGL 3.3 core context and Dear ImGui, as one resource. It sleeps until
// something happens, draws when asked, and hands out what a person did as plain values.
//
//   Window window({.widthPx = 1280, .heightPx = 800});
//   while (!window.input().closeRequested) {
//       window.waitForEvents(secondsUntilSomethingChanges);
//       window.beginFrame();  ... ImGui, GL ...  window.endFrame();
//   }
//
// Codes reach the framebuffer as they are: no sRGB conversion, dithering or multisampling.
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "study_app/viewing_geometry.h"
#include "study_app/window_style.h"

struct GLFWmonitor;
struct GLFWwindow;
struct ImGuiContext;

namespace study_app {

struct WindowOptions {
    int widthPx = 1280, heightPx = 800;
    bool fullscreen = false;
    std::optional<double> uiScale;  ///< of text and controls; the desktop's where absent
    const char* title = "Stairwell study";
};

/// What happened since the last clear(), in order.
struct Input {
    struct Click {
        double xPx = 0, yPx = 0;  ///< framebuffer pixels from the top left
    };
    struct Press {
        int key = 0;  ///< GLFW_KEY_..., never GLFW_KEY_UNKNOWN; of no meaning for a click
        std::optional<Click> click{};  ///< of the left button; absent for a key
    };
    std::vector<Press> presses;  ///< keys (no repeats) and left clicks
    /// Why a stimulus on screen was not seen as it should be; empty where it was.
    std::string disturbance;
    bool closeRequested = false;
    bool exposed = false;  ///< part of it was hidden or lost, and is to be drawn again
    bool any = false;      ///< anything at all, the mouse over it included

    void clear() {
        presses.clear();
        disturbance.clear();
        exposed = any = false;
    }
};

class Window {
  public:
    /// Throws std::runtime_error: no display, no OpenGL 3.3.
    explicit Window(const WindowOptions& options);
    /// A second window, for someone else than the first one's observer: on another monitor or where
    /// it hides least of the first one, in front of it where there is but one monitor. It asks for
    /// no keyboard, its swaps do not wait for the display, and it must not outlive the first one.
    Window(const WindowOptions& options, const Window& first);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    /// Seconds of a clock that never goes back.
    static double now();

    /// Sleeps until an event comes, to any window, or the time is over; 0 looks without sleeping.
    void waitForEvents(double seconds);
    Input& input() { return input_; }

    /// OpenGL and ImGui calls mean this window from here on.
    void makeCurrent() const;
    /// makeCurrent(), clears to a grey and starts an ImGui frame.
    void beginFrame(int greyCode);
    /// Draws ImGui's part and swaps. Returns the time at which the swap was done (glFinish after
    /// it: the frame has left the program; the display adds its own delay, the same every time).
    double endFrame();
    /// Draws ImGui's part without swapping, for reading pixels back first. endFrame() then swaps.
    void renderInterface();

    int widthPx() const;
    int heightPx() const;
    float uiScale() const { return uiScale_; }
    const Fonts& fonts() const { return fonts_; }
    bool focused() const;
    void takeKeyboard() const;  ///< asks the window system for it
    void showCursor(bool shown);

    DisplayState displayState() const;
    DisplayProfile monitor() const;  ///< name and resolution of the monitor it stands on
    std::string glRenderer() const;
    std::string glVersion() const;
    /// What the person who set it up should hear about: fonts that are missing.
    const std::vector<std::string>& notices() const { return notices_; }

    /// The frame as drawn so far: CV_8UC3, BGR, row 0 on top.
    cv::Mat readPixels() const;

  private:
    friend struct Listener;
    struct Library;  // GLFW itself, up as long as there is a window
    struct Destroy {
        void operator()(GLFWwindow* window) const;
    };

    void open(const WindowOptions& options, const Window* first);
    void listen();
    void startInterface();
    void noteUnpluggedMonitors();

    std::shared_ptr<Library> library_;
    std::unique_ptr<GLFWwindow, Destroy> window_;
    ImGuiContext* interface_ = nullptr;
    std::vector<GLFWmonitor*> monitors_;
    Input input_;
    Fonts fonts_;
    float uiScale_ = 1;
    bool interfaceDrawn_ = false;
    bool cursorShown_ = true;
    std::vector<std::string> notices_;
};

}  // namespace study_app

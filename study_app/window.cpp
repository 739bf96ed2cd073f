// SPDX-License-Identifier: MIT
#include "study_app/window.h"

#include <epoxy/gl.h>
// GLFW must not bring its own GL header along after epoxy's.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "study_app/monitors.h"

namespace study_app {

/// Whose event it is: while a callback runs, ImGui's current context is that of its window.
struct Listener {
    explicit Listener(GLFWwindow* window)
        : own(*static_cast<Window*>(glfwGetWindowUserPointer(window))),
          input(own.input_),
          before(ImGui::GetCurrentContext()) {
        ImGui::SetCurrentContext(own.interface_);
        input.any = true;
    }
    ~Listener() { ImGui::SetCurrentContext(before); }
    Listener(const Listener&) = delete;
    Listener& operator=(const Listener&) = delete;

    Window& own;
    Input& input;
    ImGuiContext* before;
};

namespace {

void onKey(GLFWwindow* window, int key, int scancode, int action, int modifiers) {
    const Listener heard(window);
    // Volume, brightness and the like: no key of ours, and nothing that could be an answer.
    const bool known = key != GLFW_KEY_UNKNOWN;
    if (action == GLFW_PRESS && known) heard.input.presses.push_back({.key = key});
    ImGui_ImplGlfw_KeyCallback(window, key, scancode, action, modifiers);
}

void onCharacter(GLFWwindow* window, unsigned character) {
    const Listener heard(window);
    ImGui_ImplGlfw_CharCallback(window, character);
}

void onMouseButton(GLFWwindow* window, int button, int action, int modifiers) {
    const Listener heard(window);
    ImGui_ImplGlfw_MouseButtonCallback(window, button, action, modifiers);
    if (button != GLFW_MOUSE_BUTTON_LEFT || action != GLFW_PRESS) return;
    double x = 0, y = 0;
    int windowWidth = 0, windowHeight = 0, width = 0, height = 0;
    glfwGetCursorPos(window, &x, &y);
    glfwGetWindowSize(window, &windowWidth, &windowHeight);
    glfwGetFramebufferSize(window, &width, &height);
    heard.input.presses.push_back(
        {.click = Input::Click{.xPx = x * width / std::max(1, windowWidth),
                               .yPx = y * height / std::max(1, windowHeight)}});
}

void onScroll(GLFWwindow* window, double x, double y) {
    const Listener heard(window);
    ImGui_ImplGlfw_ScrollCallback(window, x, y);
}

void onCursorEnter(GLFWwindow* window, int entered) {
    const Listener heard(window);
    ImGui_ImplGlfw_CursorEnterCallback(window, entered);
}

void onCursorMove(GLFWwindow* window, double, double) {
    const Listener heard(window);
}

void onFocus(GLFWwindow* window, int focused) {
    const Listener heard(window);
    ImGui_ImplGlfw_WindowFocusCallback(window, focused);
    if (focused == GLFW_FALSE) heard.input.disturbance = "another window came to the front";
}

void onIconify(GLFWwindow* window, int iconified) {
    const Listener heard(window);
    if (iconified == GLFW_TRUE) heard.input.disturbance = "the window was minimised";
}

void onFramebufferSize(GLFWwindow* window, int, int) {
    const Listener heard(window);
    heard.input.disturbance = "the window changed its size";
}

void onRefresh(GLFWwindow* window) {
    const Listener heard(window);
    heard.input.exposed = true;
}

void onClose(GLFWwindow* window) {
    const Listener heard(window);
    heard.input.closeRequested = true;
}

std::string glfwProblem() {
    const char* description = nullptr;
    glfwGetError(&description);
    return description == nullptr ? "unknown reason" : description;
}

std::string glText(GLenum name) {
    const GLubyte* text = glGetString(name);
    return text == nullptr ? "" : reinterpret_cast<const char*>(text);
}

}  // namespace

struct Window::Library {
    Library() {
        if (glfwInit() == GLFW_TRUE) return;
        throw std::runtime_error("window: cannot be opened: " + glfwProblem() +
                                 ": needs an X11 or Wayland display (is DISPLAY set?)");
    }
    ~Library() { glfwTerminate(); }
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;
};

void Window::Destroy::operator()(GLFWwindow* window) const {
    glfwDestroyWindow(window);
}

Window::Window(const WindowOptions& options) : library_(std::make_shared<Library>()) {
    open(options, nullptr);
    listen();
    startInterface();
}

Window::Window(const WindowOptions& options, const Window& first) : library_(first.library_) {
    open(options, &first);
    listen();
    startInterface();
}

Window::~Window() {
    makeCurrent();
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext(interface_);
}

void Window::open(const WindowOptions& options, const Window* first) {
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_SAMPLES, 0);
    glfwWindowHint(GLFW_SRGB_CAPABLE, GLFW_FALSE);
    glfwWindowHint(GLFW_AUTO_ICONIFY, GLFW_FALSE);
    int width = options.widthPx, height = options.heightPx;
    GLFWmonitor* monitor = options.fullscreen ? glfwGetPrimaryMonitor() : nullptr;
    if (const GLFWvidmode* mode = monitor == nullptr ? nullptr : glfwGetVideoMode(monitor)) {
        // The current mode, so that a full screen never resamples by changing it.
        width = mode->width;
        height = mode->height;
    }
    std::optional<DesktopRect> place;
    if (first != nullptr) {
        for (const int hint : {GLFW_VISIBLE, GLFW_FOCUSED, GLFW_FOCUS_ON_SHOW}) {
            glfwWindowHint(hint, GLFW_FALSE);
        }
        // Nowhere else to be seen than over the first one.
        if (connectedMonitors().size() == 1) glfwWindowHint(GLFW_FLOATING, GLFW_TRUE);
        const std::vector<DesktopRect> areas = workAreas();
        if (!areas.empty()) {
            place = placeBeside(desktopRect(first->window_.get()), areas, width, height);
            width = place->width;
            height = place->height;
        }
    }
    window_.reset(glfwCreateWindow(width, height, options.title, monitor,
                                   first == nullptr ? nullptr : first->window_.get()));
    if (window_ == nullptr) {
        throw std::runtime_error("window: cannot be opened: " + glfwProblem() +
                                 ": needs OpenGL 3.3");
    }
    glfwMakeContextCurrent(window_.get());
    glfwSwapInterval(first == nullptr ? 1 : 0);
    glDisable(GL_DITHER);
    glDisable(GL_FRAMEBUFFER_SRGB);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    if (place) glfwSetWindowPos(window_.get(), place->x, place->y);
    if (first != nullptr) glfwShowWindow(window_.get());
    float x = 1, y = 1;
    glfwGetWindowContentScale(window_.get(), &x, &y);
    uiScale_ = options.uiScale ? static_cast<float>(*options.uiScale) : std::max(1.0f, x);
}

void Window::listen() {
    GLFWwindow* window = window_.get();
    glfwSetWindowUserPointer(window, this);
    glfwSetKeyCallback(window, onKey);
    glfwSetCharCallback(window, onCharacter);
    glfwSetMouseButtonCallback(window, onMouseButton);
    glfwSetScrollCallback(window, onScroll);
    glfwSetCursorEnterCallback(window, onCursorEnter);
    glfwSetCursorPosCallback(window, onCursorMove);
    glfwSetWindowFocusCallback(window, onFocus);
    glfwSetWindowIconifyCallback(window, onIconify);
    glfwSetFramebufferSizeCallback(window, onFramebufferSize);
    glfwSetWindowRefreshCallback(window, onRefresh);
    glfwSetWindowCloseCallback(window, onClose);
    monitors_ = connectedMonitors();
}

void Window::startInterface() {
    IMGUI_CHECKVERSION();
    interface_ = ImGui::CreateContext();
    ImGui::SetCurrentContext(interface_);
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;  // a study leaves no files that it was not asked for
    io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
    setStyle(uiScale_);
    fonts_ = loadFonts(uiScale_, notices_);
    ImGui_ImplGlfw_InitForOpenGL(window_.get(), false);  // the listeners above tell it
    ImGui_ImplOpenGL3_Init("#version 330 core");
}

double Window::now() {
    return glfwGetTime();
}

void Window::waitForEvents(double seconds) {
    if (seconds <= 0) {
        glfwPollEvents();
    } else if (std::isinf(seconds)) {
        glfwWaitEvents();
    } else {
        glfwWaitEventsTimeout(seconds);
    }
    noteUnpluggedMonitors();
}

void Window::noteUnpluggedMonitors() {
    const std::vector<GLFWmonitor*> now = connectedMonitors();
    if (now == monitors_) return;
    const bool allThere = std::ranges::all_of(monitors_, [&](GLFWmonitor* monitor) {
        return std::ranges::find(now, monitor) != now.end();
    });
    if (!allThere) input_.disturbance = "a display was unplugged";
    monitors_ = now;
}

void Window::makeCurrent() const {
    glfwMakeContextCurrent(window_.get());
    ImGui::SetCurrentContext(interface_);
}

void Window::beginFrame(int greyCode) {
    makeCurrent();
    const float grey = static_cast<float>(greyCode) / 255;
    glDisable(GL_SCISSOR_TEST);
    glViewport(0, 0, widthPx(), heightPx());
    glClearColor(grey, grey, grey, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
    interfaceDrawn_ = false;
}

void Window::renderInterface() {
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    interfaceDrawn_ = true;
}

double Window::endFrame() {
    if (!interfaceDrawn_) renderInterface();
    glfwSwapBuffers(window_.get());
    glFinish();
    return now();
}

int Window::widthPx() const {
    int width = 0, height = 0;
    glfwGetFramebufferSize(window_.get(), &width, &height);
    return width;
}

int Window::heightPx() const {
    int width = 0, height = 0;
    glfwGetFramebufferSize(window_.get(), &width, &height);
    return height;
}

bool Window::focused() const {
    return glfwGetWindowAttrib(window_.get(), GLFW_FOCUSED) == GLFW_TRUE;
}

void Window::takeKeyboard() const {
    glfwFocusWindow(window_.get());
}

void Window::showCursor(bool shown) {
    if (shown == cursorShown_) return;
    cursorShown_ = shown;
    // ImGui's GLFW backend would show the cursor again with its next frame.
    ImGuiIO& io = ImGui::GetIO();
    if (shown) {
        io.ConfigFlags &= ~ImGuiConfigFlags_NoMouseCursorChange;
    } else {
        io.ConfigFlags |= ImGuiConfigFlags_NoMouseCursorChange;
    }
    glfwSetInputMode(window_.get(), GLFW_CURSOR, shown ? GLFW_CURSOR_NORMAL : GLFW_CURSOR_HIDDEN);
}

DisplayState Window::displayState() const {
    return displayStateOf(window_.get());
}

DisplayProfile Window::monitor() const {
    return displayProfileOf(window_.get());
}

std::string Window::glRenderer() const {
    return glText(GL_RENDERER);
}

std::string Window::glVersion() const {
    return glText(GL_VERSION);
}

cv::Mat Window::readPixels() const {
    cv::Mat bgr(heightPx(), widthPx(), CV_8UC3);
    glReadBuffer(GL_BACK);
    glReadPixels(0, 0, bgr.cols, bgr.rows, GL_BGR, GL_UNSIGNED_BYTE, bgr.data);
    cv::flip(bgr, bgr, 0);
    return bgr;
}

}  // namespace study_app

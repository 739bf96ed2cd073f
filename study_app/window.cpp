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
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace study_app {
namespace {

constexpr const char* kFontFolder = "/usr/share/fonts/truetype/dejavu/";
// Sizes at scale 1, px: body text that is read easily at arm's length.
constexpr float kTextPx = 17, kHeadingPx = 27, kSmallPx = 14;

Input& inputOf(GLFWwindow* window) {
    return *static_cast<Input*>(glfwGetWindowUserPointer(window));
}

void onKey(GLFWwindow* window, int key, int, int action, int) {
    if (action == GLFW_PRESS) inputOf(window).presses.push_back({.key = key});
}

void onMouseButton(GLFWwindow* window, int button, int action, int) {
    if (button != GLFW_MOUSE_BUTTON_LEFT || action != GLFW_PRESS) return;
    double x = 0, y = 0;
    int windowWidth = 0, windowHeight = 0, width = 0, height = 0;
    glfwGetCursorPos(window, &x, &y);
    glfwGetWindowSize(window, &windowWidth, &windowHeight);
    glfwGetFramebufferSize(window, &width, &height);
    inputOf(window).presses.push_back({.key = GLFW_KEY_UNKNOWN,
                                       .click = {.xPx = x * width / std::max(1, windowWidth),
                                                 .yPx = y * height / std::max(1, windowHeight)}});
}

void onFocus(GLFWwindow* window, int focused) {
    if (focused == GLFW_FALSE) inputOf(window).disturbance = "another window came to the front";
}

void onIconify(GLFWwindow* window, int iconified) {
    if (iconified == GLFW_TRUE) inputOf(window).disturbance = "the window was minimised";
}

void onFramebufferSize(GLFWwindow* window, int, int) {
    inputOf(window).disturbance = "the window changed its size";
}

void onClose(GLFWwindow* window) {
    inputOf(window).closeRequested = true;
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

/// The monitor that holds most of the window.
GLFWmonitor* monitorOf(GLFWwindow* window) {
    if (GLFWmonitor* own = glfwGetWindowMonitor(window)) return own;
    int x = 0, y = 0, width = 0, height = 0, count = 0;
    glfwGetWindowPos(window, &x, &y);
    glfwGetWindowSize(window, &width, &height);
    GLFWmonitor** monitors = glfwGetMonitors(&count);
    GLFWmonitor* best = glfwGetPrimaryMonitor();
    int most = 0;
    for (int i = 0; i < count; ++i) {
        int left = 0, top = 0;
        glfwGetMonitorPos(monitors[i], &left, &top);
        const GLFWvidmode* mode = glfwGetVideoMode(monitors[i]);
        if (mode == nullptr) continue;
        const int w = std::min(x + width, left + mode->width) - std::max(x, left);
        const int h = std::min(y + height, top + mode->height) - std::max(y, top);
        const int area = std::max(0, w) * std::max(0, h);
        if (area > most) {
            most = area;
            best = monitors[i];
        }
    }
    return best;
}

/// Quiet greys with one accent: the study's grey background goes on behind the screens.
void setStyle(float scale) {
    ImGui::StyleColorsDark();
    ImGuiStyle& style = ImGui::GetStyle();
    style.WindowRounding = 0;
    style.WindowBorderSize = 0;
    style.FrameRounding = 4;
    style.GrabRounding = 4;
    style.PopupRounding = 4;
    style.TabRounding = 4;
    style.WindowPadding = {24, 20};
    style.FramePadding = {10, 6};
    style.ItemSpacing = {10, 9};
    style.CellPadding = {8, 4};
    style.ScrollbarSize = 12;
    const auto set = [&](ImGuiCol which, float grey, float alpha = 1) {
        style.Colors[which] = {grey, grey, grey * 1.03f, alpha};
    };
    const ImVec4 accent{0.36f, 0.60f, 0.87f, 1}, dim{0.25f, 0.42f, 0.63f, 1};
    set(ImGuiCol_Text, 0.93f);
    set(ImGuiCol_TextDisabled, 0.66f);
    set(ImGuiCol_WindowBg, 0.13f);
    set(ImGuiCol_PopupBg, 0.16f);
    set(ImGuiCol_FrameBg, 0.21f);
    set(ImGuiCol_FrameBgHovered, 0.26f);
    set(ImGuiCol_FrameBgActive, 0.29f);
    set(ImGuiCol_Button, 0.26f);
    set(ImGuiCol_ButtonHovered, 0.33f);
    set(ImGuiCol_ButtonActive, 0.38f);
    set(ImGuiCol_Separator, 0.30f);
    set(ImGuiCol_Header, 0.26f);
    set(ImGuiCol_HeaderHovered, 0.32f);
    set(ImGuiCol_HeaderActive, 0.36f);
    set(ImGuiCol_TableHeaderBg, 0.18f);
    set(ImGuiCol_TableBorderLight, 0.25f);
    set(ImGuiCol_TableBorderStrong, 0.25f);
    set(ImGuiCol_Tab, 0.18f);
    set(ImGuiCol_TitleBg, 0.17f);
    set(ImGuiCol_TitleBgActive, 0.17f);
    style.Colors[ImGuiCol_TabHovered] = style.Colors[ImGuiCol_TabActive] = dim;
    style.Colors[ImGuiCol_CheckMark] = style.Colors[ImGuiCol_SliderGrab] = accent;
    style.Colors[ImGuiCol_SliderGrabActive] = style.Colors[ImGuiCol_NavHighlight] = accent;
    style.Colors[ImGuiCol_PlotHistogram] = style.Colors[ImGuiCol_PlotLines] = accent;
    style.ScaleAllSizes(scale);
}

}  // namespace

Window::Window(const WindowOptions& options) {
    if (glfwInit() == GLFW_FALSE) {
        throw std::runtime_error("window: cannot be opened: " + glfwProblem() +
                                 ": needs an X11 or Wayland display (is DISPLAY set?)");
    }
    try {
        openContext(options);
        listen();
        startInterface();
    } catch (...) {
        if (window_ != nullptr) glfwDestroyWindow(window_);
        glfwTerminate();
        throw;
    }
}

Window::~Window() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
    glfwDestroyWindow(window_);
    glfwTerminate();
}

void Window::openContext(const WindowOptions& options) {
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_SAMPLES, 0);
    glfwWindowHint(GLFW_SRGB_CAPABLE, GLFW_FALSE);
    glfwWindowHint(GLFW_AUTO_ICONIFY, GLFW_FALSE);
    GLFWmonitor* monitor = options.fullscreen ? glfwGetPrimaryMonitor() : nullptr;
    const GLFWvidmode* mode = monitor == nullptr ? nullptr : glfwGetVideoMode(monitor);
    // The current mode, so that a full screen never resamples by changing it.
    window_ = glfwCreateWindow(mode ? mode->width : options.widthPx,
                               mode ? mode->height : options.heightPx, "Stairwell study", monitor,
                               nullptr);
    if (window_ == nullptr) {
        throw std::runtime_error("window: cannot be opened: " + glfwProblem() +
                                 ": needs OpenGL 3.3");
    }
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(1);
    glDisable(GL_DITHER);
    glDisable(GL_FRAMEBUFFER_SRGB);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    float x = 1, y = 1;
    glfwGetWindowContentScale(window_, &x, &y);
    uiScale_ = options.uiScale ? static_cast<float>(*options.uiScale) : std::max(1.0f, x);
}

void Window::listen() {
    glfwSetWindowUserPointer(window_, &input_);
    glfwSetKeyCallback(window_, onKey);
    glfwSetMouseButtonCallback(window_, onMouseButton);
    glfwSetWindowFocusCallback(window_, onFocus);
    glfwSetWindowIconifyCallback(window_, onIconify);
    glfwSetFramebufferSizeCallback(window_, onFramebufferSize);
    glfwSetWindowCloseCallback(window_, onClose);
}

void Window::startInterface() {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;  // a study leaves no files that it was not asked for
    io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
    setStyle(uiScale_);
    loadFonts();
    ImGui_ImplGlfw_InitForOpenGL(window_, true);  // calls the listeners above first
    ImGui_ImplOpenGL3_Init("#version 330 core");
}

void Window::loadFonts() {
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    // Latin and Greek letters, dashes and arrows.
    static constexpr ImWchar ranges[] = {0x20,   0x17f,  0x391,  0x3c9,  0x2010, 0x2026,
                                         0x2190, 0x2193, 0x2212, 0x2212, 0};
    const auto load = [&](const char* name, float px) -> ImFont* {
        const std::filesystem::path file = std::filesystem::path(kFontFolder) / name;
        if (!std::filesystem::exists(file)) {
            notices_.push_back(file.string() +
                               ": is missing: text is drawn with a built-in bitmap font "
                               "(package fonts-dejavu-core)");
            ImFontConfig config;
            config.SizePixels = std::round(px * uiScale_);
            return atlas.AddFontDefault(&config);
        }
        return atlas.AddFontFromFileTTF(file.c_str(), std::round(px * uiScale_), nullptr, ranges);
    };
    fonts_.text = load("DejaVuSans.ttf", kTextPx);
    fonts_.heading = load("DejaVuSans.ttf", kHeadingPx);
    fonts_.small = load("DejaVuSans.ttf", kSmallPx);
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
}

void Window::beginFrame(int greyCode) {
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
    glfwSwapBuffers(window_);
    glFinish();
    return now();
}

int Window::widthPx() const {
    int width = 0, height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    return width;
}

int Window::heightPx() const {
    int width = 0, height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    return height;
}

bool Window::focused() const {
    return glfwGetWindowAttrib(window_, GLFW_FOCUSED) == GLFW_TRUE;
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
    glfwSetInputMode(window_, GLFW_CURSOR, shown ? GLFW_CURSOR_NORMAL : GLFW_CURSOR_HIDDEN);
}

DisplayState Window::displayState() const {
    DisplayState state{.framebufferWidthPx = widthPx(), .framebufferHeightPx = heightPx()};
    glfwGetWindowSize(window_, &state.windowWidth, &state.windowHeight);
    float x = 1, y = 1;
    glfwGetWindowContentScale(window_, &x, &y);
    state.contentScale = x;
    GLFWmonitor* monitor = monitorOf(window_);
    const GLFWvidmode* mode = monitor == nullptr ? nullptr : glfwGetVideoMode(monitor);
    if (mode == nullptr) return state;
    state.modeWidthPx = state.nativeWidthPx = mode->width;
    state.modeHeightPx = state.nativeHeightPx = mode->height;
    state.bitsPerChannel = std::min({mode->redBits, mode->greenBits, mode->blueBits});
    int count = 0;
    const GLFWvidmode* modes = glfwGetVideoModes(monitor, &count);
    for (int i = 0; i < count; ++i) {
        if (modes[i].width * modes[i].height <= state.nativeWidthPx * state.nativeHeightPx)
            continue;
        state.nativeWidthPx = modes[i].width;
        state.nativeHeightPx = modes[i].height;
    }
    return state;
}

DisplayProfile Window::monitor() const {
    DisplayProfile profile{.name = "unknown display", .widthPx = widthPx(), .heightPx = heightPx()};
    GLFWmonitor* monitor = monitorOf(window_);
    const GLFWvidmode* mode = monitor == nullptr ? nullptr : glfwGetVideoMode(monitor);
    if (mode == nullptr) return profile;
    const char* name = glfwGetMonitorName(monitor);
    if (name != nullptr && *name != '\0') profile.name = name;
    profile.widthPx = mode->width;
    profile.heightPx = mode->height;
    return profile;
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

// SPDX-License-Identifier: MIT
#include "renderer/window.h"

#include <epoxy/gl.h>
#define GLFW_INCLUDE_NONE  // the loader declares GL
#include <GLFW/glfw3.h>

#include <stdexcept>

namespace renderer {
namespace {

std::string lastGlfwError() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text == nullptr ? "no reason given" : text;
}

}  // namespace

struct Window::Handle {
    GLFWwindow* window = nullptr;
    WindowInput input;
    glm::dvec2 mouse{0};

    static Handle& of(GLFWwindow* window) {
        return *static_cast<Handle*>(glfwGetWindowUserPointer(window));
    }

    static void onKey(GLFWwindow* window, int key, int, int action, int) {
        if (action == GLFW_RELEASE) return;
        if (key == GLFW_KEY_ESCAPE) of(window).input.keys.push_back('\x1b');
        if ((key >= GLFW_KEY_A && key <= GLFW_KEY_Z) || (key >= GLFW_KEY_0 && key <= GLFW_KEY_9))
            of(window).input.keys.push_back(static_cast<char>(key));
    }
    // What glfwGetCursorPos() says is where the mouse is after all events, on some systems.
    static void onMove(GLFWwindow* window, double x, double y) { of(window).mouse = {x, y}; }
    static void onButton(GLFWwindow* window, int button, int action, int) {
        if (button == GLFW_MOUSE_BUTTON_LEFT && action == GLFW_PRESS)
            of(window).input.pressedAt = of(window).mouse;
    }
};

Window::Window(const std::string& title, int widthPx, int heightPx)
    : handle_(std::make_unique<Handle>()) {
    if (glfwInit() != GLFW_TRUE) throw std::runtime_error("window: " + lastGlfwError());
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
#ifndef NDEBUG
    glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, GLFW_TRUE);
#endif
    GLFWwindow* window = glfwCreateWindow(widthPx, heightPx, title.c_str(), nullptr, nullptr);
    if (window == nullptr) throw std::runtime_error("window: " + lastGlfwError());
    handle_->window = window;
    glfwMakeContextCurrent(window);
    glfwSetWindowUserPointer(window, handle_.get());
    glfwSetKeyCallback(window, Handle::onKey);
    glfwSetCursorPosCallback(window, Handle::onMove);
    glfwSetMouseButtonCallback(window, Handle::onButton);
    info_ = prepareCurrentContext("window");
    glfwSwapInterval(info_.softwareRasteriser ? 0 : 1);
}

Window::~Window() {
    // GLFW itself stays up for the process's life: it belongs to every window.
    glfwDestroyWindow(handle_->window);
}

bool Window::closeWanted() const {
    return glfwWindowShouldClose(handle_->window) == GLFW_TRUE;
}

WindowInput Window::poll() {
    handle_->input = {};
    glfwPollEvents();
    glfwGetFramebufferSize(handle_->window, &handle_->input.widthPx, &handle_->input.heightPx);
    return handle_->input;
}

void Window::setTitle(const std::string& title) {
    glfwSetWindowTitle(handle_->window, title.c_str());
}

void Window::copyFrom(unsigned framebuffer, int widthPx, int heightPx) {
    int width = 0;
    int height = 0;
    glfwGetFramebufferSize(handle_->window, &width, &height);
    // Bound, and with its viewport set: Mesa learns a window's new size from these two calls.
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    glViewport(0, 0, width, height);
    glBlitFramebuffer(0, 0, widthPx, heightPx, 0, 0, width, height, GL_COLOR_BUFFER_BIT,
                      width == widthPx && height == heightPx ? GL_NEAREST : GL_LINEAR);
}

void Window::swap() {
    glfwSwapBuffers(handle_->window);
}

GLFWwindow* Window::glfw() const {
    return handle_->window;
}

}  // namespace renderer

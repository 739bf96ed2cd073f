// SPDX-License-Identifier: MIT
#include "renderer/gl_context.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace renderer {
namespace {

std::string eglErrorText() {
    char text[16];
    std::snprintf(text, sizeof text, "0x%04x", static_cast<unsigned>(eglGetError()));
    return "EGL error " + std::string(text);
}

/// Extension names are whole words in EGL's list.
bool lists(const char* extensions, std::string_view name) {
    std::istringstream words(extensions == nullptr ? "" : extensions);
    return std::find(std::istream_iterator<std::string>(words), {}, name) !=
           std::istream_iterator<std::string>();
}

[[maybe_unused]] void printDebugMessage(GLenum, GLenum type, GLuint, GLenum severity, GLsizei,
                                        const GLchar* message, const void*) {
    if (severity == GL_DEBUG_SEVERITY_NOTIFICATION || type == GL_DEBUG_TYPE_PERFORMANCE) return;
    std::fprintf(stderr, "GL: %s\n", message);
}

/// Software rasterisers by the name they give themselves.
bool isSoftware(const std::string& renderer) {
    constexpr std::array names = {"llvmpipe", "softpipe",    "swrast",
                                  "SWR",      "SwiftShader", "Software Rasterizer"};
    return std::any_of(names.begin(), names.end(),
                       [&](const char* name) { return renderer.find(name) != std::string::npos; });
}

struct Platform {
    std::string name;
    EGLenum platform = 0;
    void* native = nullptr;
};

std::vector<Platform> hardwareDevices(const char* clientExtensions) {
    std::vector<Platform> platforms;
    if (!lists(clientExtensions, "EGL_EXT_platform_device")) return platforms;
    if (!lists(clientExtensions, "EGL_EXT_device_base") &&
        !lists(clientExtensions, "EGL_EXT_device_enumeration"))
        return platforms;
    std::array<EGLDeviceEXT, 16> devices{};
    EGLint count = 0;
    if (eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count) != EGL_TRUE)
        return platforms;
    for (EGLint i = 0; i < count; ++i) {
        EGLDeviceEXT device = devices[static_cast<std::size_t>(i)];
        if (lists(eglQueryDeviceStringEXT(device, EGL_EXTENSIONS), "EGL_MESA_device_software"))
            continue;
        platforms.push_back({"EGL device " + std::to_string(i), EGL_PLATFORM_DEVICE_EXT, device});
    }
    return platforms;
}

}  // namespace

struct HeadlessContext::Handle {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;

    /// Makes the context and makes it current; throws with the reason alone.
    explicit Handle(const Platform& platform) {
        // The EXT entry: libepoxy aborts the program on the core one where only the EXT entry
        // exists.
        display = eglGetPlatformDisplayEXT(platform.platform, platform.native, nullptr);
        if (display == EGL_NO_DISPLAY) throw std::runtime_error("no display, " + eglErrorText());
        if (eglInitialize(display, nullptr, nullptr) != EGL_TRUE)
            throw std::runtime_error("display does not initialise, " + eglErrorText());
        eglBindAPI(EGL_OPENGL_API);
        std::vector<EGLint> attributes = {
            EGL_CONTEXT_MAJOR_VERSION,       4,
            EGL_CONTEXT_MINOR_VERSION,       5,
            EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT};
#ifndef NDEBUG
        attributes.insert(attributes.end(), {EGL_CONTEXT_OPENGL_DEBUG, EGL_TRUE});
#endif
        attributes.push_back(EGL_NONE);
        context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
        if (context == EGL_NO_CONTEXT)
            throw std::runtime_error("no OpenGL 4.5 core context, " + eglErrorText());
        try {
            makeCurrent();
        } catch (...) {
            release();
            throw;
        }
    }
    ~Handle() {
        release();
    }
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;

    void makeCurrent() const {
        if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) != EGL_TRUE)
            throw std::runtime_error("context cannot be made current without a surface, " +
                                     eglErrorText());
    }

  private:
    // The display stays as it is: EGL hands the same one to every context of the process, and
    // terminating it would take the others down too.
    void release() {
        if (context == EGL_NO_CONTEXT) return;
        if (eglGetCurrentContext() == context)
            eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglDestroyContext(display, context);
        context = EGL_NO_CONTEXT;
    }
};

GlInfo prepareCurrentContext(std::string platform) {
    const auto text = [](GLenum name) {
        const GLubyte* value = glGetString(name);
        return std::string(value == nullptr ? "" : reinterpret_cast<const char*>(value));
    };
    GlInfo info{.renderer = text(GL_RENDERER),
                .version = text(GL_VERSION),
                .platform = std::move(platform)};
    info.softwareRasteriser = isSoftware(info.renderer);
    GLint texture = 0;
    GLint viewport[2] = {};
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &texture);
    glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport);
    info.maxResolution = std::min({texture, viewport[0], viewport[1]});

    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glDisable(GL_DITHER);
#ifndef NDEBUG
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(printDebugMessage, nullptr);
#endif
    return info;
}

HeadlessContext::HeadlessContext() {
    if (!epoxy_has_egl())
        throw std::runtime_error(
            "headless rendering: EGL is not installed (libEGL.so.1; Debian: libegl1, "
            "libegl-mesa0)");
    const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (!lists(extensions, "EGL_EXT_platform_base"))
        throw std::runtime_error("headless rendering: this EGL has no EGL_EXT_platform_base");

    std::string failures;
    const auto attempt = [&](const Platform& platform) -> std::unique_ptr<Handle> {
        try {
            return std::make_unique<Handle>(platform);
        } catch (const std::runtime_error& error) {
            failures += (failures.empty() ? "" : "; ") + platform.name + ": " + error.what();
            return nullptr;
        }
    };
    if (lists(extensions, "EGL_MESA_platform_surfaceless")) {
        handle_ = attempt({"EGL surfaceless", EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY});
        if (handle_) info_ = prepareCurrentContext("EGL surfaceless");
    }
    if (!handle_ || info_.softwareRasteriser) {
        for (const Platform& platform : hardwareDevices(extensions)) {
            auto device = attempt(platform);
            if (!device) continue;
            handle_ = std::move(device);
            handle_->makeCurrent();
            info_ = prepareCurrentContext(platform.name);
            break;
        }
        if (handle_) handle_->makeCurrent();
    }
    if (!handle_)
        throw std::runtime_error(
            "headless rendering: no OpenGL 4.5 core context could be made (" +
            (failures.empty() ? "EGL lists no surfaceless platform and no device" : failures) +
            ")");
}

HeadlessContext::~HeadlessContext() = default;

}  // namespace renderer

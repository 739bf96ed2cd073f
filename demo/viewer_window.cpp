// SPDX-License-Identifier: MIT
#include "demo/viewer_window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include "demo/picture.h"
#include "demo/viewer_message.h"
#include "demo/viewer_panel.h"

namespace demo {
namespace {

constexpr const char* kFont = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
constexpr float kTextPx = 15;
constexpr float kDegreesPerPx = 0.3F;
constexpr float kGrabPx = 12;          // how near to the line of the split view a drag begins
constexpr double kSecondsAround = 24;  // a path, once round

/// Of the desktop, where it is not in the window's units already.
float textScale(GLFWwindow* window) {
    float x = 1, y = 1;
    glfwGetWindowContentScale(window, &x, &y);
    int width = 1, widthPx = 1, height = 1, heightPx = 1;
    glfwGetWindowSize(window, &width, &height);
    glfwGetFramebufferSize(window, &widthPx, &heightPx);
    return widthPx > 0 ? x * static_cast<float>(width) / static_cast<float>(widthPx) : x;
}

/// Dear ImGui for one window.
class Interface {
  public:
    explicit Interface(const renderer::Window& window) {
        IMGUI_CHECKVERSION();
        ImGui::CreateContext();
        ImGui::GetIO().IniFilename = nullptr;  // the state file holds what is to be kept
        ImGui::StyleColorsDark();
        ImGui::GetStyle().FrameRounding = ImGui::GetStyle().WindowRounding = 4;
        ImGui::GetStyle().Colors[ImGuiCol_WindowBg].w = 0.88F;
        const float scale = textScale(window.glfw());
        ImGui::GetStyle().ScaleAllSizes(scale);
        if (std::filesystem::exists(kFont))
            ImGui::GetIO().Fonts->AddFontFromFileTTF(kFont, std::round(scale * kTextPx));
        ImGui_ImplGlfw_InitForOpenGL(window.glfw(), true);
        ImGui_ImplOpenGL3_Init("#version 450 core");
    }
    ~Interface() {
        ImGui_ImplOpenGL3_Shutdown();
        ImGui_ImplGlfw_Shutdown();
        ImGui::DestroyContext();
    }
    Interface(const Interface&) = delete;
    Interface& operator=(const Interface&) = delete;

    static void begin() {
        ImGui_ImplOpenGL3_NewFrame();
        ImGui_ImplGlfw_NewFrame();
        ImGui::NewFrame();
    }
    static void end() {
        ImGui::Render();
        ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    }
};

/// What the mouse does to the picture: turns, zooms, or moves the line of the split view.
class Mouse {
  public:
    void apply(const renderer::WindowInput& input, const Viewer& viewer, ViewerState& state) {
        const ImGuiIO& io = ImGui::GetIO();
        const bool overPicture = !io.WantCaptureMouse;
        ImVec2 moved = io.MouseDelta;
        if (overPicture && input.pressedAt) {
            const ImVec2 pressed(static_cast<float>(input.pressedAt->x),
                                 static_cast<float>(input.pressedAt->y));
            held_ = nearLine(state, pressed) ? Held::line : Held::scene;
            moved = {io.MousePos.x - pressed.x, io.MousePos.y - pressed.y};
        }
        if (!ImGui::IsMouseDown(ImGuiMouseButton_Left)) held_ = Held::nothing;
        if (held_ == Held::line)
            state.splitAt = std::clamp(io.MousePos.x / io.DisplaySize.x, 0.0F, 1.0F);
        const renderer::OrbitCamera& own = viewer.sceneCamera();
        const bool turned = moved.x != 0 || moved.y != 0;
        if (held_ == Held::scene && turned) {
            // The path's share stays with the path.
            state.cameraYawDeg = std::remainder(
                state.cameraYawDeg.value_or(own.yawDeg) - kDegreesPerPx * moved.x, 360.0F);
            state.cameraPitchDeg = std::clamp(
                state.cameraPitchDeg.value_or(own.pitchDeg) + kDegreesPerPx * moved.y, 2.0F, 88.0F);
        }
        if (overPicture && io.MouseWheel != 0)
            state.cameraDistanceM = zoomed(state.cameraDistanceM.value_or(own.distanceM),
                                           std::pow(0.9F, io.MouseWheel), own);
        if (nearLine(state, io.MousePos) && overPicture)
            ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    }

  private:
    enum class Held { nothing, scene, line };

    static bool nearLine(const ViewerState& state, const ImVec2& mouse) {
        return state.view == renderer::View::split &&
               std::abs(mouse.x - state.splitAt * ImGui::GetIO().DisplaySize.x) < kGrabPx;
    }

    Held held_ = Held::nothing;
};

/// The first name that is free: nothing is overwritten.
std::filesystem::path freeName(const std::filesystem::path& folder) {
    for (int i = 1;; ++i) {
        char name[32];
        std::snprintf(name, sizeof name, "shadow_demo-%03d.png", i);
        if (!std::filesystem::exists(folder / name)) return folder / name;
    }
}

std::string savePicture(Viewer& viewer, const std::filesystem::path& folder) {
    const std::filesystem::path file = freeName(folder);
    try {
        writePng(file, viewer.picture(2));
    } catch (const std::exception& error) {
        return error.what();
    }
    return "saved as " + file.string();
}

/// All but the times.
FrameHistory::Entry entryOf(const ShadowRun& run) {
    FrameHistory::Entry entry;
    entry.resolution = static_cast<float>(run.chosen().resolution);
    for (const ChosenResolution& map : run.maps()) {
        const auto edge = static_cast<float>(map.resolution);
        entry.mapTexels += edge * edge;
        entry.artifactRatio = std::max(entry.artifactRatio, static_cast<float>(map.artifactRatio));
    }
    return entry;
}

/// What came of it.
std::string useSlope(Viewer& viewer, const std::optional<std::filesystem::path>& file) {
    if (file && file->empty()) return "Load: no slope.json is named";
    try {
        viewer.useSlope(file);
    } catch (const std::exception& error) {
        return error.what();  // the slope stays
    }
    return file ? "the slope of " + file->string() + " is in use" : "the published slope is in use";
}

/// What came of it.
std::string reloadShaders(Viewer& viewer, const std::optional<std::filesystem::path>& folder) {
    if (!folder) return "the shaders are those of the program; start it with --shaders FOLDER";
    try {
        viewer.reload(renderer::ShaderLibrary::fromFolder(*folder));
    } catch (const std::exception& error) {
        std::fprintf(stderr, "shadow_demo: %s\n", error.what());
        return std::string(error.what()) + "\nthe last good shaders stay";
    }
    return "shaders of " + folder->string() + " are in use";
}

/// To what could be drawn, after what the driver has refused. Where that is refused too, by now,
/// the message about it stays, and the picture as it is.
void goBack(Viewer& viewer, const ViewerState& before) {
    try {
        viewer.show(before);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "shadow_demo: %s\n", error.what());
    }
}

/// By a clock that never goes back.
double secondsNow() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

/// Which map is on which side of the split view's line.
void labelSides(const Viewer& viewer) {
    const ViewerState& state = viewer.state();
    if (state.view != renderer::View::split) return;
    const bool several = viewer.run().maps().size() > 1;
    const ChosenResolution& chosen = viewer.run().chosen();
    const auto labelOf = [](const std::string& what, int size) {
        return what + ": " + std::to_string(size);
    };
    const std::string left = !chosen.automatic ? labelOf("fixed", chosen.resolution)
                             : several         ? "automatic sizes"
                                               : labelOf("automatic", chosen.resolution);
    const std::string right = labelOf("fixed", state.compareWith);
    const float em = ImGui::GetFontSize();
    const float line = state.splitAt * ImGui::GetIO().DisplaySize.x;
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    const auto label = [&](const std::string& text, float x) {
        const ImVec2 size = ImGui::CalcTextSize(text.c_str());
        const float top = em, padding = 0.4F * em;
        draw.AddRectFilled({x - padding, top - padding},
                           {x + size.x + padding, top + size.y + padding},
                           IM_COL32(15, 15, 15, 200), 4);
        draw.AddText({x, top}, IM_COL32_WHITE, text.c_str());
    };
    label(left, line - em - ImGui::CalcTextSize(left.c_str()).x);
    label(right, line + em);
}

}  // namespace

void showViewer(renderer::Window& window, Viewer& viewer, const ViewerWindowOptions& options) {
    const Interface interface(window);
    renderer::PassClock clock(window.info());
    FrameHistory history;
    PanelTexts texts;
    viewer.slope().file.copy(texts.slopeFile.data(), texts.slopeFile.size() - 1);
    Mouse mouse;
    ViewerMessage message;
    double smoothMs = 0;
    auto last = std::chrono::steady_clock::now();
    for (int shown = 0; !window.closeWanted() && (options.frames == 0 || shown < options.frames);
         ++shown) {
        const renderer::WindowInput input = window.poll();
        ViewerState state = viewer.state();
        for (const char key : input.keys) {
            if (ImGui::GetIO().WantTextInput) continue;
            if (key == '\x1b') return;
            if (key == kReloadKey)
                message.say(reloadShaders(viewer, options.shaderFolder));
            else
                applyKey(key, state);
        }
        if (input.widthPx > 0 && input.heightPx > 0) viewer.resize(input.widthPx, input.heightPx);

        const auto now = std::chrono::steady_clock::now();
        const double seconds = std::chrono::duration<double>(now - last).count();
        last = now;
        if (state.path != Path::still)
            state.pathPlace = std::fmod(state.pathPlace + seconds / kSecondsAround, 1.0);

        Interface::begin();
        mouse.apply(input, viewer, state);
        PanelRequest request;
        labelSides(viewer);
        if (state.panel) request = drawPanel(viewer, history, texts, state);
        const ViewerState before = viewer.state();
        try {
            viewer.show(state);
        } catch (const std::exception& error) {
            message.say(error.what());  // the picture stays as it was
        }
        if (request.useTypedSlope) message.say(useSlope(viewer, texts.slopeFile.data()));
        if (request.usePublishedSlope) message.say(useSlope(viewer, std::nullopt));
        try {
            viewer.step(state.timePasses ? &clock : nullptr);
        } catch (const std::exception& error) {
            message.say(error.what());
            goBack(viewer, before);
        }
        if (request.screenshot) message.say(savePicture(viewer, options.pictureFolder));
        window.copyFrom(viewer.framebuffer(), viewer.frame().widthPx(), viewer.frame().heightPx());
        drawMessage(message.shownAt(secondsNow()));
        Interface::end();
        if (options.windowPicture && shown + 1 == options.frames)
            writePng(*options.windowPicture,
                     renderer::readWindow(viewer.frame().widthPx(), viewer.frame().heightPx()));
        window.swap();

        const double ms = 1000 * seconds;
        if (shown > 0) smoothMs = smoothMs == 0 ? ms : 0.9 * smoothMs + 0.1 * ms;
        FrameHistory::Entry entry = entryOf(viewer.run());
        entry.frameMs = static_cast<float>(smoothMs);
        if (state.timePasses) entry.passesMs = clock.collectMs();
        history.add(entry);
    }
}

}  // namespace demo

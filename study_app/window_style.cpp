// SPDX-License-Identifier: MIT
#include "study_app/window_style.h"

#include <imgui.h>

#include <cmath>
#include <filesystem>

namespace study_app {
namespace {

constexpr const char* kFontFolder = "/usr/share/fonts/truetype/dejavu/";
// Sizes at scale 1, px: body text that is read easily at arm's length.
constexpr float kTextPx = 17, kHeadingPx = 27, kSmallPx = 14;

}  // namespace

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

Fonts loadFonts(float scale, std::vector<std::string>& notices) {
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    // Latin and Greek letters, dashes and arrows.
    static constexpr ImWchar ranges[] = {0x20,   0x17f,  0x391,  0x3c9,  0x2010, 0x2026,
                                         0x2190, 0x2193, 0x2212, 0x2212, 0};
    const auto load = [&](const char* name, float px) -> ImFont* {
        const std::filesystem::path file = std::filesystem::path(kFontFolder) / name;
        if (!std::filesystem::exists(file)) {
            notices.push_back(file.string() +
                              ": is missing: text is drawn with a built-in bitmap font (package "
                              "fonts-dejavu-core)");
            ImFontConfig config;
            config.SizePixels = std::round(px * scale);
            return atlas.AddFontDefault(&config);
        }
        return atlas.AddFontFromFileTTF(file.c_str(), std::round(px * scale), nullptr, ranges);
    };
    Fonts fonts;
    fonts.text = load("DejaVuSans.ttf", kTextPx);
    fonts.heading = load("DejaVuSans.ttf", kHeadingPx);
    fonts.small = load("DejaVuSans.ttf", kSmallPx);
    return fonts;
}

}  // namespace study_app

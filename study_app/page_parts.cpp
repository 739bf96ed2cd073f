// SPDX-License-Identifier: MIT
#include "study_app/page_parts.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace study_app {
namespace {

constexpr float kFooterPx = 112, kMarginPx = 32;
const ImVec4 kWarningColor{0.95f, 0.72f, 0.36f, 1};
const ImVec4 kAccent{0.25f, 0.46f, 0.72f, 1}, kAccentHovered{0.31f, 0.54f, 0.81f, 1};

bool button(const Page& page, const char* label, bool primary) {
    if (primary) {
        ImGui::PushStyleColor(ImGuiCol_Button, kAccent);
        ImGui::PushStyleColor(ImGuiCol_ButtonHovered, kAccentHovered);
        ImGui::PushStyleColor(ImGuiCol_ButtonActive, kAccentHovered);
    }
    const float width = ImGui::CalcTextSize(label).x + page.px(36);
    const bool pressed = ImGui::Button(label, {std::max(width, page.px(120)), page.px(38)});
    if (primary) ImGui::PopStyleColor(3);
    return pressed;
}

}  // namespace

void beginPage(const Page& page, const char* title, float width) {
    const auto w = static_cast<float>(page.window.widthPx());
    const auto h = static_cast<float>(page.window.heightPx());
    const float margin = page.px(kMarginPx);
    const float column = std::min(page.px(width), w - 2 * margin);
    ImGui::SetNextWindowPos({std::round((w - column) / 2), 0});
    ImGui::SetNextWindowSize({column, h});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    ImGui::Begin("page", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoBackground |
                     ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoScrollWithMouse);
    ImGui::SetCursorPosY(page.px(44));
    ImGui::PushFont(page.window.fonts().heading);
    ImGui::TextUnformatted(title);
    ImGui::PopFont();
    ImGui::Dummy({0, page.px(8)});
    ImGui::BeginChild("content", {0, -page.px(kFooterPx)}, false, ImGuiWindowFlags_NoBackground);
    ImGui::PopStyleVar();
}

std::optional<Pressed> endPage(const Page& page, const Footer& footer) {
    ImGui::EndChild();
    std::optional<Pressed> pressed;
    ImGui::SetCursorPosY(static_cast<float>(page.window.heightPx()) - page.px(kFooterPx - 20));
    if (footer.primary != nullptr) {
        ImGui::BeginDisabled(!footer.enabled);
        if (button(page, footer.primary, true)) pressed = Pressed::primary;
        ImGui::EndDisabled();
        const bool listOpen = ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup);
        if (page.returnPressed && footer.enabled && !listOpen) pressed = Pressed::primary;
        ImGui::SameLine(0, page.px(14));
    }
    if (footer.secondary != nullptr) {
        ImGui::BeginDisabled(!footer.secondaryEnabled);
        if (button(page, footer.secondary, false)) pressed = Pressed::secondary;
        ImGui::EndDisabled();
        ImGui::SameLine(0, page.px(14));
    }
    if (footer.tertiary != nullptr) {
        if (button(page, footer.tertiary, false)) pressed = Pressed::tertiary;
        ImGui::SameLine(0, page.px(14));
    }
    if (!footer.note.empty()) {
        ImGui::SetCursorPosY(ImGui::GetCursorPosY() + page.px(9));
        ImGui::PushFont(page.window.fonts().small);
        ImGui::PushTextWrapPos(0);
        ImGui::TextDisabled("%s", footer.note.c_str());
        ImGui::PopTextWrapPos();
        ImGui::PopFont();
    }
    ImGui::End();
    return pressed;
}

void paragraph(const std::string& text) {
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::Spacing();
}

void faint(const Page& page, const std::string& text) {
    ImGui::PushFont(page.window.fonts().small);
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
    ImGui::PopFont();
}

void warning(const std::string& text) {
    ImGui::PushStyleColor(ImGuiCol_Text, kWarningColor);
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
}

std::string minutesText(double seconds) {
    char text[64];
    if (seconds < 60) return "less than a minute";
    const double minutes = std::round(seconds / 60);
    std::snprintf(text, sizeof text, "about %.0f minute%s", minutes, minutes == 1 ? "" : "s");
    return text;
}

void drawProgress(const Page& page, const SessionRunner& runner) {
    const auto w = static_cast<float>(page.window.widthPx());
    const auto h = static_cast<float>(page.window.heightPx());
    const Session& session = runner.session();
    const float width = std::min(page.px(600), w - page.px(64));
    const float x = std::round((w - width) / 2), y = h - page.px(16);
    const float share = session.total() == 0 ? 1
                                             : static_cast<float>(session.answered()) /
                                                   static_cast<float>(session.total());
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    const float thickness = page.px(4);
    draw.AddRectFilled({x, y}, {x + width, y + thickness}, IM_COL32(90, 90, 92, 255),
                       thickness / 2);
    if (share > 0) {
        draw.AddRectFilled({x, y}, {x + std::max(thickness, width * share), y + thickness},
                           IM_COL32(150, 165, 185, 255), thickness / 2);
    }
    const std::string text = std::to_string(session.answered()) + " of " +
                             std::to_string(session.total()) + "  ·  " +
                             minutesText(runner.secondsLeft()) + " left";
    ImFont* font = page.window.fonts().small;
    const ImVec2 size = font->CalcTextSizeA(font->FontSize, 1e6f, 0, text.c_str());
    draw.AddText(font, font->FontSize,
                 {std::round((w - size.x) / 2), std::round(y - size.y - page.px(4))},
                 IM_COL32(175, 175, 178, 255), text.c_str());
}

void image(const Page& page, const cv::Mat& codes) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    page.images.push_back({.codes = codes,
                           .x = static_cast<int>(std::lround(at.x)),
                           .y = static_cast<int>(std::lround(at.y))});
    ImGui::Dummy({static_cast<float>(codes.cols), static_cast<float>(codes.rows)});
}

}  // namespace study_app

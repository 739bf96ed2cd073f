// SPDX-License-Identifier: MIT
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "study_app/page_parts.h"
#include "study_app/screens.h"
#include "study_app/session_start.h"

namespace study_app {
namespace {

constexpr float kLeastCardPx = 80, kMoreWidthPx = 470;
constexpr int kLeastGrey = 128, kMostGrey = 221;  // gamma 1 to 4.8

template <typename... Values>
std::string formatted(const char* format, Values... values) {
    char text[200];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

void match(CalibrationState& c, double widthPx, const Page& page, float widest) {
    const double least = page.px(kLeastCardPx);
    c.cardWidthPx = std::round(std::clamp(widthPx, least, std::max<double>(least, widest)));
    c.cardMatched = true;
}

/// The card's outline, as wide as it was matched. Its right edge follows the mouse.
void drawCard(CalibrationState& c, const Page& page, float widest) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const auto width = static_cast<float>(std::lround(c.cardWidthPx));
    const auto height =
        static_cast<float>(std::lround(c.cardWidthPx * kCardHeightMm / kCardWidthMm));
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImVec2 corner{std::round(at.x), std::round(at.y)};
    draw.AddRectFilled(corner, {corner.x + width, corner.y + height}, IM_COL32(62, 66, 72, 255),
                       width * 3.18f / 85.6f);
    draw.AddRectFilled({corner.x + width - page.px(3), corner.y + page.px(14)},
                       {corner.x + width, corner.y + height - page.px(14)},
                       IM_COL32(120, 175, 235, 255));
    const char* hint = "drag this edge  →";
    ImFont* font = page.window.fonts().small;
    const ImVec2 size = font->CalcTextSizeA(font->FontSize, 1e6f, 0, hint);
    if (size.x + page.px(24) < width) {
        draw.AddText(font, font->FontSize,
                     {corner.x + width - size.x - page.px(12), corner.y + height / 2 - size.y / 2},
                     IM_COL32(190, 190, 192, 255), hint);
    }
    ImGui::SetCursorScreenPos({corner.x + width - page.px(24), corner.y});
    ImGui::InvisibleButton("edge", {page.px(36), height});
    if (ImGui::IsItemHovered() || ImGui::IsItemActive()) {
        ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    }
    if (ImGui::IsItemActive() && ImGui::GetIO().MouseDelta.x != 0) {
        match(c, ImGui::GetIO().MousePos.x - corner.x, page, widest);
    }
    ImGui::SetCursorScreenPos({at.x, at.y + height + page.px(10)});
}

/// A full area of one code, as large as the heads of most photometers.
void drawPatch(int code, const Page& page) {
    ImGui::TextColored({0.62f, 0.75f, 0.92f, 1}, "Code %d", code);
    faint(page, "Hold the photometer against this area and type what it reads.");
    ImGui::Dummy({0, page.px(4)});
    const auto edge = static_cast<int>(page.px(360));
    image(page, cv::Mat(edge, edge, CV_8UC1, cv::Scalar(code)));
}

void drawCardColumn(CalibrationState& c, const Page& page, float widest) {
    if (c.patchCode) return drawPatch(*c.patchCode, page);
    ImGui::TextColored({0.62f, 0.75f, 0.92f, 1}, "Size of a pixel");
    faint(page,
          "Hold a bank card against the screen and drag the right edge until the sizes agree.");
    ImGui::Dummy({0, page.px(4)});
    const auto nudge = [&](const char* text, double by) {
        if (ImGui::Button(text)) match(c, c.cardWidthPx + by, page, widest);
        ImGui::SameLine();
    };
    nudge("−1 px", -1);
    nudge("+1 px", 1);
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(c.cardMatched ? formatted("%.0f px, %.3f px/mm", c.cardWidthPx,
                                                     pxPerMmFromCard(c.cardWidthPx))
                                               .c_str()
                                         : "not matched yet");
    ImGui::Dummy({0, page.px(4)});
    drawCard(c, page, widest);
}

cv::Mat gammaPattern(int edgePx, int greyCode) {
    cv::Mat codes(edgePx, 2 * edgePx, CV_8UC1);
    for (int row = 0; row < edgePx; ++row) {
        codes.row(row).colRange(0, edgePx).setTo(row % 2 == 0 ? 255 : 0);
        codes.row(row).colRange(edgePx, 2 * edgePx).setTo(greyCode);
    }
    return codes;
}

void drawGamma(CalibrationState& c, const Page& page) {
    ImGui::TextColored({0.62f, 0.75f, 0.92f, 1}, "Gamma");
    faint(page, "From a step back, move the slider until both halves are equally bright.");
    image(page, gammaPattern(static_cast<int>(page.px(104)), c.greyCode));
    ImGui::SameLine(0, page.px(16));
    ImGui::BeginGroup();
    ImGui::SetNextItemWidth(-1);
    if (ImGui::SliderInt("##gamma", &c.greyCode, kLeastGrey, kMostGrey, "",
                         ImGuiSliderFlags_AlwaysClamp)) {
        c.gammaGiven = true;
    }
    const std::string gamma =
        c.gammaGiven ? formatted("gamma %.2f", gammaFromGreyCode(c.greyCode)) : "not matched yet";
    ImGui::TextUnformatted(formatted("code %d: ", c.greyCode).append(gamma).c_str());
    ImGui::EndGroup();
}

void drawDistance(CalibrationState& c, const Page& page) {
    ImGui::TextColored({0.62f, 0.75f, 0.92f, 1}, "Viewing distance");
    ImGui::SetNextItemWidth(page.px(190));
    // What nobody gave is not recorded, so it must not look as if it were.
    const char* format = c.distanceGiven ? "%g cm" : "not given yet";
    if (ImGui::InputDouble("##distance", &c.distanceCm, 0, 0, format)) {
        c.distanceCm = std::clamp(c.distanceCm, 5.0, 5000.0);
        c.distanceGiven = true;
    }
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("from the eye");
}

void drawLuminance(CalibrationState& c, const Page& page) {
    ImGui::TextColored({0.62f, 0.75f, 0.92f, 1}, "Luminance");
    faint(page, "Optional, with a photometer: click a field, and its code is shown at the left.");
    c.patchCode.reset();
    const auto field = [&](const char* name, int code, std::string& text) {
        ImGui::BeginGroup();
        ImGui::AlignTextToFramePadding();  // as those beside a field are without asking
        faint(page, formatted("%s, code %d", name, code));
        ImGui::SetNextItemWidth(page.px(130));
        ImGui::InputTextWithHint((std::string("##") + name).c_str(), "cd/m2", &text,
                                 ImGuiInputTextFlags_CharsDecimal);
        if (ImGui::IsItemActive()) c.patchCode = code;
        ImGui::EndGroup();
    };
    field("black", 0, c.blackText);
    ImGui::SameLine();
    field("grey", records::kMeasuredGreyCode, c.greyText);
    ImGui::SameLine();
    field("white", 255, c.whiteText);
    try {
        const auto gamma = gammaFromLuminance(luminanceTyped(c));
        if (gamma) faint(page, formatted("By these readings the gamma is %.2f.", *gamma));
    } catch (const std::runtime_error&) {
        // Half a number: what is wrong with it is said on going on.
    }
}

/// What the design's steps are to the eye.
void drawAngles(const AppState& state, const Page& page) {
    const CalibrationState& c = state.calibration;
    if (!c.cardMatched || !c.distanceGiven) {
        faint(page, "Visual angles follow once the card is matched and the distance given.");
        return;
    }
    const double pxPerMm = pxPerMmFromCard(c.cardWidthPx), distanceMm = 10 * c.distanceCm;
    paragraph(formatted("%.1f px per degree; one pixel is %.2f arc minutes",
                        pxPerDeg(pxPerMm, distanceMm), arcMinutes(1, pxPerMm, distanceMm)));
    if (!state.setup.design) return;
    const int window = state.setup.design->windowPx;
    faint(page, formatted("The stimulus is %d px, %.1f° wide.", window,
                          arcMinutes(window, pxPerMm, distanceMm) / 60));
    if (state.setup.design->frames) return;
    std::string sizes = "Steps of ";
    for (const int a : state.setup.design->artifactPx) {
        if (sizes.size() > 9) sizes += ", ";
        sizes += formatted("%d px: %.1f'", a, arcMinutes(a, pxPerMm, distanceMm));
    }
    faint(page, sizes);
}

}  // namespace

std::optional<Request> drawCalibration(AppState& state, const Page& page) {
    beginPage(page, "Display", 1400);
    CalibrationState& c = state.calibration;
    faint(page, c.profile.name + ", " + std::to_string(c.profile.widthPx) + " x " +
                    std::to_string(c.profile.heightPx) +
                    (c.known ? ": calibrated before. Check it where anything has changed."
                             : ": not calibrated yet."));
    if (!c.warnings.empty()) warning(c.warnings);
    if (!c.problem.empty()) warning(c.problem);
    ImGui::Dummy({0, page.px(10)});
    // The card's column grows with the card, as long as the other one keeps what it needs.
    const float half = std::floor(ImGui::GetContentRegionAvail().x * 0.5f);
    const float room = page.px(28);  // to the right of the card
    const float most = std::max(half, ImGui::GetContentRegionAvail().x - page.px(kMoreWidthPx));
    const float left = std::clamp(static_cast<float>(c.cardWidthPx) + room, half, most);
    ImGui::BeginChild("card", {left - page.px(16), 0}, false, ImGuiWindowFlags_NoBackground);
    drawCardColumn(c, page, most - room);
    ImGui::EndChild();
    ImGui::SameLine(0, page.px(32));
    ImGui::BeginChild("more", {0, 0}, false, ImGuiWindowFlags_NoBackground);
    drawDistance(c, page);
    ImGui::Dummy({0, page.px(4)});
    drawAngles(state, page);
    ImGui::Dummy({0, page.px(14)});
    drawGamma(c, page);
    ImGui::Dummy({0, page.px(14)});
    drawLuminance(c, page);
    ImGui::EndChild();
    const std::string note = c.cardMatched && c.distanceGiven && c.gammaGiven
                                 ? ""
                                 : "What is not measured is recorded as unknown.";
    const auto pressed = endPage(page, {.primary = "Continue", .secondary = "Back", .note = note});
    if (pressed == Pressed::primary) return Request::next;
    if (pressed == Pressed::secondary) return Request::back;
    return {};
}

}  // namespace study_app

// SPDX-License-Identifier: MIT
#include <imgui.h>

#include <cmath>
#include <string>

#include "quest/random.h"
#include "study_app/page_parts.h"
#include "study_app/screens.h"

namespace study_app {
namespace {

constexpr int kGapPx = 40;  // between the two edges of a pair

std::vector<PlacedImage> placed(const Page& page, const cv::Mat& left, const cv::Mat& right) {
    const int width = left.cols + (right.empty() ? 0 : kGapPx + right.cols);
    const cv::Point at = stimulusOrigin(page.window, {width, left.rows});
    std::vector<PlacedImage> images{{left, at.x, at.y}};
    if (!right.empty()) images.push_back({right, at.x + left.cols + kGapPx, at.y});
    return images;
}

/// Noise of single pixels over the codes that stimuli have, another one for each trial.
cv::Mat maskCodes(int edgePx, std::uint64_t seed) {
    cv::Mat codes(edgePx, edgePx, CV_8UC1);
    std::mt19937_64 rng(seed);
    for (int row = 0; row < edgePx; ++row) {
        for (int c = 0; c < edgePx; ++c) {
            codes.at<std::uint8_t>(row, c) = static_cast<std::uint8_t>(rng() >> 56);
        }
    }
    return codes;
}

void drawCross(const Page& page) {
    // Even sizes around the window's middle, on whole pixels.
    const float x = static_cast<float>(page.window.widthPx() / 2);
    const float y = static_cast<float>(page.window.heightPx() / 2);
    const float arm = std::round(page.px(9)), half = std::round(page.px(1));
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    const ImU32 color = IM_COL32(205, 205, 205, 255);
    draw.AddRectFilled({x - arm, y - half}, {x + arm, y + half}, color);
    draw.AddRectFilled({x - half, y - arm}, {x + half, y + arm}, color);
}

void drawLine(const Page& page, const std::string& text, float y, ImU32 color, ImFont* font) {
    const ImVec2 size = font->CalcTextSizeA(font->FontSize, 1e6f, 0, text.c_str());
    const float x = std::round((static_cast<float>(page.window.widthPx()) - size.x) / 2);
    ImGui::GetBackgroundDrawList()->AddText(font, font->FontSize, {x, std::round(y)}, color,
                                            text.c_str());
}

std::string hint(const SessionRunner& runner) {
    const Design& design = runner.session().design();
    if (design.localise) return "←  no steps      ·      click on the steps";
    const bool pair = design.task == records::Task::twoAfc;
    return pair ? "←  steps on the left      ·      steps on the right  →"
                : "←  no steps      ·      steps  →";
}

std::string practiceText(const SessionRunner& runner) {
    const Practice& practice = runner.practice();
    return "Practice: " + std::to_string(practice.rightOfLast()) + " right, " +
           std::to_string(practice.rule().correct) + " of the last " +
           std::to_string(practice.rule().ofLast) + " are needed";
}

void drawFeedback(const Page& page, bool right) {
    const auto y = static_cast<float>(page.window.heightPx()) / 2;
    ImFont* font = page.window.fonts().heading;
    drawLine(page, right ? "right" : "wrong", y - font->FontSize / 2,
             right ? IM_COL32(135, 200, 140, 255) : IM_COL32(235, 150, 120, 255), font);
}

std::string messageOf(const AppState& state) {
    if (!state.message.empty()) return state.message;
    if (state.runner->lastTooFast()) return "That was too fast. The trial comes again.";
    if (state.runner->lastTimedOut()) return "The time was over. The trial comes again.";
    return {};
}

}  // namespace

cv::Size stimulusArea(records::Task task, int windowPx) {
    return {task == records::Task::twoAfc ? 2 * windowPx + kGapPx : windowPx, windowPx};
}

std::string tooSmall(const Window& window, const Design& design) {
    const cv::Size needed = stimulusArea(design.task, design.windowPx);
    if (needed.width <= window.widthPx() && needed.height <= window.heightPx()) return {};
    return "The stimuli need " + std::to_string(needed.width) + " x " +
           std::to_string(needed.height) + " pixels, the window has " +
           std::to_string(window.widthPx()) + " x " + std::to_string(window.heightPx()) + ".";
}

cv::Point stimulusOrigin(const Window& window, cv::Size area) {
    return {(window.widthPx() - area.width) / 2, (window.heightPx() - area.height) / 2};
}

void drawStimuli(AppState& state, const Page& page) {
    SessionRunner& runner = *state.runner;
    const TrialPhase phase = runner.phase();
    const Design& design = runner.session().design();
    const auto& fonts = page.window.fonts();
    const bool place = phase == TrialPhase::place;
    const bool stimulus = runner.stimulusDue(page.now) || phase == TrialPhase::stimulus || place;
    if (stimulus) {
        const TrialImages& images = runner.images();
        for (PlacedImage& image : placed(page, images.left, images.right)) {
            page.images.push_back(std::move(image));
        }
    } else if (phase == TrialPhase::blank && runner.presentation().between == Between::mask) {
        const auto seed = static_cast<std::uint64_t>(runner.session().rows());
        const bool pair = design.task == records::Task::twoAfc;
        const cv::Mat left = maskCodes(design.windowPx, 2 * seed);
        const cv::Mat right = pair ? maskCodes(design.windowPx, 2 * seed + 1) : cv::Mat();
        for (PlacedImage& image : placed(page, left, right)) page.images.push_back(image);
    } else if (phase == TrialPhase::fixation) {
        drawCross(page);
    } else if (phase == TrialPhase::feedback) {
        drawFeedback(page, runner.lastRight());
    }
    const auto h = static_cast<float>(page.window.heightPx());
    const ImU32 quiet = IM_COL32(175, 175, 178, 255);
    if (place) {
        drawLine(page, "Click where you see the steps.", page.px(30), quiet, fonts.text);
    } else if (!stimulus) {
        drawLine(page, messageOf(state), page.px(30), IM_COL32(240, 196, 120, 255), fonts.text);
    }
    if (runner.stage() == SessionRunner::Stage::practice) {
        drawLine(page, practiceText(runner), h - page.px(38), quiet, fonts.small);
        if (!place)
            drawLine(page, hint(runner), page.px(30) + (messageOf(state).empty() ? 0 : page.px(26)),
                     quiet, fonts.text);
    } else {
        drawProgress(page, runner);
    }
}

}  // namespace study_app

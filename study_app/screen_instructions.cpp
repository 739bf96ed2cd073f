// SPDX-License-Identifier: MIT
#include <imgui.h>

#include <algorithm>

#include "stimulus/stimulus_image.h"
#include "study_app/frame_images.h"
#include "study_app/page_parts.h"
#include "study_app/screens.h"

namespace study_app {
namespace {

/// A stair that nobody overlooks, and its straight edge, in the design's encoding.
stimulus::StimulusOptions exampleStimulus(const Design& design, int edgePx) {
    stimulus::StimulusOptions o;
    o.silhouette.artifactPx = edgePx / 10;
    o.kernel = {.shape = stimulus::KernelShape::disc, .radiusPx = edgePx / 12.0};
    o.windowPx = edgePx;
    o.encoding = design.encoding == records::Encoding::code ? stimulus::Encoding::code
                                                            : stimulus::Encoding::srgb;
    return o;
}

struct Examples {
    cv::Mat steps, straight;
};

Examples edgeExamples(const Design& design, int edgePx) {
    const stimulus::StimulusOptions example = exampleStimulus(design, edgePx);
    return {stimulus::artifactImage(example), stimulus::straightImage(example)};
}

/// Of the pair whose steps are plainest, the part in which the two differ most.
Examples frameExamples(const Design& design, int edgePx) {
    const Condition condition = conditions(design).front();
    const records::FramePair& plainest = condition.frames.front();
    const cv::Mat steps = readFrame(*design.frames, plainest.artifact, design.windowPx);
    const cv::Mat straight = readFrame(*design.frames, plainest.converged, design.windowPx);
    cv::Mat difference;
    cv::absdiff(steps, straight, difference);
    cv::Point middle;
    cv::minMaxLoc(difference, nullptr, nullptr, nullptr, &middle);
    const int edge = std::min(edgePx, design.windowPx);
    const auto begin = [&](int at) { return std::clamp(at - edge / 2, 0, design.windowPx - edge); };
    const cv::Rect part(begin(middle.x), begin(middle.y), edge, edge);
    return {steps(part).clone(), straight(part).clone()};
}

void drawExamples(const AppState& state, const Page& page) {
    const auto edge = static_cast<int>(page.px(190));
    const Design& design = *state.setup.design;
    const Examples examples =
        design.frames ? frameExamples(design, edge) : edgeExamples(design, edge);
    const auto captioned = [&](const cv::Mat& codes, const char* caption) {
        ImGui::BeginGroup();
        image(page, codes);
        faint(page, caption);
        ImGui::EndGroup();
    };
    ImGui::Dummy({0, page.px(4)});
    captioned(examples.steps, "with steps");
    ImGui::SameLine(0, page.px(28));
    captioned(examples.straight, "without steps");
    ImGui::Dummy({0, page.px(8)});
}

}  // namespace

std::optional<Request> drawInstructions(AppState& state, const Page& page) {
    beginPage(page, "Welcome", 780);
    for (const InstructionBlock& block : state.instructions) {
        if (block.kind == InstructionBlock::Kind::heading) {
            ImGui::Dummy({0, page.px(2)});
            ImGui::TextColored({0.62f, 0.75f, 0.92f, 1}, "%s", block.text.c_str());
        } else if (block.kind == InstructionBlock::Kind::paragraph) {
            paragraph(block.text);
        } else {
            drawExamples(state, page);
        }
    }
    const auto pressed = endPage(page, {.primary = "I agree, begin", .secondary = "Back"});
    if (pressed == Pressed::primary) return Request::next;
    if (pressed == Pressed::secondary) return Request::back;
    return {};
}

}  // namespace study_app

// SPDX-License-Identifier: MIT
#include <imgui.h>

#include <cstdio>

#include "study_app/page_parts.h"
#include "study_app/screens.h"
#include "study_app/session_report.h"

namespace study_app {
namespace {

template <typename... Values>
std::string formatted(const char* format, Values... values) {
    char text[200];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

void cell(const std::string& text) {
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(text.c_str());
}

void drawResult(AppState& state, const Page& page, const RunResult& run, int row,
                std::optional<Request>& request) {
    const ConditionResult& r = run.result;
    ImGui::TableNextRow();
    cell(run.rerun.empty() ? r.threshold.condition : "   again (" + run.rerun + ")");
    cell(std::to_string(r.threshold.trials));
    cell(formatted("%.2f", r.threshold.c));
    cell(formatted("%.2f – %.2f", r.cLow, r.cHigh));
    cell(formatted("%.1f px", r.threshold.radiusPx));
    ImGui::TableNextColumn();
    if (!r.flagged()) return;
    if (run.offered) {
        ImGui::PushID(row);
        ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {page.px(8), page.px(1)});
        const bool pressed = ImGui::Button("Run again");
        ImGui::PopStyleVar();
        if (pressed) {
            state.rerun = r.threshold.condition;
            request = Request::rerun;
        }
        ImGui::PopID();
        ImGui::SameLine();
    }
    warning(flagText(r));
}

std::string catchText(const CatchResult& r, records::Task task) {
    if (r.answered == 0) return "No trials to check attention.";
    const char* what = task == records::Task::twoAfc ? "obvious steps missed" : "false alarms";
    return formatted("Attention: %d of %d %s (%.0f %%)", r.failed, r.answered, what,
                     100.0 * r.failed / r.answered);
}

void drawResults(AppState& state, const Page& page, std::optional<Request>& request) {
    const Session& session = state.runner->session();
    const CatchResult& caught = state.results.attention;
    if (!state.results.problem.empty()) return warning(state.results.problem);
    paragraph(catchText(caught, session.design().task));
    if (!caught.problem.empty()) {
        warning("By the screening rule the fit will leave this observer out: " + caught.problem +
                ".");
    }
    ImGui::PushFont(page.window.fonts().small);
    const ImGuiTableFlags flags =
        ImGuiTableFlags_BordersInnerH | ImGuiTableFlags_ScrollY | ImGuiTableFlags_SizingFixedFit;
    if (ImGui::BeginTable("results", 6, flags, {0, -page.px(64)})) {
        for (const char* name : {"condition", "trials", "c = r/a", "95 %", "radius"}) {
            ImGui::TableSetupColumn(name);
        }
        ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch);
        ImGui::TableSetupScrollFreeze(0, 1);
        ImGui::TableHeadersRow();
        int row = 0;
        for (const RunResult& run : state.results.conditions) {
            drawResult(state, page, run, row++, request);
        }
        ImGui::EndTable();
    }
    ImGui::PopFont();
    faint(page, contextLine(session));
    faint(page, state.runner->table().string());
}

}  // namespace

std::optional<Request> drawEnd(AppState& state, const Page& page) {
    std::optional<Request> request;
    beginPage(page, state.resultsShown ? "Results" : "Thank you", state.resultsShown ? 980 : 760);
    if (state.resultsShown) {
        drawResults(state, page, request);
    } else {
        paragraph(
            "That was the last trial. Every one of your answers helps to find out how much blur it "
            "takes to hide an edge made of steps.");
        if (state.message.empty()) paragraph("They are saved.");
        paragraph("Please tell the experimenter that you are done.");
        if (!state.message.empty()) warning(state.message);
    }
    const bool canUndo = state.runner->canUndo() && !state.resultsShown;
    const auto pressed =
        endPage(page, {.primary = "Close",
                       .secondary = canUndo ? "Take back the last answer" : nullptr,
                       .note = state.resultsShown ? "" : "Experimenter: F2 shows the results."});
    if (pressed == Pressed::primary) return Request::next;
    if (pressed == Pressed::secondary) return Request::undo;
    return request;
}

}  // namespace study_app

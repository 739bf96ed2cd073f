// SPDX-License-Identifier: MIT
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "quest/quest.h"
#include "study_app/page_parts.h"
#include "study_app/screens.h"

namespace study_app {
namespace {

template <typename... Values>
std::string formatted(const char* format, Values... values) {
    char text[200];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

/// A staircase's trials, c = r/a on a logarithmic axis, with the estimate as a line.
void drawTrace(const quest::Quest& staircase, ImVec2 size) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled(at, {at.x + size.x, at.y + size.y}, IM_COL32(40, 41, 44, 255), 3);
    const auto history = staircase.history();
    const double mean = staircase.mean();
    double spread = 0.3;
    for (const quest::QuestTrial& t : history) spread = std::max(spread, std::abs(t.x - mean));
    const auto yOf = [&](double x) {  // small x: large radius, on top
        return at.y + size.y * static_cast<float>(0.5 + 0.45 * (x - mean) / spread);
    };
    draw.AddLine({at.x, yOf(mean)}, {at.x + size.x, yOf(mean)}, IM_COL32(110, 130, 160, 255));
    const float dx = size.x / static_cast<float>(std::max<std::size_t>(history.size() + 1, 12));
    for (std::size_t i = 0; i < history.size(); ++i) {
        const ImVec2 point{at.x + dx * static_cast<float>(i + 1), yOf(history[i].x)};
        if (i > 0) {
            draw.AddLine({point.x - dx, yOf(history[i - 1].x)}, point, IM_COL32(95, 95, 100, 255));
        }
        draw.AddCircleFilled(
            point, 3,
            history[i].response == 1 ? IM_COL32(135, 200, 140, 255) : IM_COL32(235, 150, 120, 255));
    }
    ImGui::Dummy(size);
}

/// The posterior over x0, small radii on the right, in the range that holds it.
void drawPosterior(const quest::Quest& staircase, ImVec2 size) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled(at, {at.x + size.x, at.y + size.y}, IM_COL32(40, 41, 44, 255), 3);
    const auto pdf = staircase.pdf();
    const double top = *std::ranges::max_element(pdf);
    const double low = staircase.parameters().priorMean - 0.8;
    ImVec2 last{};
    for (std::size_t i = 0; i < pdf.size(); ++i) {
        const double share = (staircase.candidate(i) - low) / 1.6;
        if (share < 0 || share > 1) continue;
        const ImVec2 point{at.x + size.x * static_cast<float>(share),
                           at.y + size.y * static_cast<float>(0.95 - 0.88 * pdf[i] / top)};
        if (last.x != 0) draw.AddLine(last, point, IM_COL32(120, 175, 235, 255), 1.5f);
        last = point;
    }
    ImGui::Dummy(size);
}

void drawStaircases(const Page& page, const Session& session) {
    if (!ImGui::BeginTable("staircases", 3, ImGuiTableFlags_ScrollY)) return;
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, page.px(160));
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, page.px(96));
    for (std::size_t k = 0; k < session.conditions().size(); ++k) {
        const quest::Quest& staircase = session.staircase(k);
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(session.conditions()[k].name.c_str());
        ImGui::TextDisabled(
            "%s", formatted("c %.2f  (%.2f – %.2f)", quest::radiusAt(1.0, staircase.mean()),
                            quest::radiusAt(1.0, staircase.quantile(0.975)),
                            quest::radiusAt(1.0, staircase.quantile(0.025)))
                      .c_str());
        ImGui::TableNextColumn();
        drawTrace(staircase, {ImGui::GetContentRegionAvail().x, page.px(52)});
        ImGui::TableNextColumn();
        drawPosterior(staircase, {ImGui::GetContentRegionAvail().x, page.px(52)});
    }
    ImGui::EndTable();
}

void drawTrials(const SessionRunner& runner) {
    const ImGuiTableFlags flags =
        ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit;
    if (!ImGui::BeginTable("trials", 6, flags)) return;
    for (const char* name : {"trial", "condition", "radius", "answer", "time", "status"}) {
        ImGui::TableSetupColumn(name);
    }
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableHeadersRow();
    const auto& rows = runner.rows();
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(rows.size()));
    while (clipper.Step()) {
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
            const records::Trial& row = rows[rows.size() - 1 - static_cast<std::size_t>(i)];
            const auto cell = [](const std::string& text) {
                ImGui::TableNextColumn();
                ImGui::TextUnformatted(text.c_str());
            };
            ImGui::TableNextRow();
            cell(std::to_string(row.number));
            cell(row.condition + (row.staircase ? "" : " (check)"));
            cell(formatted("%.2f", row.filterRadiusPx));
            cell(row.response
                     ? std::string(records::toText(*row.response)) + (row.correct ? " +" : " –")
                     : "–");
            cell(row.responseTimeS ? formatted("%.2f s", *row.responseTimeS) : "–");
            cell(std::string(records::toText(row.status)));
        }
    }
    ImGui::EndTable();
}

void drawSessionState(const Page& page, const SessionRunner& runner) {
    const Session& session = runner.session();
    paragraph(formatted("%zu of %zu trials answered, %zu rows on disk; ", session.answered(),
                        session.total(), session.rows()) +
              minutesText(runner.secondsLeft()) + " left");
    paragraph(formatted("Attention: %d of %d checks failed", session.catchFailed(),
                        session.catchAnswered()));
    std::error_code unknown;
    const auto space = std::filesystem::space(runner.recorded().table().parent_path(), unknown);
    if (!unknown) {
        paragraph(formatted("Disk: every row synced; %.1f GB free",
                            static_cast<double>(space.available) / 1e9));
    }
    faint(page, runner.recorded().table().string());
    faint(page, "seed " + std::to_string(session.seed()) + ", design " + session.design().name);
    for (const std::string& notice : runner.recorded().notices()) warning(notice);
    if (!runner.latencies().empty()) {
        std::vector<double> sorted = runner.latencies();
        std::ranges::sort(sorted);
        faint(page, formatted("answer to next stimulus, less the intended pause: median %.1f ms, "
                              "largest %.1f ms",
                              1e3 * sorted[sorted.size() / 2], 1e3 * sorted.back()));
    }
}

}  // namespace

void drawPanel(AppState& state, const Page& page) {
    const auto w = static_cast<float>(page.window.widthPx());
    const auto h = static_cast<float>(page.window.heightPx());
    const float width = std::min(page.px(560), w * 0.9f);
    ImGui::SetNextWindowPos({w - width, 0}, ImGuiCond_Appearing);
    ImGui::SetNextWindowSize({width, h}, ImGuiCond_Appearing);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {page.px(14), page.px(12)});
    ImGui::PushFont(page.window.fonts().small);
    if (ImGui::Begin("For the experimenter (F2 hides it)", nullptr,
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoCollapse |
                         ImGuiWindowFlags_NoNav)) {
        if (ImGui::BeginTabBar("tabs")) {
            if (ImGui::BeginTabItem("Staircases")) {
                drawStaircases(page, state.runner->session());
                ImGui::EndTabItem();
            }
            if (ImGui::BeginTabItem("Trials")) {
                drawTrials(*state.runner);
                ImGui::EndTabItem();
            }
            if (ImGui::BeginTabItem("State")) {
                drawSessionState(page, *state.runner);
                ImGui::EndTabItem();
            }
            ImGui::EndTabBar();
        }
    }
    ImGui::End();
    ImGui::PopFont();
    ImGui::PopStyleVar();
}

}  // namespace study_app

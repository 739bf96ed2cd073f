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

constexpr ImU32 kPlotColor = IM_COL32(40, 41, 44, 255), kMeanColor = IM_COL32(110, 130, 160, 255),
                kTraceColor = IM_COL32(95, 95, 100, 255),
                kRightColor = IM_COL32(135, 200, 140, 255),
                kWrongColor = IM_COL32(235, 150, 120, 255),
                kPdfColor = IM_COL32(120, 175, 235, 255);
/// Of x0 to either side of the prior's mean, log10 units, in the plot of a posterior.
constexpr double kPosteriorRange = 0.8;

template <typename... Values>
std::string formatted(const char* format, Values... values) {
    char text[200];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

/// c = r/a for a strength x0 = log10(a / r).
double slopeAt(double x0) {
    return quest::radiusAt(1.0, x0);
}

/// A staircase's trials, c = r/a on a logarithmic axis with large radii on top, the estimate as a
/// line, the ends of the axis in numbers.
void drawTrace(const Page& page, const quest::Quest& staircase, ImVec2 size) {
    ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::Dummy(size);
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled(at, {at.x + size.x, at.y + size.y}, kPlotColor, 3);
    const ImVec2 corner{at.x + page.px(4), at.y};
    at.x += page.px(34);
    size.x -= page.px(34);
    const auto history = staircase.history();
    const double mean = staircase.mean();
    double spread = 0.3;
    for (const quest::QuestTrial& t : history) spread = std::max(spread, std::abs(t.x - mean));
    const auto yOf = [&](double x) {
        return at.y + size.y * static_cast<float>(0.5 + 0.45 * (x - mean) / spread);
    };
    draw.AddLine({at.x, yOf(mean)}, {at.x + size.x, yOf(mean)}, kMeanColor);
    const float dx = size.x / static_cast<float>(std::max<std::size_t>(history.size() + 1, 12));
    const float dot = std::clamp(size.y / 16, 2.0f, 4.0f);
    for (std::size_t i = 0; i < history.size(); ++i) {
        const ImVec2 point{at.x + dx * static_cast<float>(i + 1), yOf(history[i].x)};
        if (i > 0) draw.AddLine({point.x - dx, yOf(history[i - 1].x)}, point, kTraceColor);
        draw.AddCircleFilled(point, dot, history[i].response == 1 ? kRightColor : kWrongColor);
    }
    const std::string top = formatted("%.1f", slopeAt(mean - spread)),
                      bottom = formatted("%.1f", slopeAt(mean + spread));
    const ImU32 faded = ImGui::GetColorU32(ImGuiCol_TextDisabled);
    draw.AddText(corner, faded, top.c_str());
    draw.AddText({corner.x, corner.y + size.y - ImGui::GetTextLineHeight()}, faded, bottom.c_str());
}

/// The posterior over x0 around the prior's mean, c growing to the right.
void drawPosterior(const quest::Quest& staircase, ImVec2 size) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled(at, {at.x + size.x, at.y + size.y}, kPlotColor, 3);
    const auto pdf = staircase.pdf();
    const double top = *std::ranges::max_element(pdf);
    const double low = staircase.parameters().priorMean - kPosteriorRange;
    std::vector<ImVec2> curve;
    for (std::size_t i = 0; i < pdf.size(); ++i) {
        const double share = (staircase.candidate(i) - low) / (2 * kPosteriorRange);
        if (share < 0 || share > 1) continue;
        curve.push_back({at.x + size.x * static_cast<float>(1 - share),
                         at.y + size.y * static_cast<float>(0.95 - 0.88 * pdf[i] / top)});
    }
    draw.AddPolyline(curve.data(), static_cast<int>(curve.size()), kPdfColor, 0, 1.5f);
    ImGui::Dummy(size);
}

void drawStaircases(const Page& page, const Session& session) {
    const std::size_t count = session.conditions().size();
    const double low = session.staircase(0).parameters().priorMean;
    if (!ImGui::BeginTable("staircases", 4, ImGuiTableFlags_ScrollY)) return;
    ImGui::TableSetupColumn("condition", ImGuiTableColumnFlags_WidthFixed, page.px(170));
    ImGui::TableSetupColumn("c = r/a, 95 %", ImGuiTableColumnFlags_WidthFixed, page.px(120));
    ImGui::TableSetupColumn("trials, c upwards", ImGuiTableColumnFlags_WidthStretch);
    const std::string range = formatted("posterior, c %.1f … %.1f", slopeAt(low + kPosteriorRange),
                                        slopeAt(low - kPosteriorRange));
    ImGui::TableSetupColumn(range.c_str(), ImGuiTableColumnFlags_WidthFixed, page.px(150));
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableHeadersRow();
    const float room = ImGui::GetContentRegionAvail().y / static_cast<float>(count) - page.px(9);
    const float height = std::clamp(room, page.px(38), page.px(120));
    for (std::size_t k = 0; k < count; ++k) {
        const quest::Quest& staircase = session.staircase(k);
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(session.conditions()[k].name.c_str());
        ImGui::TextDisabled("%zu trials", staircase.history().size());
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(formatted("%.2f", slopeAt(staircase.mean())).c_str());
        ImGui::TextDisabled("%s", formatted("%.2f – %.2f", slopeAt(staircase.quantile(0.975)),
                                            slopeAt(staircase.quantile(0.025)))
                                      .c_str());
        ImGui::TableNextColumn();
        drawTrace(page, staircase, {ImGui::GetContentRegionAvail().x, height});
        ImGui::TableNextColumn();
        drawPosterior(staircase, {ImGui::GetContentRegionAvail().x, height});
    }
    ImGui::EndTable();
}

/// The rows on disk, the last one first.
void drawTrials(const SessionRunner& runner) {
    const ImGuiTableFlags flags =
        ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit;
    if (!ImGui::BeginTable("trials", 6, flags)) return;
    for (const char* name : {"trial", "condition", "radius", "answer", "time", "status"}) {
        ImGui::TableSetupColumn(name);
    }
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableHeadersRow();
    const auto cell = [](const std::string& text) {
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(text.c_str());
    };
    const auto& rows = runner.rows();
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(rows.size()));
    while (clipper.Step()) {
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
            const records::Trial& row = rows[rows.size() - 1 - static_cast<std::size_t>(i)];
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

std::string diskText(const std::filesystem::path& folder) {
    std::error_code unknown;
    const auto space = std::filesystem::space(folder, unknown);
    if (unknown) return "disk: " + unknown.message();
    return formatted("every row synced, %.1f GB free", static_cast<double>(space.available) / 1e9);
}

void drawState(const Page& page, const SessionRunner& runner) {
    const Session& session = runner.session();
    const SessionRequest& request = runner.request();
    ImGui::TextUnformatted(
        ("sub-" + request.participant + (request.session ? " ses-" + *request.session : "") +
         "  ·  " + session.design().name + "  ·  " +
         formatted("%zu of %zu trials, ", session.answered(), session.total()) +
         minutesText(runner.secondsLeft()) + " left" +
         (runner.stage() == SessionRunner::Stage::practice ? "  ·  in practice" : ""))
            .c_str());
    const std::filesystem::path& table = runner.table();
    faint(page, formatted("%zu rows on disk, ", session.rows()) + diskText(table.parent_path()) +
                    "  ·  " +
                    formatted("%d of %d attention checks failed", session.catchFailed(),
                              session.catchAnswered()) +
                    "  ·  seed " + std::to_string(session.seed()));
    faint(page, table.string());
    if (const auto latency = runner.latency()) faint(page, toText(*latency));
    if (runner.recorded() != nullptr) {
        for (const std::string& notice : runner.recorded()->notices()) warning(notice);
    }
    if (!runner.problem().empty()) warning(runner.problem());
}

}  // namespace

void drawPanel(const AppState& state, const Page& page) {
    const auto w = static_cast<float>(page.window.widthPx());
    const auto h = static_cast<float>(page.window.heightPx());
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize({w, h});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {page.px(16), page.px(12)});
    ImGui::Begin("panel", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoBackground |
                     ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoNav);
    if (state.runner) {
        drawState(page, *state.runner);
        ImGui::Dummy({0, page.px(4)});
        ImGui::PushFont(page.window.fonts().small);
        // Side by side where there is room, else the trials below.
        const ImVec2 room = ImGui::GetContentRegionAvail();
        const bool beside = room.x > page.px(980);
        ImGui::BeginChild("staircases",
                          beside ? ImVec2{room.x - page.px(486), 0} : ImVec2{0, 0.6f * room.y});
        drawStaircases(page, state.runner->session());
        ImGui::EndChild();
        if (beside) ImGui::SameLine(0, page.px(16));
        ImGui::BeginChild("trials", {0, 0});
        drawTrials(*state.runner);
        ImGui::EndChild();
        ImGui::PopFont();
    } else {
        ImGui::TextUnformatted(
            "For the experimenter: move this window to where the observer "
            "does not see it.");
        faint(page, "Staircases, trials and the state of the disk appear with the first trial.");
    }
    ImGui::End();
    ImGui::PopStyleVar();
}

}  // namespace study_app

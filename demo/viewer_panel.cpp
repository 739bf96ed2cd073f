// SPDX-License-Identifier: MIT
#include "demo/viewer_panel.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <sstream>

#include "demo/map_names.h"
#include "renderer/scene_file.h"

namespace demo {
namespace {

constexpr float kPanelWidthEm = 26;  // in text heights
constexpr double kMillion = 1e6;
constexpr int kMostSliderLamps = 8;  // the state takes more
// Of the budget's slider, million texels; the state takes any.
constexpr float kLeastBudget = 0.01F, kMostBudget = 100;

std::string number(const char* format, double value) {
    char text[64];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

/// A row of a table by its name.
template <class Rows>
void chooseName(const char* label, const Rows& rows, std::string& chosen, const auto& titleOf) {
    if (!ImGui::BeginCombo(label, chosen.c_str())) return;
    for (const auto& row : rows) {
        const std::string name(row.name);
        if (ImGui::Selectable(name.c_str(), name == chosen)) chosen = name;
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", std::string(titleOf(row)).c_str());
    }
    ImGui::EndCombo();
}

void drawTechnique(ViewerState& state) {
    const std::string scene = state.scene;
    chooseName("Scene", renderer::builtInScenes(), state.scene,
               [](const auto& row) { return row.description; });
    if (state.scene != scene) {
        state.cameraYawDeg = state.cameraPitchDeg = state.cameraDistanceM = {};
        state.sunAzimuthDeg = state.sunElevationDeg = {};
    }
    const auto option = [&](const char* label, const char* name, int least, int most) {
        int value = sceneOption(state.scene, name, least);
        if (ImGui::SliderInt(label, &value, least, most, "%d", ImGuiSliderFlags_AlwaysClamp))
            state.scene = withSceneOption(state.scene, name, value, least);
    };
    option("maps of the sun", "cascades", 1, renderer::kMostCascades);
    option("more lamps", "lamps", 0, kMostSliderLamps);
    chooseName("Technique", renderer::techniques(), state.technique,
               [](const auto& row) { return row.title; });
    const renderer::Technique& technique = renderer::findTechnique(state.technique);
    renderer::ParameterValues values = parametersOf(state);
    bool changed = false;
    for (std::size_t i = 0; i < technique.parameters.size(); ++i) {
        const renderer::TechniqueParameter& parameter = technique.parameters[i];
        const std::string label(parameter.name);
        if (parameter.whole) {
            int value = static_cast<int>(std::lround(values[i]));
            changed |= ImGui::SliderInt(label.c_str(), &value, static_cast<int>(parameter.low),
                                        static_cast<int>(parameter.high),
                                        parameter.zeroIsAuto && value == 0 ? "auto" : "%d",
                                        ImGuiSliderFlags_AlwaysClamp);
            values[i] = static_cast<float>(value);
        } else {
            changed |= ImGui::SliderFloat(label.c_str(), &values[i], parameter.low, parameter.high,
                                          "%.4g", ImGuiSliderFlags_AlwaysClamp);
        }
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", std::string(parameter.meaning).c_str());
    }
    if (changed) state.parameters[state.technique] = values;
}

void chooseSize(const char* label, int& size) {
    if (!ImGui::BeginCombo(label, std::to_string(size).c_str())) return;
    for (int n = 64; n <= 8192; n *= 2)
        if (ImGui::Selectable(std::to_string(n).c_str(), n == size)) size = n;
    ImGui::EndCombo();
}

std::int64_t texelsOf(const std::vector<ChosenResolution>& maps) {
    std::int64_t sum = 0;
    for (const ChosenResolution& map : maps) sum += std::int64_t{map.resolution} * map.resolution;
    return sum;
}

void drawBudget(const ShadowRun& run, ViewerState& state) {
    bool limited = state.budgetTexels.has_value();
    // What the maps take now, so that nothing changes before the slider does.
    if (ImGui::Checkbox("budget for all maps", &limited))
        state.budgetTexels = limited ? std::optional(texelsOf(run.maps())) : std::nullopt;
    if (!state.budgetTexels) return;
    auto millions = static_cast<float>(static_cast<double>(*state.budgetTexels) / kMillion);
    if (ImGui::SliderFloat("million texels", &millions, kLeastBudget, kMostBudget, "%.2f",
                           ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp))
        state.budgetTexels = std::llround(static_cast<double>(millions) * kMillion);
    if (!run.budget()) return;
    ImGui::TextDisabled("used %.2f, wanted %.2f%s",
                        static_cast<double>(run.budget()->used) / kMillion,
                        static_cast<double>(run.budget()->wanted) / kMillion,
                        run.budget()->feasible ? "" : "; the smallest sizes take more");
}

/// A row for each map.
void drawMaps(const Viewer& viewer) {
    const std::vector<ChosenResolution>& maps = viewer.run().maps();
    const std::vector<std::string> names = mapNames(viewer.frame().lightViews());
    if (maps.size() < 2 || names.size() != maps.size()) return;
    constexpr ImGuiTableFlags kFlags =
        ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_PadOuterX;
    if (!ImGui::BeginTable("maps", 4, kFlags)) return;
    ImGui::TableSetupColumn("map");
    ImGui::TableSetupColumn("N");
    ImGui::TableSetupColumn("ratio");
    ImGui::TableSetupColumn("why", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableHeadersRow();
    for (std::size_t map = 0; map < maps.size(); ++map) {
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(names[map].c_str());
        ImGui::TableNextColumn();
        ImGui::Text("%d", maps[map].resolution);
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(
            maps[map].artifactRatio > 0 ? number("%.2f", maps[map].artifactRatio).c_str() : "-");
        ImGui::TableNextColumn();
        ImGui::TextWrapped("%s", maps[map].reason.c_str());
    }
    ImGui::EndTable();
}

/// Of a frame's only map.
void drawChoice(const ChosenResolution& chosen) {
    ImGui::TextWrapped("N = %d: %s", chosen.resolution, chosen.reason.c_str());
    if (!chosen.automatic) return;
    ImGui::TextDisabled("asked for %d; artifact ratio %.2f", chosen.need, chosen.artifactRatio);
    if (chosen.shareAbove > 0) ImGui::TextDisabled("%.1f %% ask for more", 100 * chosen.shareAbove);
    if (chosen.detailTexels > 0)
        ImGui::TextDisabled("thin casters ask for %d", chosen.detailTexels);
}

void drawSize(const Viewer& viewer, const ChosenResolution& chosen, ViewerState& state) {
    bool automatic = !state.resolution;
    if (ImGui::Checkbox("automatic size", &automatic))
        state.resolution = automatic ? ResolutionOption() : ResolutionOption(chosen.resolution);
    if (state.resolution) chooseSize("Size", *state.resolution);
    if (viewer.run().maps().size() == 1) drawChoice(chosen);
    if (chosen.automatic) {
        auto met = static_cast<float>(100 * state.percentile);
        if (ImGui::SliderFloat("% of edges met", &met, 50, 100, "%.1f",
                               ImGuiSliderFlags_AlwaysClamp))
            state.percentile = static_cast<double>(met) / 100;
        ImGui::SliderInt("fade (frames)", &state.crossFadeFrames, 0, 120, "%d",
                         ImGuiSliderFlags_AlwaysClamp);
        drawBudget(viewer.run(), state);
    }
    drawMaps(viewer);

    auto softness = static_cast<float>(viewer.softness().radiusM);
    const auto extent = static_cast<float>(viewer.softness().radiusM / viewer.softness().radiusUv);
    if (ImGui::SliderFloat("Blur radius (m)", &softness, 0.002F,
                           std::isfinite(extent) ? 0.1F * extent : 1, "%.3f",
                           ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp)) {
        state.radiusM = static_cast<double>(softness);
        state.radiusUv.reset();
    }
    if ((state.radiusM || state.radiusUv) && ImGui::SmallButton("the scene's own blur")) {
        state.radiusM.reset();
        state.radiusUv.reset();
    }
}

void drawAudience(const Viewer& viewer, PanelTexts& texts, PanelRequest& request,
                  ViewerState& state) {
    auto percent =
        static_cast<float>(100 * (state.audience.detection > 0 ? state.audience.detection
                                                               : viewer.slope().slope.criterion));
    if (ImGui::SliderFloat("seen in at most % of looks", &percent, 1, 90, "%.0f",
                           ImGuiSliderFlags_AlwaysClamp))
        state.audience.detection = static_cast<double>(percent) / 100;
    auto people = static_cast<float>(100 * state.audience.people);
    if (ImGui::SliderFloat("for % of people", &people, 50, 99, "%.0f",
                           ImGuiSliderFlags_AlwaysClamp))
        state.audience.people = static_cast<double>(people) / 100;
    if (state.audience != resolution_controller::kAsMeasured &&
        ImGui::SmallButton("as the study measured"))
        state.audience = resolution_controller::kAsMeasured;
    ImGui::TextWrapped("%s", viewer.slope().text.c_str());
    for (const std::string& note : viewer.slope().notes)
        ImGui::TextWrapped("Note: %s.", note.c_str());
    request.useTypedSlope =
        ImGui::InputTextWithHint("##slope", "slope.json of a study", texts.slopeFile.data(),
                                 texts.slopeFile.size(), ImGuiInputTextFlags_EnterReturnsTrue);
    ImGui::SameLine();
    request.useTypedSlope |= ImGui::Button("Load");
    if (!viewer.slope().file.empty() && ImGui::SmallButton("the published slope"))
        request.usePublishedSlope = true;
}

void drawView(const Viewer& viewer, ViewerState& state) {
    if (ImGui::BeginCombo("View", std::string(toText(state.view)).c_str())) {
        for (const renderer::View view : renderer::kAllViews)
            if (ImGui::Selectable(std::string(toText(view)).c_str(), view == state.view))
                state.view = view;
        ImGui::EndCombo();
    }
    using renderer::View;
    if (compares(state.view)) chooseSize("against", state.compareWith);
    if (state.view == View::split)
        ImGui::SliderFloat("line", &state.splitAt, 0, 1, "%.2f", ImGuiSliderFlags_AlwaysClamp);
    if (state.view == View::difference) {
        ImGui::SliderFloat("gain", &state.gain, 1, 64, "%.0f",
                           ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
        ImGui::TextWrapped(
            "orange: lighter than with %d, blue: darker; in full at a difference of "
            "%.3f in visibility",
            state.compareWith, static_cast<double>(1 / state.gain));
    }
    if (state.view == View::demand)
        ImGui::TextWrapped(
            "violet: %.0f texels or fewer asked for, green: %.0f, yellow: %.0f or "
            "more",
            static_cast<double>(renderer::ViewPass::kLeastDemand),
            std::sqrt(static_cast<double>(renderer::ViewPass::kLeastDemand *
                                          renderer::ViewPass::kMostDemand)),
            static_cast<double>(renderer::ViewPass::kMostDemand));
    if (state.view == View::penumbra)
        ImGui::TextWrapped("visibility in penumbra: violet 0, green .5, yellow 1");
    if (state.view == View::texels)
        ImGui::TextWrapped(
            "yellow: borders of the map's texels, where one is wider than two pixels");
    const std::vector<std::string> maps = mapNames(viewer.frame().lightViews());
    if (maps.size() == 1 || state.view == View::picture || state.view == View::split) return;
    const std::size_t shown = std::min(static_cast<std::size_t>(state.viewMap), maps.size()) - 1;
    if (!ImGui::BeginCombo("of map", maps[shown].c_str())) return;
    for (std::size_t map = 0; map < maps.size(); ++map)
        if (ImGui::Selectable(maps[map].c_str(), map == shown))
            state.viewMap = static_cast<int>(map) + 1;
    ImGui::EndCombo();
}

void drawLight(const Viewer& viewer, ViewerState& state) {
    float azimuth = viewer.frame().scene().sun.azimuthDeg;
    float elevation = viewer.frame().scene().sun.elevationDeg;
    if (ImGui::SliderFloat("sun around", &azimuth, -180, 180, "%.0f deg"))
        state.sunAzimuthDeg = azimuth;
    if (ImGui::SliderFloat("sun height", &elevation, 5, 88, "%.0f deg",
                           ImGuiSliderFlags_AlwaysClamp))
        state.sunElevationDeg = elevation;
    int path = static_cast<int>(state.path);
    ImGui::Combo("play", &path, "still\0camera round\0sun round\0");
    state.path = static_cast<Path>(path);
}

/// A frame of the history as a column of its passes, the longest as high as the plot.
void drawPasses(const FrameHistory& history, float width) {
    double longest = 0;
    for (const FrameHistory::Entry& entry : history.entries)
        longest =
            std::max(longest, std::accumulate(entry.passesMs.begin(), entry.passesMs.end(), 0.0));
    if (longest == 0) return;
    constexpr std::array<ImU32, renderer::kPasses> kColours = {
        IM_COL32(230, 159, 0, 255), IM_COL32(86, 180, 233, 255),  IM_COL32(0, 158, 115, 255),
        IM_COL32(213, 94, 0, 255),  IM_COL32(204, 121, 167, 255), IM_COL32(240, 228, 66, 255)};
    const float height = 4 * ImGui::GetTextLineHeight();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const float step = width / static_cast<float>(FrameHistory::kFrames);
    for (std::size_t i = 0; i < history.entries.size(); ++i) {
        const float x = corner.x + step * static_cast<float>(i);
        float y = corner.y + height;
        for (std::size_t pass = 0; pass < renderer::kPasses; ++pass) {
            const auto part =
                static_cast<float>(history.entries[i].passesMs[pass] / longest) * height;
            draw.AddRectFilled({x, y - part}, {x + step, y}, kColours[pass]);
            y -= part;
        }
    }
    ImGui::Dummy({width, height});
    const renderer::PassTimesMs& last = history.entries.back().passesMs;
    for (const renderer::Pass pass : renderer::kAllPasses) {
        const auto at = static_cast<std::size_t>(pass);
        ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(kColours[at]), "%-10s %7.2f ms",
                           std::string(toText(pass)).c_str(), last[at]);
    }
}

void drawPlots(const FrameHistory& history, bool several, ViewerState& state) {
    if (history.entries.empty()) return;
    std::vector<float> values(history.entries.size());
    const float width = ImGui::GetContentRegionAvail().x;
    const auto plot = [&](const char* label, const char* format, const auto& valueOf) {
        std::transform(history.entries.begin(), history.entries.end(), values.begin(), valueOf);
        const float most = *std::max_element(values.begin(), values.end());
        ImGui::Text("%s %s", label, number(format, static_cast<double>(values.back())).c_str());
        ImGui::PlotLines((std::string("##") + label).c_str(), values.data(),
                         static_cast<int>(values.size()), 0, nullptr, 0, 1.25F * most,
                         {width, 2.2F * ImGui::GetTextLineHeight()});
    };
    if (several)
        plot("all maps, million texels", "%.2f",
             [](const auto& entry) { return entry.mapTexels / static_cast<float>(kMillion); });
    else
        plot("map size", "%.0f", [](const auto& entry) { return entry.resolution; });
    plot("frame", "%.1f ms", [](const auto& entry) { return entry.frameMs; });
    if (history.entries.back().artifactRatio > 0)
        plot("artifact ratio", "%.2f", [](const auto& entry) { return entry.artifactRatio; });
    ImGui::Checkbox("time every pass", &state.timePasses);
    if (!state.timePasses) return;
    drawPasses(history, width);
}

void drawKeys() {
    if (!ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) return;
    ImGui::TableSetupColumn("key");
    ImGui::TableSetupColumn("what it does", ImGuiTableColumnFlags_WidthStretch);
    std::istringstream help(keyHelp());
    for (std::string line; std::getline(help, line);) {
        const std::size_t gap = line.find("  ");
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(line.substr(0, gap).c_str());
        ImGui::TableNextColumn();
        ImGui::TextWrapped("%s", line.substr(gap + 2).c_str());
    }
    ImGui::EndTable();
}

}  // namespace

float keptInside(float place, float length, float windowLength) {
    return std::clamp(place, 0.0F, std::max(windowLength - length, 0.0F));
}

void drawMessage(const std::string& message) {
    if (message.empty()) return;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float em = ImGui::GetFontSize(), padding = 0.5F * em;
    const float wrap = std::max(display.x - 4 * em, 4 * em);
    const ImVec2 size = ImGui::CalcTextSize(message.c_str(), nullptr, false, wrap);
    // Of one that is higher than the window the beginning is seen.
    const ImVec2 corner(std::max(0.5F * (display.x - size.x), padding),
                        std::max(display.y - size.y - em, padding));
    ImDrawList& draw = *ImGui::GetForegroundDrawList();
    draw.AddRectFilled({corner.x - padding, corner.y - padding},
                       {corner.x + size.x + padding, corner.y + size.y + padding},
                       IM_COL32(15, 15, 15, 225), 4);
    draw.AddText(ImGui::GetFont(), em, corner, IM_COL32_WHITE, message.c_str(), nullptr, wrap);
}

PanelRequest drawPanel(const Viewer& viewer, const FrameHistory& history, PanelTexts& texts,
                       ViewerState& state) {
    PanelRequest request;
    const float em = ImGui::GetTextLineHeight();
    ImGui::SetNextWindowPos({em, em}, ImGuiCond_FirstUseEver);
    ImGui::SetNextWindowSizeConstraints(
        {kPanelWidthEm * em, 0}, {kPanelWidthEm * em, ImGui::GetIO().DisplaySize.y - 2 * em});
    ImGui::Begin("shadow_demo", &state.panel, ImGuiWindowFlags_AlwaysAutoResize);
    ImGui::PushItemWidth(11 * em);
    drawTechnique(state);
    ImGui::Separator();
    drawSize(viewer, viewer.run().chosen(), state);
    ImGui::Separator();
    drawView(viewer, state);
    if (ImGui::CollapsingHeader("For whom")) drawAudience(viewer, texts, request, state);
    if (ImGui::CollapsingHeader("Light and paths")) drawLight(viewer, state);
    if (ImGui::CollapsingHeader("Plots", ImGuiTreeNodeFlags_DefaultOpen))
        drawPlots(history, viewer.run().maps().size() > 1, state);
    if (ImGui::CollapsingHeader("Keys")) drawKeys();
    if (ImGui::Button("Save a picture")) request.screenshot = true;
    ImGui::PopItemWidth();
    const ImVec2 at = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetWindowPos({keptInside(at.x, size.x, display.x), keptInside(at.y, size.y, display.y)});
    ImGui::End();
    return request;
}

}  // namespace demo

// SPDX-License-Identifier: MIT
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <filesystem>

#include "study_app/page_parts.h"
#include "study_app/screens.h"

namespace study_app {
namespace {

void label(const Page& page, const char* text) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(text);
    ImGui::SameLine(page.px(130));
    ImGui::SetNextItemWidth(-1);
}

void textField(const Page& page, const char* name, const char* hint, std::string& value) {
    label(page, name);
    ImGui::InputTextWithHint((std::string("##") + name).c_str(), hint, &value);
}

void designField(const Page& page, SetupState& setup) {
    const std::string begun = setup.existing.design ? setup.existing.design->name : kNewDesign;
    label(page, "Design");
    if (!ImGui::BeginCombo("##Design",
                           (setup.form.design.empty() ? begun : setup.form.design).c_str(),
                           ImGuiComboFlags_HeightLargest)) {
        return;
    }
    if (ImGui::Selectable("as the session began", setup.form.design.empty())) {
        setup.form.design.clear();
    }
    ImGui::PushTextWrapPos(page.px(420));
    faint(page, std::string("For a new session: ") + kNewDesign + ".");
    ImGui::PopTextWrapPos();
    for (const ShippedDesign& design : setup.designs) {
        const bool chosen = design.name == setup.form.design;
        if (ImGui::Selectable(design.name.c_str(), chosen)) setup.form.design = design.name;
        ImGui::PushTextWrapPos(page.px(420));
        faint(page, design.description);
        ImGui::PopTextWrapPos();
    }
    ImGui::SetNextItemWidth(page.px(420));
    ImGui::InputTextWithHint("##file", "or your own: path/to/design.json", &setup.designFile);
    if (ImGui::IsItemDeactivatedAfterEdit()) setup.form.design = setup.designFile;
    ImGui::EndCombo();
}

void taskField(const Page& page, SetupForm& form) {
    struct Choice {
        const char* text;
        std::optional<records::Task> task;
    };
    static const Choice choices[] = {{"as the design says", {}},
                                     {"which of two edges (2afc)", records::Task::twoAfc},
                                     {"is there a step (yes_no)", records::Task::yesNo}};
    const auto current = std::ranges::find_if(
        choices, [&](const Choice& choice) { return choice.task == form.task; });
    label(page, "Task");
    if (!ImGui::BeginCombo("##Task", current->text)) return;
    for (const Choice& choice : choices) {
        if (ImGui::Selectable(choice.text, choice.task == form.task)) form.task = choice.task;
    }
    ImGui::EndCombo();
}

void drawForm(const Page& page, SetupState& setup) {
    SetupForm& form = setup.form;
    textField(page, "Data folder", "a folder for the whole study", form.dataFolder);
    textField(page, "Participant", "letters and digits", form.participant);
    textField(page, "Session", "none, or letters and digits", form.session);
    ImGui::Dummy({0, page.px(8)});
    textField(page, "Age", "optional", form.age);
    textField(page, "Gender", "optional", form.gender);
    textField(page, "Expertise", "optional, with images or graphics", form.expertise);
    ImGui::Dummy({0, page.px(8)});
    const bool fixed = setup.existing.design.has_value();
    ImGui::BeginDisabled(fixed);
    designField(page, setup);
    taskField(page, form);
    const std::string begun = fixed ? std::to_string(setup.existing.seed) : "drawn at the start";
    textField(page, "Seed", begun.c_str(), form.seed);
    ImGui::EndDisabled();
    if (fixed) faint(page, "An existing session keeps the design, task and seed it began with.");
}

void drawState(const Page& page, const SetupState& setup) {
    const ExistingSession& existing = setup.existing;
    using State = ExistingSession::State;
    if (existing.state == State::unfinished) {
        paragraph("Resumes after " + std::to_string(existing.answered) + " of " +
                  std::to_string(existing.total) + " trials.");
    } else if (existing.state == State::finished) {
        paragraph("This session is finished: " + std::to_string(existing.total) +
                  " trials. Its results can be looked at.");
    }
    if (setup.design) {
        ImGui::PushFont(page.window.fonts().text);
        ImGui::TextColored({0.62f, 0.75f, 0.92f, 1}, "%s", setup.design->name.c_str());
        ImGui::PopFont();
        if (!setup.design->description.empty()) faint(page, setup.design->description);
        ImGui::Dummy({0, page.px(4)});
        for (const std::string& line : setup.summary) paragraph(line);
    }
    ImGui::Dummy({0, page.px(8)});
    ImGui::TextColored({0.62f, 0.75f, 0.92f, 1}, "In this data folder");
    if (setup.participants.empty()) faint(page, "nobody yet");
    for (const std::string& line : setup.participants) faint(page, line);
}

}  // namespace

std::optional<Request> drawSetup(AppState& state, const Page& page) {
    beginPage(page, "New or unfinished session", 1080);
    SetupState& setup = state.setup;
    const float left = std::floor(ImGui::GetContentRegionAvail().x * 0.5f);
    ImGui::BeginChild("form", {left - page.px(20), 0}, false, ImGuiWindowFlags_NoBackground);
    drawForm(page, setup);
    ImGui::Dummy({0, page.px(6)});
    if (!setup.problem.empty()) warning(setup.problem);
    if (!setup.tooSmall.empty() && setup.problem != setup.tooSmall) warning(setup.tooSmall);
    for (const std::string& notice : page.window.notices()) faint(page, notice);
    ImGui::EndChild();
    ImGui::SameLine(0, page.px(40));
    ImGui::BeginChild("state", {0, 0}, false, ImGuiWindowFlags_NoBackground);
    drawState(page, setup);
    ImGui::EndChild();

    const bool ready = missing(setup.form).empty();
    const char* start = "Start";
    if (setup.existing.state == ExistingSession::State::unfinished) start = "Resume";
    if (setup.existing.state == ExistingSession::State::finished) start = "Show results";
    if (!setup.problem.empty()) start = "Try again";
    const auto pressed = endPage(
        page,
        {.primary = start, .enabled = ready, .secondary = "Quit", .note = missing(setup.form)});
    if (pressed == Pressed::primary) return Request::next;
    if (pressed == Pressed::secondary) return Request::quit;
    return {};
}

}  // namespace study_app

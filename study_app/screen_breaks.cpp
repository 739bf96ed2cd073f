// SPDX-License-Identifier: MIT
#include <imgui.h>

#include <cmath>

#include "study_app/page_parts.h"
#include "study_app/screens.h"

namespace study_app {
namespace {

std::optional<Request> requestOf(const std::optional<Pressed>& pressed) {
    if (pressed == Pressed::primary) return Request::next;
    if (pressed == Pressed::secondary) return Request::undo;
    if (pressed == Pressed::tertiary) return Request::quit;
    return {};
}

/// The buttons keep their places: a second click on one that has done its work must not meet
/// another one.
Footer footer(const char* primary, bool enabled, const SessionRunner& runner) {
    return {.primary = primary,
            .enabled = enabled,
            .secondary = "Take back the last answer (Backspace)",
            .secondaryEnabled = runner.canUndo(),
            .tertiary = "Stop for today (Q)"};
}

void drawMessage(const AppState& state) {
    if (state.message.empty()) return;
    if (state.messageIsTrouble) {
        warning(state.message);
    } else {
        paragraph(state.message);
    }
}

}  // namespace

std::optional<Request> drawPracticeOver(AppState& state, const Page& page) {
    beginPage(page, state.practiceOver ? "Well done" : "Let us look at this together", 760);
    if (state.practiceOver) {
        paragraph(
            "You have got the idea. From now on the steps become harder to see. That is as it "
            "should be: the computer keeps looking for the point at which you are just unsure.");
        if (!state.runner->presentation().feedback) {
            paragraph("You will not be told any more whether you were right.");
        }
        paragraph("The session takes " + minutesText(state.runner->secondsLeft()) + ".");
    } else {
        warning("Please call the experimenter.");
        ImGui::Spacing();
        paragraph(
            "The practice has not gone as expected. Perhaps the task was not clear, or the "
            "edges cannot be seen well from here.");
    }
    const auto pressed =
        endPage(page, {.primary = state.practiceOver ? "Start" : "Practise again",
                       .secondary = state.practiceOver ? "Practise once more" : "Go on regardless",
                       .tertiary = "Stop for today"});
    if (pressed == Pressed::primary) {
        return state.practiceOver ? Request::next : Request::practiceAgain;
    }
    if (pressed == Pressed::secondary) {
        return state.practiceOver ? Request::practiceAgain : Request::skipPractice;
    }
    if (pressed == Pressed::tertiary) return Request::quit;
    return {};
}

std::optional<Request> drawRest(AppState& state, const Page& page) {
    beginPage(page, "Time for a break", 760);
    drawMessage(state);
    paragraph(
        "Look away from the screen, far into the distance, and rest your eyes. Go on when you "
        "feel fresh; there is no hurry.");
    const double wait = state.restOver - page.now;
    const bool over = wait <= 0;
    if (!over) {
        char text[80];
        std::snprintf(text, sizeof text, "You can go on in %.0f s.", std::ceil(wait));
        faint(page, text);
    }
    const auto pressed = endPage(page, footer("Go on", over, *state.runner));
    drawProgress(page, *state.runner);
    return requestOf(pressed);
}

std::optional<Request> drawPause(AppState& state, const Page& page) {
    beginPage(page, "Paused", 760);
    drawMessage(state);
    paragraph("Take your time. When you go on, a new trial begins.");
    const bool trouble = state.messageIsTrouble && !state.message.empty();
    if (!trouble) {
        faint(page,
              "Everything you answered is saved. If you stop for today, the session can be resumed "
              "at any time with the same settings.");
    }
    const auto pressed =
        endPage(page, footer(trouble ? "Try again" : "Go on", true, *state.runner));
    drawProgress(page, *state.runner);
    return requestOf(pressed);
}

}  // namespace study_app

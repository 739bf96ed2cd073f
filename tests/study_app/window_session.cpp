// SPDX-License-Identifier: MIT
#include "tests/study_app/window_session.h"

#include <fstream>

namespace tests {

std::string WindowSession::write(const std::string& name, const std::string& text) const {
    std::ofstream(file(name)) << text;
    return file(name).string();
}

std::vector<std::string> WindowSession::arguments(const std::string& pace,
                                                  int trialsPerCondition) const {
    const std::string design = write("tiny.json", R"({
        "schema": {"name": "stairwell design", "major": 1, "minor": 0},
        "name": "tiny", "description": "for tests", "window_px": 240, "artifact_px": [8, 12],
        "patterns": ["stair", "step"], "catch_share": 0.2, "radius_px": {"max": 120},
        "trials_per_condition": )" + std::to_string(trialsPerCondition) +
                                                      "}");
    return {"--design", design, "--data",  data(),           "--participant",         "01",
            "--seed",   "7",    "--start", "--presentation", write("pace.json", pace)};
}

void WindowSession::agree(WindowPerson& person) {
    person.waitFor("screen instructions");
    person.press("Return");
}

std::string WindowSession::answer(WindowPerson& person, const std::string& side) {
    person.waitFor("stimulus");
    person.press(side == "left" ? "Left" : "Right");
    return person.waitFor("row");
}

void WindowSession::answerAll(WindowPerson& person) {
    for (;;) {
        const std::string event = person.nextEvent();
        if (event == "screen end") return;
        if (event.starts_with("stimulus")) person.press("Left");
    }
}

}  // namespace tests

// SPDX-License-Identifier: MIT
#include "study_app/window_options.h"

#include <stdexcept>

#include "records/quoted_text.h"

namespace study_app {

std::vector<std::string> addWindowOptions(CLI::App& app, WindowArguments& a) {
    std::vector<CLI::Option*> added{
        app.add_option("--age", a.age, "Age in years, into participants.tsv"),
        app.add_option("--gender", a.gender, "Into participants.tsv"),
        app.add_option("--expertise", a.expertise,
                       "With images or graphics, into participants.tsv"),
        app.add_option("--task", a.task, "2afc or yes_no instead of the design's own task"),
        app.add_flag("--start", a.start,
                     "Begin at the instructions, without set-up and calibration screens"),
        app.add_option("--presentation", a.presentation,
                       "JSON file of pace, breaks, practice instead of the design's own"),
        app.add_option("--instructions", a.instructions,
                       "Text file that the observer reads first (default: the shipped one)"),
        app.add_option("--displays", a.displays,
                       "JSON file of calibrated displays (default: in the user's configuration)"),
        app.add_flag("--fullscreen", a.fullscreen, "At the display's current resolution"),
        app.add_option("--window-size", a.size, "Width and height, px (default: 1280 800)")
            ->expected(2)
            ->check(CLI::Range(320, 16384)),
        app.add_option("--ui-scale", a.uiScale,
                       "Size of text and controls (default: the desktop's)")
            ->check(CLI::Range(0.5, 4.0)),
        app.add_option("--screenshots", a.screenshots, "Folder for a picture of every screen"),
        app.add_flag("--verify-pixels", a.verifyPixels,
                     "Read back every stimulus and compare its codes, not only the first"),
        app.add_option("--robot", a.robot,
                       "A robot observer answers by the pixels it is shown, so many seconds after "
                       "each stimulus (default: 0.2)")
            ->expected(0, 1)
            ->default_str("0.2")
            ->check(CLI::Range(0.0, 60.0)),
        app.add_flag("--panel", a.panel, "Open the experimenter's window too (as F2 does)"),
        app.add_option("--event-log", a.eventLog,
                       "File that gets a line for every screen, stimulus and row"),
        app.add_flag("--timing", a.timing,
                     "Print the time from answer to next stimulus at the end")};
    std::vector<std::string> names;
    for (CLI::Option* option : added) {
        option->group("Window (without --headless)");
        names.push_back(option->get_name());
    }
    return names;
}

void apply(const WindowArguments& a, WindowRun& run) {
    run.form.age = a.age;
    run.form.gender = a.gender;
    run.form.expertise = a.expertise;
    if (!a.task.empty()) {
        run.form.task = records::taskFromText(a.task);
        if (!run.form.task) {
            throw std::runtime_error("--task: " + records::quotedText(a.task) +
                                     ": must be 2afc or yes_no");
        }
    }
    if (!a.presentation.empty()) run.form.presentation = readPresentation(a.presentation);
    run.instructions = a.instructions;
    run.displays = a.displays;
    run.screenshots = a.screenshots;
    run.startAtOnce = a.start;
    run.verifyPixels = a.verifyPixels;
    run.eventLog = a.eventLog;
    run.robotAnswerS = a.robot;
    run.panel = a.panel;
    run.printTiming = a.timing;
    run.window.fullscreen = a.fullscreen;
    run.window.uiScale = a.uiScale;
    if (a.size.size() == 2) {
        run.window.widthPx = a.size[0];
        run.window.heightPx = a.size[1];
    }
}

}  // namespace study_app

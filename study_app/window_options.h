// SPDX-License-Identifier: MIT
// The command line of the study's window: everything that its set-up screen asks for, and how it is
// shown. study_app.cpp's own options (--design, --data, --participant, --session, --seed) fill in
// the same form.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "study_app/run_window.h"

namespace study_app {

struct WindowArguments {
    std::string age, gender, expertise, task, presentation, instructions, displays, screenshots,
        eventLog;
    std::optional<double> uiScale, robot;
    std::vector<int> size;
    bool start = false, fullscreen = false, verifyPixels = false, timing = false, panel = false;
};

/// Adds the options in a group of their own and returns their names, for a mode that refuses them.
std::vector<std::string> addWindowOptions(CLI::App& app, WindowArguments& arguments);

/// Puts the arguments into a run. Throws std::runtime_error: an unreadable presentation file, an
/// unknown task.
void apply(const WindowArguments& arguments, WindowRun& run);

}  // namespace study_app

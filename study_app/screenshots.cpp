// SPDX-License-Identifier: MIT
#include "study_app/screenshots.h"

// OpenCV's own writer of images brings hundreds of libraries along, which cost a start half a
// second.
#include <stb_image_write.h>

#include <stdexcept>

#include "records/whole_file.h"

namespace study_app {
namespace {

const char* phaseName(TrialPhase phase) {
    switch (phase) {
        case TrialPhase::idle:
            break;
        case TrialPhase::blank:
            return "blank";
        case TrialPhase::fixation:
            return "fixation";
        case TrialPhase::stimulus:
            return "stimulus";
        case TrialPhase::place:
            return "place";
        case TrialPhase::feedback:
            return "feedback";
    }
    return "idle";
}

}  // namespace

void Screenshots::take(const std::string& name, const cv::Mat& frame) {
    cv::Mat rgb(frame.size(), CV_8UC3);
    cv::mixChannels(frame, rgb, {0, 2, 1, 1, 2, 0});
    records::createFolders(folder_);
    const std::filesystem::path file = folder_ / (name + ".png");
    if (stbi_write_png(file.c_str(), rgb.cols, rgb.rows, 3, rgb.data, static_cast<int>(rgb.step)) ==
        0) {
        throw std::runtime_error(file.string() + ": cannot be written");
    }
    taken_.insert(name);
}

std::string pictureName(const AppState& state, double now) {
    std::string name = toText(state.flow.screen);
    if (state.answering()) {
        const bool due = state.runner->stimulusDue(now);
        name += std::string("-") + (due ? "stimulus" : phaseName(state.runner->phase()));
    }
    if (state.practiceOver) name += "-over";
    if (state.practiceStuck) name += "-stuck";
    if (state.flow.screen == Screen::end && state.resultsShown) name += "-results";
    return name;
}

}  // namespace study_app

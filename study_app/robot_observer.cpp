// SPDX-License-Identifier: MIT
#include "study_app/robot_observer.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace study_app {
namespace {

constexpr int kNarrowestPanelPx = 48;

/// Begin and end of the runs of true that are at least `least` long.
std::vector<cv::Range> runs(const std::vector<bool>& flags, int least) {
    std::vector<cv::Range> found;
    int begin = 0;
    for (int i = 0; i <= static_cast<int>(flags.size()); ++i) {
        if (i < static_cast<int>(flags.size()) && flags[static_cast<std::size_t>(i)]) continue;
        if (i - begin >= least) found.emplace_back(begin, i);
        begin = i + 1;
    }
    return found;
}

/// Where a column first and only once passes through a level; nothing elsewhere.
std::optional<double> crossing(const cv::Mat& codes, int column, double level) {
    std::optional<double> place;
    for (int row = 1; row < codes.rows; ++row) {
        const double above = codes.at<std::uint8_t>(row - 1, column);
        const double below = codes.at<std::uint8_t>(row, column);
        if ((above < level) == (below < level)) continue;
        if (place) return {};
        place = row - 1 + (level - above) / (below - above);
    }
    return place;
}

/// The longest stretch of columns with one crossing each, averaged over five columns: single codes
/// round the places of flat ramps.
std::vector<double> contour(const cv::Mat& codes, double level) {
    std::vector<double> longest, current;
    for (int column = 0; column <= codes.cols; ++column) {
        const auto place = column < codes.cols ? crossing(codes, column, level) : std::nullopt;
        if (place) {
            current.push_back(*place);
            continue;
        }
        if (current.size() > longest.size()) longest = current;
        current.clear();
    }
    std::vector<double> smooth;
    for (std::size_t i = 2; i + 2 < longest.size(); ++i) {
        smooth.push_back(std::accumulate(longest.begin() + static_cast<std::ptrdiff_t>(i) - 2,
                                         longest.begin() + static_cast<std::ptrdiff_t>(i) + 3,
                                         0.0) /
                         5);
    }
    return smooth;
}

double bendOf(const std::vector<double>& y) {
    double largest = 0;
    constexpr std::size_t b = kBaselinePx;
    for (std::size_t i = b; i + b < y.size(); ++i) {
        largest = std::max(largest, std::abs(y[i - b] - 2 * y[i] + y[i + b]));
    }
    return largest;
}

}  // namespace

std::vector<cv::Mat> findPanels(const cv::Mat& frame) {
    cv::Mat grey;
    cv::extractChannel(frame, grey, 1);
    const cv::Mat different = grey != grey.at<std::uint8_t>(0, 0);
    std::vector<bool> rowIsPanel, columnIsPanel;
    for (int row = 0; row < grey.rows; ++row) {
        rowIsPanel.push_back(cv::countNonZero(different.row(row)) > grey.cols / 8);
    }
    const std::vector<cv::Range> rows = runs(rowIsPanel, kNarrowestPanelPx);
    if (rows.empty()) return {};
    const cv::Mat band = different.rowRange(rows[0]);
    for (int column = 0; column < grey.cols; ++column) {
        columnIsPanel.push_back(cv::countNonZero(band.col(column)) > band.rows / 2);
    }
    std::vector<cv::Mat> panels;
    for (const cv::Range& columns : runs(columnIsPanel, kNarrowestPanelPx)) {
        panels.push_back(grey(rows[0], columns).clone());
    }
    return panels;
}

double contourBend(const cv::Mat& codes) {
    double top = 0;
    cv::minMaxLoc(codes, nullptr, &top);
    const cv::Mat turned = codes.t();
    std::vector<double> bends;
    for (const double share : {0.3, 0.5, 0.7}) {
        const auto across = contour(codes, share * top), along = contour(turned, share * top);
        bends.push_back(bendOf(across.size() >= along.size() ? across : along));
    }
    std::ranges::sort(bends);
    return bends[1];
}

Side robotAnswer(const cv::Mat& frame, std::mt19937_64& rng) {
    const std::vector<cv::Mat> panels = findPanels(frame);
    const Side coin = rng() % 2 == 0 ? Side::left : Side::right;
    if (panels.empty()) return coin;
    if (panels.size() == 1) {
        return contourBend(panels[0]) > kNoticeablePx ? Side::right : Side::left;
    }
    const double difference = contourBend(panels[0]) - contourBend(panels[1]);
    if (std::abs(difference) < kNoticeablePx) return coin;
    return difference > 0 ? Side::left : Side::right;
}

void RobotObserver::look(const cv::Mat& frame, double now) {
    decided_ = robotAnswer(frame, coin_);
    due_ = now + answerS_;
}

std::optional<Side> RobotObserver::press(double now) {
    return now >= due_ ? std::exchange(decided_, {}) : std::nullopt;
}

std::optional<double> RobotObserver::secondsUntilPress(double now) const {
    return decided_ ? std::optional(std::max(0.0, due_ - now)) : std::nullopt;
}

}  // namespace study_app

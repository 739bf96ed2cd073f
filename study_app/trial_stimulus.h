// SPDX-License-Identifier: MIT
// From a row of the trial table to the codes on the screen: everything that a row says about its
// stimulus, drawn as stimulus/ computes it. The same row gives the same bits on any day.
//
// Images are computed ahead by a StimulusPrefetcher while the observer still looks at the trial
// before: both stimuli that may come next.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <list>
#include <mutex>
#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <thread>
#include <vector>

#include "records/trial_table.h"
#include "study_app/session.h"

namespace study_app {

struct TrialImages {
    cv::Mat left;   ///< CV_8UC1, row 0 on top; the only one in yes/no
    cv::Mat right;  ///< empty in yes/no
    bool operator==(const TrialImages& other) const;
};

/// Throws std::invalid_argument for a row that describes no stimulus of ours (a frame, an unknown
/// kernel, a radius beyond the limits of stimulus/). A straight panel whose tilt is absent or 0
/// stands at the true silhouette's angle.
TrialImages trialImages(const records::Trial& trial, int windowPx);

/// The trials that may follow session.next(), one for each answer. Empty before the last trial.
std::vector<records::Trial> possibleNext(const Session& session);

class StimulusPrefetcher {
  public:
    explicit StimulusPrefetcher(int windowPx);
    ~StimulusPrefetcher();
    StimulusPrefetcher(const StimulusPrefetcher&) = delete;
    StimulusPrefetcher& operator=(const StimulusPrefetcher&) = delete;

    /// Computes these, first to last, on the worker thread; forgets finished images of others.
    void request(std::vector<records::Trial> trials);

    /// The images of a trial: waits for the worker where it is at it, computes here where nobody
    /// asked for it before. Throws what trialImages throws.
    TrialImages take(const records::Trial& trial);

  private:
    struct Job {
        records::Trial trial;
        bool begun = false, done = false;
        TrialImages images{};
        std::exception_ptr error{};
    };

    void work(std::stop_token stop);
    Job* find(const records::Trial& trial);

    int windowPx_;
    std::mutex mutex_;
    std::condition_variable_any changed_;
    std::list<Job> jobs_;  // a list: the worker keeps a pointer while it computes
    std::jthread worker_;  // last: it uses everything above
};

}  // namespace study_app

// SPDX-License-Identifier: MIT
// Stimuli computed ahead while the observer still looks at the trial before: whichever may come
// next.
#pragma once

#include <condition_variable>
#include <exception>
#include <list>
#include <mutex>
#include <thread>
#include <vector>

#include "study_app/session.h"
#include "study_app/trial_stimulus.h"

namespace study_app {

/// The trials that may follow session.next(): one for each answer, and the one where it comes
/// again. The likeliest first; before the last trial that one alone.
std::vector<records::Trial> possibleNext(const Session& session);

class StimulusPrefetcher {
  public:
    explicit StimulusPrefetcher(const Design& design);
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

    Design design_;
    std::mutex mutex_;
    std::condition_variable_any changed_;
    std::list<Job> jobs_;  // a list: the worker keeps a pointer while it computes
    std::jthread worker_;  // last: it uses everything above
};

}  // namespace study_app

// SPDX-License-Identifier: MIT
#include "study_app/stimulus_prefetcher.h"

#include <algorithm>

namespace study_app {

using records::Trial;

std::vector<Trial> possibleNext(const Session& session) {
    std::vector<Trial> trials;
    if (session.finished()) return trials;
    const auto after = [&](const Answer& answer) {
        Session answered = session;
        answered.answer(answer);
        if (!answered.finished()) trials.push_back(answered.next());
    };
    const bool sides = session.design().task == records::Task::twoAfc;
    using records::Response;
    after({.response = sides ? Response::left : Response::seen});
    after({.response = sides ? Response::right : Response::notSeen});
    after({.status = records::TrialStatus::repeated});  // also where it was too fast
    return trials;
}

StimulusPrefetcher::StimulusPrefetcher(const Design& design)
    : design_(design), worker_([this](std::stop_token stop) { work(stop); }) {}

StimulusPrefetcher::~StimulusPrefetcher() {
    worker_.request_stop();
    changed_.notify_all();
}

StimulusPrefetcher::Job* StimulusPrefetcher::find(const Trial& trial) {
    const auto found =
        std::ranges::find_if(jobs_, [&](const Job& job) { return job.trial == trial; });
    return found == jobs_.end() ? nullptr : &*found;
}

void StimulusPrefetcher::request(std::vector<Trial> trials) {
    const std::scoped_lock lock(mutex_);
    jobs_.remove_if([&](const Job& job) {
        const bool wanted = std::ranges::find(trials, job.trial) != trials.end();
        if (job.error) return true;  // a picture that was missing may be back
        return !wanted && (job.done || !job.begun);
    });
    for (Trial& trial : trials) {
        if (find(trial) == nullptr) jobs_.push_back({.trial = std::move(trial)});
    }
    changed_.notify_all();
}

TrialImages StimulusPrefetcher::take(const Trial& trial) {
    std::unique_lock lock(mutex_);
    Job* job = find(trial);
    if (job == nullptr || !job->begun) {
        lock.unlock();
        return trialImages(trial, design_);
    }
    changed_.wait(lock, [&] { return job->done; });
    if (job->error) std::rethrow_exception(job->error);
    return job->images;
}

void StimulusPrefetcher::work(std::stop_token stop) {
    std::unique_lock lock(mutex_);
    while (!stop.stop_requested()) {
        const auto waiting = std::ranges::find_if(jobs_, [](const Job& job) { return !job.begun; });
        if (waiting == jobs_.end()) {
            changed_.wait(lock, stop, [&] {
                return std::ranges::any_of(jobs_, [](const Job& job) { return !job.begun; });
            });
            continue;
        }
        waiting->begun = true;
        lock.unlock();
        TrialImages images;
        std::exception_ptr error;
        try {
            images = trialImages(waiting->trial, design_);
        } catch (...) {
            error = std::current_exception();
        }
        lock.lock();
        waiting->images = std::move(images);
        waiting->error = error;
        waiting->done = true;
        changed_.notify_all();
    }
}

}  // namespace study_app

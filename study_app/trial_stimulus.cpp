// SPDX-License-Identifier: MIT
#include "study_app/trial_stimulus.h"

#include <algorithm>
#include <stdexcept>

#include "stimulus/stimulus_image.h"

namespace study_app {
namespace {

using records::Trial;

stimulus::Pattern patternOf(const Trial& trial) {
    switch (trial.pattern) {
        case records::Pattern::stair:
            return stimulus::Pattern::stair;
        case records::Pattern::step:
            return stimulus::Pattern::step;
        case records::Pattern::line:
            return stimulus::Pattern::line;
        case records::Pattern::frame:
            break;
    }
    throw std::invalid_argument("trial " + std::to_string(trial.number) +
                                ": pattern: frame: has no computed stimulus");
}

stimulus::KernelShape kernelOf(const Trial& trial) {
    if (const auto shape = stimulus::kernelShapeFromText(trial.kernel)) return *shape;
    throw std::invalid_argument("trial " + std::to_string(trial.number) +
                                ": kernel: " + trial.kernel + ": must be disc, box or gaussian");
}

stimulus::StimulusOptions stimulusOf(const Trial& trial, int windowPx) {
    stimulus::StimulusOptions o;
    o.silhouette.pattern = patternOf(trial);
    o.silhouette.artifactPx = trial.artifactPx;
    if (trial.pattern == records::Pattern::line)
        o.silhouette.angleDeg = trial.angleDeg.value_or(45);
    o.silhouette.riserSpacingPx = windowPx;
    o.kernel = {.shape = kernelOf(trial), .radiusPx = trial.filterRadiusPx};
    o.windowPx = windowPx;
    o.litLevel = trial.litLevel;
    o.encoding = trial.encoding == records::Encoding::code ? stimulus::Encoding::code
                                                           : stimulus::Encoding::srgb;
    if (trial.tiltDeg.value_or(0) != 0) o.roving.straightTiltDeg = trial.tiltDeg;
    o.roving.shiftPx = trial.shiftPx.value_or(0);
    o.roving.mirror = trial.mirror.value_or(false);
    o.roving.quarterTurns = trial.orientationQuarter.value_or(0);
    return o;
}

bool sameCodes(const cv::Mat& a, const cv::Mat& b) {
    if (a.size() != b.size()) return false;
    return a.empty() || cv::countNonZero(a != b) == 0;
}

}  // namespace

bool TrialImages::operator==(const TrialImages& other) const {
    return sameCodes(left, other.left) && sameCodes(right, other.right);
}

TrialImages trialImages(const Trial& trial, int windowPx) {
    const stimulus::StimulusOptions o = stimulusOf(trial, windowPx);
    if (trial.task == records::Task::yesNo) {
        const bool artifact = trial.type == records::TrialType::artifact;
        return {artifact ? stimulus::artifactImage(o) : stimulus::straightImage(o), {}};
    }
    cv::Mat artifact = stimulus::artifactImage(o), straight = stimulus::straightImage(o);
    if (trial.side == "left") return {std::move(artifact), std::move(straight)};
    return {std::move(straight), std::move(artifact)};
}

std::vector<Trial> possibleNext(const Session& session) {
    std::vector<Trial> trials;
    if (session.finished()) return trials;
    const bool sides = session.design().task == records::Task::twoAfc;
    using records::Response;
    for (const Response response :
         {sides ? Response::left : Response::seen, sides ? Response::right : Response::notSeen}) {
        Session answered = session;
        answered.answer({.response = response});
        if (!answered.finished()) trials.push_back(answered.next());
    }
    return trials;
}

StimulusPrefetcher::StimulusPrefetcher(int windowPx)
    : windowPx_(windowPx), worker_([this](std::stop_token stop) { work(stop); }) {}

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
        return trialImages(trial, windowPx_);
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
            images = trialImages(waiting->trial, windowPx_);
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

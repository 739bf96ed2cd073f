// SPDX-License-Identifier: MIT
#include "study_app/reruns.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "study_app/design_file.h"

namespace study_app {
namespace {

constexpr const char* kRerun = "rerun";

std::filesystem::path tableOf(const SessionRequest& request) {
    return records::trialTablePath(request.dataFolder, request.participant, request.session);
}

/// What a rerun runs again.
SessionRequest firstOf(SessionRequest request) {
    if (request.design.onlyConditions.empty() || !request.session) return request;
    const std::string& id = *request.session;
    const std::size_t at = id.rfind(kRerun);
    if (at == id.npos || id.find_first_not_of("0123456789", at + 5) != id.npos) return request;
    request.session = at == 0 ? std::nullopt : std::optional(id.substr(0, at));
    request.design.onlyConditions.clear();
    return request;
}

std::string rerunName(int number) {
    return kRerun + std::to_string(number);
}

SessionRequest rerunOf(const SessionRequest& first, int number) {
    SessionRequest request = first;
    request.session = first.session.value_or("") + rerunName(number);
    return request;
}

bool isRerunOf(const Design& first, Design again) {
    if (again.onlyConditions.empty()) return false;
    again.onlyConditions = first.onlyConditions;
    const auto json = [](const Design& d) { return nlohmann::json(normalisedJson(d)); };
    return designDifference(json(first), json(again)).empty();
}

}  // namespace

std::vector<Run> runsOf(const SessionRequest& request) {
    const SessionRequest first = firstOf(request);
    std::vector<Run> runs{{{}, replayTable(tableOf(first)).session}};
    for (int i = 1; std::filesystem::exists(tableOf(rerunOf(first, i))); ++i) {
        if (!hasBegun(tableOf(rerunOf(first, i)))) continue;
        Session session = replayTable(tableOf(rerunOf(first, i))).session;
        if (!isRerunOf(runs[0].session.design(), session.design())) continue;
        runs.push_back({rerunName(i), std::move(session)});
    }
    return runs;
}

std::vector<RunResult> runResults(const std::vector<Run>& runs) {
    std::vector<RunResult> all;
    for (const Condition& condition : runs.front().session.conditions()) {
        const std::size_t before = all.size();
        for (const Run& run : runs) {
            for (const ConditionResult& result : conditionResults(run.session)) {
                if (result.threshold.condition != condition.name) continue;
                all.push_back({.result = result, .rerun = run.rerun});
            }
        }
        if (all.size() > before) all.back().offered = all.back().result.flagged();
    }
    return all;
}

CatchResult catchResult(const std::vector<Run>& runs) {
    int answered = 0, failed = 0;
    for (const Run& run : runs) {
        answered += run.session.catchAnswered();
        failed += run.session.catchFailed();
    }
    return catchResult(runs.front().session.design(), answered, failed);
}

SessionRequest rerunRequest(const SessionRequest& request, const std::string& condition,
                            std::uint64_t freshSeed) {
    const SessionRequest first = firstOf(request);
    for (int i = 1;; ++i) {
        SessionRequest rerun = rerunOf(first, i);
        rerun.design.onlyConditions = {condition};
        rerun.seed = freshSeed;
        if (!hasBegun(tableOf(rerun))) return rerun;
        const Session there = replayTable(tableOf(rerun)).session;
        if (there.finished() || there.design().onlyConditions != rerun.design.onlyConditions ||
            !isRerunOf(first.design, there.design())) {
            continue;
        }
        rerun.seed = there.seed();
        return rerun;
    }
}

}  // namespace study_app

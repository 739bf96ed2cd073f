// SPDX-License-Identifier: MIT
#include "study_app/simulated_study.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <optional>
#include <thread>

#include "study_app/random_stream.h"

namespace study_app {
namespace {

/// Sessions wait for the disk, not for the processor: more of them than cores share one commit.
constexpr std::size_t kThreads = 16;

}  // namespace

SimulatedSession runSimulatedSession(const SessionRequest& request,
                                     const SimulatedPopulation& population,
                                     const std::function<void()>& onTrial) {
    SessionRequest simulated = request;
    simulated.observer = toText(population);
    simulated.displayWidthPx = simulated.displayHeightPx = request.design.windowPx;
    RecordedSession recorded(simulated);
    const SimulatedParticipant observer = drawParticipant(population, request.design, request.seed);
    std::size_t newRows = 0;
    for (; !recorded.session().finished(); ++newRows) {
        recorded.answer(simulatedAnswer(observer, recorded.session(), recorded.lastRow()));
        if (onTrial) onTrial();
    }
    return {.participant = request.participant,
            .table = recorded.table(),
            .notices = recorded.notices(),
            .resumedRows = recorded.resumedRows(),
            .newRows = newRows,
            .session = recorded.session(),
            .observer = observer};
}

std::vector<SimulatedSession> runSimulatedStudy(const SessionRequest& request,
                                                const SimulatedPopulation& population,
                                                std::size_t participants,
                                                const std::function<void()>& onTrial) {
    // Here and in order, since the threads would list the participants in any order.
    for (std::size_t i = 0; i < participants; ++i) {
        records::registerParticipant(request.dataFolder, participantName(i, participants));
    }
    std::vector<std::optional<SimulatedSession>> results(participants);
    std::vector<std::exception_ptr> errors(participants);
    std::atomic<std::size_t> next = 0;
    const auto work = [&] {
        for (std::size_t i = next++; i < participants; i = next++) {
            SessionRequest one = request;
            one.participant = participantName(i, participants);
            one.seed = participantSeed(request.seed, i);
            try {
                results[i] = runSimulatedSession(one, population, onTrial);
            } catch (...) {
                errors[i] = std::current_exception();
            }
        }
    };
    {
        std::vector<std::jthread> threads;
        for (std::size_t t = 0; t < std::min(kThreads, participants); ++t)
            threads.emplace_back(work);
    }
    for (const std::exception_ptr& error : errors) {
        if (error) std::rethrow_exception(error);
    }
    std::vector<SimulatedSession> sessions;
    for (auto& result : results) sessions.push_back(std::move(*result));
    return sessions;
}

std::string participantName(std::size_t index, std::size_t participants) {
    const std::size_t digits = std::max<std::size_t>(2, std::to_string(participants).size());
    std::string number = std::to_string(index + 1);
    number.insert(0, digits - std::min(digits, number.size()), '0');
    return number;
}

std::uint64_t participantSeed(std::uint64_t studySeed, std::size_t index) {
    return engineAt(studySeed, Purpose::participant, index)();
}

}  // namespace study_app

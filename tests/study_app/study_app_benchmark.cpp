// SPDX-License-Identifier: MIT
// The paper's design, simulated: 10 observers x 16 conditions x 40 trials, with and without files.
#include <benchmark/benchmark.h>

#include <cstdint>
#include <optional>

#include "records/run_context.h"
#include "study_app/session.h"
#include "study_app/simulated_population.h"
#include "study_app/simulated_study.h"
#include "tests/study_app/test_designs.h"
#include "tests/temporary_folder.h"

namespace {

void runInMemory(const study_app::Design& design, std::uint64_t seed) {
    study_app::Session session(design, seed);
    const auto observer = study_app::drawParticipant({}, design, seed);
    std::optional<records::Trial> last;
    while (!session.finished()) {
        last = session.answer(study_app::simulatedAnswer(observer, session, last));
    }
    benchmark::DoNotOptimize(last);
}

void BM_Paper16StudyInMemory(benchmark::State& state) {
    const study_app::Design design = tests::shippedDesign("paper16");
    for (auto _ : state) {
        for (std::uint64_t i = 0; i < 10; ++i)
            runInMemory(design, study_app::participantSeed(1, i));
    }
    state.SetItemsProcessed(state.iterations() * 6400);
}
BENCHMARK(BM_Paper16StudyInMemory)->Unit(benchmark::kMillisecond);

// Every row written and synced before the next trial.
void BM_Paper16StudyRecorded(benchmark::State& state) {
    const study_app::SessionRequest request{.dataFolder = {},
                                            .participant = {},
                                            .session = {},
                                            .design = tests::shippedDesign("paper16"),
                                            .seed = 1,
                                            .context = records::currentRunContext("benchmark", {})};
    for (auto _ : state) {
        state.PauseTiming();
        const tests::TemporaryFolder folder;
        study_app::SessionRequest one = request;
        one.dataFolder = folder.path();
        state.ResumeTiming();
        study_app::runSimulatedStudy(one, {}, 10);
        state.PauseTiming();  // removing the files is not part of the study
        state.ResumeTiming();
    }
    state.SetItemsProcessed(state.iterations() * 6400);
}
BENCHMARK(BM_Paper16StudyRecorded)->Unit(benchmark::kMillisecond)->UseRealTime()->MinTime(2);

}  // namespace

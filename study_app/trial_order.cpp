// SPDX-License-Identifier: MIT
#include "study_app/trial_order.h"

#include <algorithm>
#include <numeric>
#include <random>
#include <span>
#include <utility>

#include "quest/random.h"
#include "study_app/random_stream.h"

namespace study_app {
namespace {

/// R. Durstenfeld 1964; std::shuffle is not the same everywhere.
void shuffle(std::span<std::size_t> items, std::mt19937_64& rng) {
    for (std::size_t i = items.size(); i > 1; --i) {
        std::swap(items[i - 1], items[quest::uniformBelow(rng, i)]);
    }
}

/// `count` entries of `candidates`, each as often as any other up to one, in shuffled blocks.
std::vector<std::size_t> inShuffledBlocks(const std::vector<std::size_t>& candidates,
                                          std::size_t count, std::mt19937_64& rng) {
    std::vector<std::size_t> result;
    while (result.size() < count) {
        std::vector<std::size_t> block = candidates;
        shuffle(block, rng);
        block.resize(std::min(block.size(), count - result.size()));
        result.insert(result.end(), block.begin(), block.end());
    }
    return result;
}

std::vector<std::size_t> catchConditions(const Design& design) {
    const std::vector<Condition> all = conditions(design);
    const int largest = std::ranges::max(all, {}, &Condition::artifactPx).artifactPx;
    std::vector<std::size_t> result;
    for (std::size_t k = 0; k < all.size(); ++k) {
        const bool obvious = all[k].artifactPx == largest;
        if (design.task == records::Task::yesNo || obvious) result.push_back(k);
    }
    return result;
}

/// The place of each catch trial among `total` trials.
std::vector<std::size_t> catchPlaces(std::size_t catches, std::size_t total, std::mt19937_64& rng) {
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < catches; ++i) {
        const std::size_t begin = i * total / catches, end = (i + 1) * total / catches;
        places.push_back(begin + quest::uniformBelow(rng, end - begin));
    }
    return places;
}

}  // namespace

std::vector<TrialSlot> trialOrder(const Design& design, std::uint64_t seed) {
    std::mt19937_64 rng = engineAt(seed, Purpose::order, 0);
    std::vector<std::size_t> everyCondition(conditions(design).size());
    std::iota(everyCondition.begin(), everyCondition.end(), std::size_t{0});
    const auto trials = static_cast<std::size_t>(design.trialsPerCondition);
    const auto staircaseTrials =
        inShuffledBlocks(everyCondition, everyCondition.size() * trials, rng);
    const auto catches = static_cast<std::size_t>(catchTrials(design));
    const auto caught = inShuffledBlocks(catchConditions(design), catches, rng);
    const auto places = catchPlaces(catches, staircaseTrials.size() + catches, rng);

    std::vector<TrialSlot> slots;
    auto nextTrial = staircaseTrials.begin();
    auto nextCatch = caught.begin();
    for (auto place = places.begin();
         nextTrial != staircaseTrials.end() || place != places.end();) {
        const bool isCatch = place != places.end() && *place == slots.size();
        slots.push_back({isCatch ? *nextCatch++ : *nextTrial++, isCatch});
        if (isCatch) ++place;
    }
    return slots;
}

}  // namespace study_app

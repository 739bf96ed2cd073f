// SPDX-License-Identifier: MIT
#include "resolution_controller/texel_budget.h"

#include <algorithm>

namespace resolution_controller {
namespace {

std::uint64_t cost(const BudgetLight& light, std::int32_t size) noexcept {
    const auto edge = static_cast<std::uint64_t>(size);
    return edge * edge * static_cast<std::uint64_t>(light.costPerTexel);
}

std::int32_t below(const BudgetLight& light, std::int32_t size) noexcept {
    return std::max(levelAtMost(size - 1, light.levelRatio).value_or(light.lowest), light.lowest);
}

std::int32_t above(const BudgetLight& light, std::int32_t size) noexcept {
    return std::min(levelAtLeast(size + 1, light.levelRatio).value_or(light.wanted), light.wanted);
}

/// Is a.need / sizeA worse (larger) than b.need / sizeB?
bool isWorse(const BudgetLight& a, std::int32_t sizeA, const BudgetLight& b,
             std::int32_t sizeB) noexcept {
    return static_cast<std::int64_t>(a.need) * sizeB > static_cast<std::int64_t>(b.need) * sizeA;
}

/// The allotment for e = 2^(quarters / 4): each light's smallest level of at least need / e.
std::uint64_t allotFor(std::span<BudgetLight> lights, int quarters) noexcept {
    // 2^(1/4), ... times 2^16. Any number near them would do: they only say where to begin.
    constexpr std::int64_t kQuarters[] = {65536, 77936, 92682, 110218};
    const std::int64_t e = kQuarters[quarters % 4] << (quarters / 4);
    std::uint64_t used = 0;
    for (BudgetLight& light : lights) {
        const std::int64_t atLeast = ((std::int64_t{light.need} << 16) + e - 1) / e;
        light.size = std::clamp(levelAtLeast(atLeast, light.levelRatio).value_or(light.wanted),
                                light.lowest, light.wanted);
        used += cost(light, light.size);
    }
    return used;
}

/// Brings the lights to the allotment for the largest of a few e that still exceeds the budget: the
/// steps of lower() that are certain, at once.
std::uint64_t lowerCoarsely(std::span<BudgetLight> lights, std::uint64_t budget) noexcept {
    int exceeds = 0, fits = 68;  // 2^17: need is at most 2^16
    while (fits - exceeds > 1) {
        const int middle = (exceeds + fits) / 2;
        (allotFor(lights, middle) > budget ? exceeds : fits) = middle;
    }
    return allotFor(lights, exceeds);
}

/// Takes a level at a time from the light that suffers least, until the budget holds. The order of
/// the steps is that of the ratios they lead to, so that the last one's is the smallest possible e.
void lower(std::span<BudgetLight> lights, std::uint64_t budget, std::uint64_t& used,
           std::span<std::uint32_t> heap) noexcept {
    const auto suffersMore = [lights](std::uint32_t i, std::uint32_t j) {
        const BudgetLight &a = lights[i], &b = lights[j];
        const std::int32_t sizeA = below(a, a.size), sizeB = below(b, b.size);
        if (isWorse(a, sizeA, b, sizeB)) return true;
        if (isWorse(b, sizeB, a, sizeA)) return false;
        return i < j;  // of equals, the later one gives
    };
    std::size_t count = 0;
    for (std::uint32_t i = 0; i < lights.size(); ++i) {
        if (lights[i].size > lights[i].lowest) heap[count++] = i;
    }
    const auto begin = heap.begin();
    std::make_heap(begin, begin + static_cast<std::ptrdiff_t>(count), suffersMore);
    while (used > budget && count > 0) {
        const auto end = begin + static_cast<std::ptrdiff_t>(count);
        std::pop_heap(begin, end, suffersMore);
        BudgetLight& light = lights[heap[count - 1]];
        const std::int32_t size = below(light, light.size);
        used -= cost(light, light.size) - cost(light, size);
        light.size = size;
        if (size > light.lowest) {
            std::push_heap(begin, end, suffersMore);
        } else {
            --count;
        }
    }
}

/// Gives what is left to the worst off, a level at a time, as far as it goes.
void raise(std::span<BudgetLight> lights, std::uint64_t budget, std::uint64_t& used,
           std::span<std::uint32_t> heap) noexcept {
    const auto suffersLess = [lights](std::uint32_t i, std::uint32_t j) {
        const BudgetLight &a = lights[i], &b = lights[j];
        if (isWorse(b, b.size, a, a.size)) return true;
        if (isWorse(a, a.size, b, b.size)) return false;
        return i > j;  // of equals, the first one gets
    };
    std::size_t count = 0;
    for (std::uint32_t i = 0; i < lights.size(); ++i) {
        if (lights[i].size < lights[i].wanted) heap[count++] = i;
    }
    const auto begin = heap.begin();
    std::make_heap(begin, begin + static_cast<std::ptrdiff_t>(count), suffersLess);
    while (count > 0) {
        const auto end = begin + static_cast<std::ptrdiff_t>(count);
        std::pop_heap(begin, end, suffersLess);
        BudgetLight& light = lights[heap[count - 1]];
        const std::int32_t size = above(light, light.size);
        const std::uint64_t more = cost(light, size) - cost(light, light.size);
        if (more > budget - used) {
            --count;  // nor will it fit later
            continue;
        }
        used += more;
        light.size = size;
        if (size < light.wanted) {
            std::push_heap(begin, end, suffersLess);
        } else {
            --count;
        }
    }
}

}  // namespace

BudgetUse shareBudget(std::span<BudgetLight> lights, std::int64_t budget,
                      std::span<std::uint32_t> scratch) noexcept {
    BudgetUse use;
    for (BudgetLight& light : lights) {
        light.size = light.wanted = std::max(light.wanted, light.lowest);
        use.wanted += cost(light, light.size);
    }
    const auto available = static_cast<std::uint64_t>(std::max<std::int64_t>(budget, 0));
    use.used = use.wanted;
    if (use.used <= available) return use;
    use.used = lowerCoarsely(lights, available);
    lower(lights, available, use.used, scratch);
    use.feasible = use.used <= available;
    if (use.feasible) raise(lights, available, use.used, scratch);
    return use;
}

}  // namespace resolution_controller

// SPDX-License-Identifier: MIT
// The calls of a frame allocate nothing: counted by operator new itself.
#include <gtest/gtest.h>

#include <limits>
#include <utility>
#include <vector>

#include "resolution_controller/light_set.h"
#include "resolution_controller/resolution_controller.h"
#include "tests/resolution_controller/counting_new.h"

namespace {

namespace rc = resolution_controller;

TEST(Allocation, IsCounted) {
    const long before = allocationCount();
    EXPECT_NE(rc::validate(rc::Settings{.percentile = 2}), "");
    const long after = allocationCount();
    EXPECT_GT(after, before);
}

TEST(Allocation, NoneInTheCallsOfAFrame) {
    rc::ResolutionController controller({});
    rc::DemandHistogram histogram;
    rc::RecentDemand recent(16);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    long reasonLength = 0;
    const long before = allocationCount();
    for (int frame = 0; frame < 500; ++frame) {
        const float r = 0.0005f * float(1 + frame % 60);
        histogram.add(rc::demand(3.47f, r, rc::pixelFootprint({.dudx = r, .dvdy = r})));
        if (frame % 100 == 99) recent.clear();
        recent.add(histogram);
        const rc::Frame limited{.budgetSize = frame % 7 == 0 ? std::optional(frame) : std::nullopt};
        for (const rc::Decision& d :
             {controller.update(recent.sum(), limited), controller.update(double(r)),
              controller.update(nan), controller.hold(limited),
              controller.update(rc::DemandHistogram{})}) {
            reasonLength += rc::text(d.reason)[0];
        }
    }
    const long after = allocationCount();
    EXPECT_EQ(after, before);
    EXPECT_GT(reasonLength, 0);
}

TEST(Allocation, NoneForManyLightsUnderABudget) {
    const std::vector<rc::Settings> settings(64, {.crossFadeFrames = 5});
    rc::LightSet lights(settings);
    std::vector<rc::LightData> data(64);
    std::vector<rc::Decision> decisions(64);
    rc::DemandHistogram histogram;
    std::int64_t changes = 0;
    const long before = allocationCount();
    for (int frame = 0; frame < 300; ++frame) {
        histogram.add(float(frame * 13));
        for (std::size_t i = 0; i < 64; ++i) {
            data[i].kind = rc::LightData::Kind((static_cast<std::size_t>(frame) + i) % 5);
            data[i].radiusUv = 0.001 * double(1 + (static_cast<std::size_t>(frame) * i) % 90);
            data[i].histogram = &histogram;
        }
        changes += lights.update(data, decisions, {.texels = frame * 100'000}).changes;
    }
    const long after = allocationCount();
    EXPECT_EQ(after, before);
    EXPECT_GT(changes, 1000) << "the budget was at work";
}

static_assert(noexcept(std::declval<rc::LightSet&>().update({}, {})));
static_assert(noexcept(std::declval<rc::ResolutionController&>().update(0.1)));
static_assert(noexcept(std::declval<rc::ResolutionController&>().update(rc::DemandHistogram{})));
static_assert(noexcept(std::declval<rc::ResolutionController&>().hold()));

}  // namespace

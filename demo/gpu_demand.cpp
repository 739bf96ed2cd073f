// SPDX-License-Identifier: MIT
#include "demo/gpu_demand.h"

#include <algorithm>

namespace demo {

namespace rc = resolution_controller;

renderer::DemandRule gpuRule(const rc::DemandRule& rule) {
    return {rule.c, rule.pixelBound, rule.contrastExponent, rule.texelsPerCaster};
}

rc::DemandHistogram histogramOf(const renderer::DemandPass::Counters& counters) {
    static_assert(sizeof counters == sizeof(rc::DemandHistogram));
    rc::DemandHistogram histogram;
    std::copy_n(counters.begin(), histogram.counts.size(), histogram.counts.begin());
    histogram.rejected = counters.back();
    return histogram;
}

}  // namespace demo

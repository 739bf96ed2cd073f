// SPDX-License-Identifier: MIT
// The controller's demand as the renderer's demand pass has it; neither knows the other.
#pragma once

#include "renderer/demand_pass.h"
#include "resolution_controller/demand.h"

namespace demo {

renderer::DemandRule gpuRule(const resolution_controller::DemandRule& rule);

resolution_controller::DemandHistogram histogramOf(const renderer::DemandPass::Counters& counters);

}  // namespace demo

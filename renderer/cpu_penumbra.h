// SPDX-License-Identifier: MIT
// How wide a technique's kernel is at a receiver, on the CPU (see cpu_filter.h): a file under
// shaders/filters whose kernel differs from point to point defines
//
//   SHARED_FUNCTION real penumbraRadiusUv(sampler2D map, ShadowReceiver receiver, ShadowConstants
//   shadow)
//
// a fraction of the map's extent, before any least radius, negative where nothing is in the way. It
// takes the map of depths whatever the lookup reads.
#pragma once

#include "renderer/cpu_filter.h"

namespace renderer {

/// Of a technique without such a function, the kernel's radius that the constants hold.
template <class Real>
Real cpuPenumbraRadiusUv(const Technique& technique, MapView depths,
                         const ReceiverOf<Real>& receiver, const ConstantsOf<Real>& constants);

}  // namespace renderer

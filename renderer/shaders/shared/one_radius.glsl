// SPDX-License-Identifier: MIT
// Stands for a technique's file where all that a pass asks of it is the kernel's radius, and that is the same at every
// point.

SHARED_FUNCTION real penumbraRadiusUv(sampler2D map, ShadowReceiver receiver, ShadowConstants shadow) {
    return shadow.kernel.x;
}

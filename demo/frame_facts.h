// SPDX-License-Identifier: MIT
// What sizing policies may know of a frame, taken from the frame that was drawn last.
#pragma once

#include "demo/sizing_policy.h"
#include "renderer/renderer.h"

namespace demo {

/// `frame` must not draw anything else while the facts are asked for demands.
FrameFacts frameFacts(renderer::Renderer& frame, const resolution_controller::Slope& slope);

}  // namespace demo

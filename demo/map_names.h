// SPDX-License-Identifier: MIT
// What people call the maps of a frame.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "renderer/light_views.h"

namespace demo {

/// "sun", or "sun, cascade 1" and so on; of each lamp "lamp 1", or its cube's "lamp 1, face +x".
std::vector<std::string> mapNames(std::span<const renderer::LightView> views);

}  // namespace demo

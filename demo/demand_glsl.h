// SPDX-License-Identifier: MIT
// resolution_controller/demand.glsl, built into the programs.
#pragma once

namespace demo {

extern const char* const kDemandGlsl;

}  // namespace demo

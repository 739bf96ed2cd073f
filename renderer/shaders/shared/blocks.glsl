// SPDX-License-Identifier: MIT
// The uniform blocks as the passes see them. Binding points: renderer/shader_math.h.
#include "shared/constants.glsl"

layout(std140, binding = BINDING_VIEW) uniform ViewBlock { ViewConstants view; };
layout(std140, binding = BINDING_SHADOW) uniform ShadowBlock { ShadowConstants shadow; };
layout(std140, binding = BINDING_LOOK) uniform LookBlock { LookConstants look; };

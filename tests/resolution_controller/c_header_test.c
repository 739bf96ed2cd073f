/* SPDX-License-Identifier: MIT */
/* The header as a C11 compiler sees it, and a light through it. Compiled as C with warnings as
 * errors; c_interface_test.cpp calls it. */
#include <stdio.h>

#include "resolution_controller/stairwell.h"

int32_t sizeChosenFromC(double radius_uv);

int32_t sizeChosenFromC(double radius_uv) {
    stairwell_settings settings;
    stairwell_lights* lights = NULL;
    stairwell_light light;
    stairwell_decision choice;
    char message[100];
    if (stairwell_settings_init(&settings, sizeof settings) ||
        stairwell_light_init(&light, sizeof light)) {
        return -1;
    }
    if (stairwell_create(&settings, 1, &lights, message, sizeof message)) return -2;
    light.kind = STAIRWELL_RADIUS;
    light.radius_uv = radius_uv;
    if (stairwell_update(lights, &light, 1, NULL, &choice, sizeof choice, NULL)) choice.size = -3;
    stairwell_destroy(lights);
    return choice.size;
}

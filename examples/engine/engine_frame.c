/* SPDX-License-Identifier: MIT */
/* engine_frame.cpp in C: the same frames, the same output. */
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "resolution_controller/stairwell.h"

enum { ASKED_IN = 16 }; /* frames in which every pixel is asked once */

static void demandOfLamp(const stairwell_settings* settings, const stairwell_decision* drawn,
                         int frame, stairwell_histogram* histogram) {
    const float footprint = 1.0f / 2000;
    const float enlargedTo = footprint * (float)drawn->size < 1 ? (float)drawn->min_radius_uv : 0;
    memset(histogram, 0, sizeof *histogram);
    for (int pixel = 1 + frame % ASKED_IN; pixel <= 1000; pixel += ASKED_IN) {
        const float radiusUv = 0.00002f * (float)(pixel + frame);
        const float shownRadiusUv = radiusUv > enlargedTo ? radiusUv : enlargedTo;
        stairwell_histogram_add(histogram, stairwell_demand(settings, radiusUv, footprint, 1, 0),
                                stairwell_demand_weight(shownRadiusUv, footprint));
    }
}

int main(void) {
    stairwell_settings settings[2];
    stairwell_light data[2];
    stairwell_decision choices[2];
    stairwell_recent recent;
    stairwell_lights* lights = NULL;
    const int64_t budget = 8 << 20;
    char message[200];

    if (stairwell_abi() != STAIRWELL_ABI) return 1;
    for (int light = 0; light < 2; ++light) {
        stairwell_settings* s = &settings[light];
        stairwell_settings_init(s, sizeof *s);
        s->driver_max_size = 16384;
        s->cross_fade_frames = 8;
        stairwell_slope_for(&s->slope, 0.10, 0.5, STAIRWELL_CODE, STAIRWELL_DISC, &s->slope, NULL);
        stairwell_light_init(&data[light], sizeof data[light]);
    }
    stairwell_recent_init(&recent, sizeof recent, ASKED_IN);
    memset(choices, 0, sizeof choices);
    if (stairwell_create(settings, 2, &lights, message, sizeof message)) {
        fprintf(stderr, "%s\n", message);
        return 1;
    }

    for (int frame = 0; frame < 200; ++frame) {
        stairwell_histogram histogram;
        demandOfLamp(&settings[1], &choices[1], frame, &histogram);
        stairwell_recent_add(&recent, &histogram);
        data[0].kind = STAIRWELL_RADIUS;
        data[0].radius_uv = 0.02 / (1 + frame % 100 / 8);
        data[1].kind = STAIRWELL_HISTOGRAM;
        data[1].histogram = &recent.sum;
        if (stairwell_update(lights, data, 2, &budget, choices, sizeof choices[0], NULL)) return 1;
        for (int light = 0; light < 2; ++light) {
            const stairwell_decision* choice = &choices[light];
            if (!choice->changed) continue;
            printf("frame %3d, light %d: %5d texels (%s), filter at least %.6f\n", frame, light,
                   (int)choice->size, stairwell_reason_text(choice->reason), choice->min_radius_uv);
        }
    }
    stairwell_destroy(lights);
    return 0;
}

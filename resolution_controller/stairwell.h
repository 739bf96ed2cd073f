/* SPDX-License-Identifier: MIT */
/*
 * The controller for programs in C, and for whatever calls C: light_set.h with plain structs and
 * status codes. What the quantities mean stands in the C++ headers of the same names (slope.h,
 * demand.h, resolution_controller.h, light_set.h); here is only what differs.
 *
 *     stairwell_settings settings;
 *     stairwell_settings_init(&settings, sizeof settings);
 *     settings.driver_max_size = max_texture_size;
 *     stairwell_lights* lights;
 *     if (stairwell_create(&settings, 1, &lights, message, sizeof message)) puts(message);
 *     ... every frame:
 *     stairwell_light light;
 *     stairwell_light_init(&light, sizeof light);
 *     light.kind = STAIRWELL_RADIUS;
 *     light.radius_uv = radius_uv;
 *     stairwell_decision choice;
 *     stairwell_update(lights, &light, 1, NULL, &choice, sizeof choice, NULL);
 *
 * Every function checks its arguments and returns a status; after anything but STAIRWELL_OK its
 * outputs are untouched, messages and the frames of stairwell_trace_replay aside, and so is what it
 * was to change (stairwell_reconfigure excepted, see there). No exception leaves. Structs that go
 * in carry their size: fill them by their init function with sizeof, so that a caller and a library
 * of different age notice each other; their `reserved` fields must be 0, else the answer is
 * STAIRWELL_BAD_VALUE. A pointer that is neither NULL nor what the function asks for cannot be
 * noticed.
 *
 * stairwell_update, and what else is called every frame (demand, histogram, recent, texts), neither
 * allocates nor waits nor looks at a clock. One set of lights is for one thread at a time;
 * different sets and the functions without a set are for any.
 *
 * Messages are cut to fit and always end in a 0, and are empty after STAIRWELL_OK; message may be
 * NULL, and message_size 0.
 */
#ifndef STAIRWELL_H
#define STAIRWELL_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
#define STAIRWELL_NOEXCEPT noexcept
extern "C" {
#else
#define STAIRWELL_NOEXCEPT
#endif

/* Changes when a program that keeps to what its header says could no longer use the library: when a
 * struct, a function or a number has another meaning. It stays when there are more functions, more
 * reasons at the end, and when the library begins to refuse what was never allowed, as in
 * `reserved` fields anything but 0. A program that finds another number in the library than here
 * must not go on. */
#define STAIRWELL_ABI 1
uint32_t stairwell_abi(void) STAIRWELL_NOEXCEPT;

typedef enum stairwell_status {
    STAIRWELL_OK = 0,
    STAIRWELL_NULL_ARGUMENT = 1,
    STAIRWELL_BAD_STRUCT_SIZE = 2, /* not initialised, or of another version of the library */
    STAIRWELL_BAD_VALUE = 3,       /* the message, where there is one, names it */
    STAIRWELL_BAD_COUNT = 4,       /* not the number of lights of the set, or too many for one */
    STAIRWELL_BAD_INDEX = 5,       /* no such light */
    STAIRWELL_NO_MEMORY = 6,
    STAIRWELL_BUFFER_TOO_SMALL = 7,
    STAIRWELL_BAD_TRACE = 8,
    STAIRWELL_TRACE_DIFFERS = 9
} stairwell_status;
/* A few words; "unknown" for any other number. */
const char* stairwell_status_text(int32_t status) STAIRWELL_NOEXCEPT;

/* ---- Slope ---- */

enum { STAIRWELL_TWO_AFC = 0, STAIRWELL_YES_NO = 1 };
enum { STAIRWELL_SRGB = 0, STAIRWELL_CODE = 1, STAIRWELL_ENCODING_UNKNOWN = 2 };
enum {
    STAIRWELL_DISC = 0,
    STAIRWELL_BOX = 1,
    STAIRWELL_GAUSSIAN = 2,
    STAIRWELL_SAMPLED = 3,
    STAIRWELL_KERNEL_UNKNOWN = 4
};

typedef struct stairwell_slope {
    uint32_t struct_size;
    int32_t major;
    double c;
    double criterion;
    double beta;
    double c90; /* 0: not known */
    double contrast_exponent;
    int32_t task;
    int32_t encoding;
    int32_t kernel;
    int32_t reserved; /* 0 */
} stairwell_slope;

/* The published slope. `size` is sizeof(stairwell_slope). */
stairwell_status stairwell_slope_init(stairwell_slope* slope, size_t size) STAIRWELL_NOEXCEPT;

/* Bits of the warnings of stairwell_slope_for (audience.h). */
enum {
    STAIRWELL_ENCODING_DIFFERS = 1,
    STAIRWELL_KERNEL_DIFFERS = 2,
    STAIRWELL_ENCODING_NOT_SAID = 4,
    STAIRWELL_KERNEL_NOT_SAID = 8,
    STAIRWELL_POPULATION_UNKNOWN = 16
};
/* A sentence for one bit. */
const char* stairwell_warning_text(uint32_t warning) STAIRWELL_NOEXCEPT;

/* The slope for an audience: `detection` in [0, 1), 0 meaning the slope's own criterion; `people`
 * in [.01, .99], .5 being the mean observer. Encoding and kernel are the renderer's. `measured` and
 * `asked` may be the same; `warnings` may be NULL. */
stairwell_status stairwell_slope_for(const stairwell_slope* measured, double detection,
                                     double people, int32_t encoding, int32_t kernel,
                                     stairwell_slope* asked, uint32_t* warnings) STAIRWELL_NOEXCEPT;

/* ---- Settings ---- */

enum { STAIRWELL_SQRT_TWO = 0, STAIRWELL_TWO = 1 };

typedef struct stairwell_settings {
    uint32_t struct_size;
    int32_t min_size;
    int32_t max_size;
    int32_t driver_max_size;
    int32_t level_ratio; /* STAIRWELL_TWO: powers of two only */
    int32_t lower_after_frames;
    int32_t lower_below_percent;
    int32_t start_size;
    int32_t texture_size; /* 0: re-allocated at its size */
    int32_t cross_fade_frames;
    int32_t budget_per_texel;
    float pixel_bound;
    float texels_per_caster;
    int32_t reserved; /* 0 */
    double percentile;
    stairwell_slope slope;
} stairwell_settings;

/* The defaults. `size` is sizeof(stairwell_settings). */
stairwell_status stairwell_settings_init(stairwell_settings* settings,
                                         size_t size) STAIRWELL_NOEXCEPT;

/* ---- Demand ---- */

/* A DemandHistogram: 64 bins and what was rejected, as the buffer that a GPU fills. All zeros is an
 * empty one. */
typedef struct stairwell_histogram {
    uint32_t counts[64];
    uint32_t rejected;
} stairwell_histogram;

/* sigma of the derivatives of the light-space uv by the pixel's place; 0 without a bound. */
float stairwell_pixel_footprint(float dudx, float dvdx, float dudy, float dvdy) STAIRWELL_NOEXCEPT;
/* N(p) under these settings; 0, which a histogram rejects, also for settings that are NULL or not
 * initialised (struct_size, reserved). footprint 0: no bound; contrast 1: full; caster_width_uv 0:
 * none is thin. */
float stairwell_demand(const stairwell_settings* settings, float radius_uv, float footprint,
                       float contrast, float caster_width_uv) STAIRWELL_NOEXCEPT;
/* How much of a shadow's edge the point stands for, in 64ths of a pixel, 1 to 64; 1 where radius or
 * footprint cannot be used. The radius as it is shown, after enlargement to min_radius_uv. */
uint32_t stairwell_demand_weight(float shown_radius_uv, float footprint) STAIRWELL_NOEXCEPT;
/* Counts a demand `weight` times; 1 everywhere lets all points count alike. */
stairwell_status stairwell_histogram_add(stairwell_histogram* histogram, float demanded_texels,
                                         uint32_t weight) STAIRWELL_NOEXCEPT;

enum { STAIRWELL_MOST_RECENT = 64 };

/* The histograms of a light's last frames together, RecentDemand: what stairwell_light.histogram
 * points to where a frame asks only a share of its pixels.
 *
 *     stairwell_recent_init(&recent, sizeof recent, 16);
 *     ... every frame:
 *     while (reading = ...) stairwell_recent_add(&recent, reading);  all that the GPU has finished
 *     light.histogram = &recent.sum;
 *     ... at a camera cut, and then add nothing drawn before it:
 *     stairwell_recent_clear(&recent);
 */
typedef struct stairwell_recent {
    uint32_t struct_size;
    int32_t frames;          /* that count, 1 to STAIRWELL_MOST_RECENT */
    stairwell_histogram sum; /* to be read */
    /* The library's: */
    int32_t next;     /* which of `last` is the oldest */
    int32_t reserved; /* 0 */
    stairwell_histogram last[STAIRWELL_MOST_RECENT];
} stairwell_recent;

/* Empty. `size` is sizeof(stairwell_recent). STAIRWELL_BAD_VALUE: not so many frames. */
stairwell_status stairwell_recent_init(stairwell_recent* recent, size_t size,
                                       int32_t frames) STAIRWELL_NOEXCEPT;
/* Adds the newest frame's histogram to the sum and takes the oldest's out of it. `newest` may be
 * &recent->sum. */
stairwell_status stairwell_recent_add(stairwell_recent* recent,
                                      const stairwell_histogram* newest) STAIRWELL_NOEXCEPT;
/* Empty again, for as many frames. */
stairwell_status stairwell_recent_clear(stairwell_recent* recent) STAIRWELL_NOEXCEPT;

/* ---- Lights ---- */

typedef struct stairwell_lights stairwell_lights;

enum { STAIRWELL_NO_DATA = 0, STAIRWELL_RADIUS = 1, STAIRWELL_HISTOGRAM = 2, STAIRWELL_OFF = 3 };

/* A light in a frame. */
typedef struct stairwell_light {
    uint32_t struct_size;
    int32_t kind;                         /* what of the following holds data */
    double radius_uv;                     /* for STAIRWELL_RADIUS */
    const stairwell_histogram* histogram; /* for STAIRWELL_HISTOGRAM; NULL: no data */
    double contrast;                      /* 1 */
    double footprint_uv;
    double largest_radius_uv;
    int32_t budget_size; /* 0: no budget of its own */
    int32_t camera_cut;  /* 0 or 1 */
    int32_t data_age_frames;
    int32_t detail_texels;
} stairwell_light;

/* No data, full contrast. `size` is sizeof(stairwell_light). */
stairwell_status stairwell_light_init(stairwell_light* light, size_t size) STAIRWELL_NOEXCEPT;

typedef struct stairwell_decision {
    int32_t size;
    int32_t previous_size;
    int32_t changed;
    int32_t reason;
    int32_t need;
    /* Another change in a fade leaves it while fade_weight is below 1/2; one back to it turns the
     * fade round, from the size that was faded to. */
    int32_t fade_from_size;
    double fade_weight;
    double artifact_ratio;
    double share_above;
    double min_radius_uv;
    /* map_constants.h, for `size`: */
    int32_t viewport;
    int32_t cleared;
    int32_t kernel_reach_texels;
    int32_t reserved;
    double texture_scale;
    double texel_uv;
    double radius_uv;
    double radius_texels;
    double plane_bias_uv;
    double normal_offset_uv;
} stairwell_decision;

enum {
    STAIRWELL_DEMAND_MET = 0,
    STAIRWELL_WAITING_TO_LOWER = 1,
    STAIRWELL_AT_MINIMUM = 2,
    STAIRWELL_LIMITED_BY_PERCENTILE = 3,
    STAIRWELL_LIMITED_BY_MAXIMUM = 4,
    STAIRWELL_LIMITED_BY_DRIVER = 5,
    STAIRWELL_LIMITED_BY_BUDGET = 6,
    STAIRWELL_HELD_WITHOUT_DATA = 7,
    STAIRWELL_HELD_EMPTY_HISTOGRAM = 8,
    STAIRWELL_HELD_REJECTED_DEMAND = 9,
    STAIRWELL_HELD_BAD_RADIUS = 10,
    STAIRWELL_HELD_BAD_SETTINGS = 11,
    STAIRWELL_HELD_BAD_SLOPE = 12,
    STAIRWELL_HELD_OLD_VIEW = 13,
    STAIRWELL_DETAIL_MET = 14,
    STAIRWELL_LIMITED_BY_TEXTURE = 15,
    STAIRWELL_SWITCHED_OFF = 16
};
/* A few words for a log or an overlay; "unknown" for any other number. */
const char* stairwell_reason_text(int32_t reason) STAIRWELL_NOEXCEPT;

typedef struct stairwell_summary {
    int32_t feasible; /* 0: even the smallest sizes are above the budget */
    int32_t changes;
    uint64_t wanted;
    uint64_t used;
    uint64_t worst_light;
    double worst_artifact_ratio;
} stairwell_summary;

/* `count` lights, one settings for each; 0 lights are allowed, more than 4096 are not. On success
 * *lights is to be given to stairwell_destroy. The message says what is wrong with which light. */
stairwell_status stairwell_create(const stairwell_settings* settings, size_t count,
                                  stairwell_lights** lights, char* message,
                                  size_t message_size) STAIRWELL_NOEXCEPT;
/* NULL is allowed. */
void stairwell_destroy(stairwell_lights* lights) STAIRWELL_NOEXCEPT;

/* A frame: `count` entries of `data` and of `decisions`, count being that of the set, and
 * `decision_size` sizeof(stairwell_decision). `budget` may be NULL: none; *budget in texels, or in
 * bytes where budget_per_texel counts them. `summary` may be NULL. */
stairwell_status stairwell_update(stairwell_lights* lights, const stairwell_light* data,
                                  size_t count, const int64_t* budget,
                                  stairwell_decision* decisions, size_t decision_size,
                                  stairwell_summary* summary) STAIRWELL_NOEXCEPT;

/* New settings for a light. STAIRWELL_BAD_VALUE: they are unusable, the old ones stay, and the
 * light is held with that reason until usable ones come; but for `reserved` fields that are not 0,
 * which change nothing. */
stairwell_status stairwell_reconfigure(stairwell_lights* lights, size_t light,
                                       const stairwell_settings* settings, char* message,
                                       size_t message_size) STAIRWELL_NOEXCEPT;

/* ---- Traces (trace.h) ---- */

/* Records from the next frame on into `buffer`, which must stay where it is until
 * stairwell_trace_stop, stairwell_destroy or another start. STAIRWELL_BUFFER_TOO_SMALL: not even
 * the settings fit, and nothing is recorded. A buffer that gets full ends the recording; what it
 * holds is good. */
stairwell_status stairwell_trace_start(stairwell_lights* lights, void* buffer,
                                       size_t buffer_size) STAIRWELL_NOEXCEPT;
/* Ends the recording: bytes written, and frames that did not fit. Either may be NULL. Without a
 * recording both are 0. */
stairwell_status stairwell_trace_stop(stairwell_lights* lights, size_t* bytes,
                                      uint64_t* lost) STAIRWELL_NOEXCEPT;
/* Decides anew: STAIRWELL_OK where every decision is made again, STAIRWELL_TRACE_DIFFERS with the
 * first difference in the message, STAIRWELL_BAD_TRACE with what is wrong and where. A trace that
 * differs and then cannot be read any further is STAIRWELL_TRACE_DIFFERS, with both in the message.
 * `frames` may be NULL; after these three *frames is the number of frames that were decided anew:
 * all of the trace, or those before the place where it cannot be read. */
stairwell_status stairwell_trace_replay(const void* trace, size_t trace_size, uint64_t* frames,
                                        char* message, size_t message_size) STAIRWELL_NOEXCEPT;

#ifdef __cplusplus
}
#endif

#endif

// SPDX-License-Identifier: MIT
#include "resolution_controller/stairwell.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <memory>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "resolution_controller/audience.h"
#include "resolution_controller/light_set.h"
#include "resolution_controller/sentence.h"
#include "resolution_controller/trace.h"

namespace rc = resolution_controller;

static_assert(sizeof(stairwell_histogram) == sizeof(rc::DemandHistogram));
static_assert(STAIRWELL_MOST_RECENT == rc::RecentDemand::kMostFrames);
static_assert(STAIRWELL_SWITCHED_OFF == static_cast<int>(rc::Reason::switchedOff) &&
              STAIRWELL_SWITCHED_OFF == rc::kReasons - 1);
static_assert(STAIRWELL_HELD_WITHOUT_DATA == static_cast<int>(rc::Reason::heldWithoutData));
static_assert(STAIRWELL_DETAIL_MET == static_cast<int>(rc::Reason::detailMet));
static_assert(STAIRWELL_OFF == static_cast<int>(rc::LightData::Kind::off));
static_assert(STAIRWELL_KERNEL_UNKNOWN == static_cast<int>(rc::Kernel::unknown));
static_assert(STAIRWELL_ENCODING_UNKNOWN == static_cast<int>(rc::Encoding::unknown));
static_assert(STAIRWELL_POPULATION_UNKNOWN == static_cast<int>(rc::Warning::populationUnknown));

struct stairwell_lights {
    explicit stairwell_lights(const std::vector<rc::Settings>& settings)
        : lights(settings),
          histograms(settings.size()),
          data(settings.size()),
          decisions(settings.size()) {}

    rc::LightSet lights;
    std::vector<rc::DemandHistogram> histograms;
    std::vector<rc::LightData> data;
    std::vector<rc::Decision> decisions;
    std::optional<rc::TraceWriter> trace;
};

namespace {

void tell(char* message, std::size_t size, std::string_view text) noexcept {
    if (!message || size == 0) return;
    const std::size_t length = std::min(text.size(), size - 1);
    std::memcpy(message, text.data(), length);
    message[length] = 0;
}

/// Where there is no better sentence than the status itself.
stairwell_status refuse(stairwell_status status, char* message, std::size_t size) noexcept {
    tell(message, size, stairwell_status_text(status));
    return status;
}

/// Runs what may throw; every exception becomes a status.
template <typename Body>
stairwell_status guarded(char* message, std::size_t size, Body body) noexcept {
    tell(message, size, "");
    try {
        return body();
    } catch (const std::invalid_argument& problem) {
        tell(message, size, problem.what());
        return STAIRWELL_BAD_VALUE;
    } catch (...) {  // bad_alloc and length_error: there is nothing else to run out of
        return refuse(STAIRWELL_NO_MEMORY, message, size);
    }
}

/// A word of C++ from a number of C; one that is none becomes one that validate() refuses.
template <typename Word>
Word word(std::int32_t number) noexcept {
    return static_cast<Word>(number < 0 || number > 254 ? 255 : number);
}

stairwell_slope toC(const rc::Slope& s) noexcept {
    return {.struct_size = sizeof(stairwell_slope),
            .major = s.major,
            .c = s.c,
            .criterion = s.criterion,
            .beta = s.beta,
            .c90 = s.c90,
            .contrast_exponent = s.contrastExponent,
            .task = static_cast<std::int32_t>(s.task),
            .encoding = static_cast<std::int32_t>(s.encoding),
            .kernel = static_cast<std::int32_t>(s.kernel),
            .reserved = 0};
}

rc::Slope fromC(const stairwell_slope& s) noexcept {
    return {.c = s.c,
            .criterion = s.criterion,
            .task = word<rc::Task>(s.task),
            .encoding = word<rc::Encoding>(s.encoding),
            .beta = s.beta,
            .c90 = s.c90,
            .contrastExponent = s.contrast_exponent,
            .kernel = word<rc::Kernel>(s.kernel),
            .major = s.major};
}

rc::Settings fromC(const stairwell_settings& s) noexcept {
    return {.slope = fromC(s.slope),
            .minSize = s.min_size,
            .maxSize = s.max_size,
            .driverMaxSize = s.driver_max_size,
            .levelRatio = word<rc::LevelRatio>(s.level_ratio),
            .percentile = s.percentile,
            .lowerAfterFrames = s.lower_after_frames,
            .lowerBelowPercent = s.lower_below_percent,
            .startSize = s.start_size,
            .textureSize = s.texture_size,
            .crossFadeFrames = s.cross_fade_frames,
            .pixelBound = s.pixel_bound,
            .texelsPerCaster = s.texels_per_caster,
            .budgetPerTexel = s.budget_per_texel};
}

bool hasItsSize(const stairwell_settings& s) noexcept {
    return s.struct_size == sizeof s && s.slope.struct_size == sizeof s.slope;
}

bool reservesNothing(const stairwell_settings& s) noexcept {
    return s.reserved == 0 && s.slope.reserved == 0;
}

/// Of what only stairwell_settings_init may write; `whose` begins the message.
stairwell_status check(const stairwell_settings& s, const std::string& whose, char* message,
                       std::size_t size) {
    if (!hasItsSize(s)) return refuse(STAIRWELL_BAD_STRUCT_SIZE, message, size);
    if (reservesNothing(s)) return STAIRWELL_OK;
    const bool own = s.reserved != 0;
    tell(message, size,
         whose + rc::sentence(own ? "reserved" : "slope.reserved",
                              own ? s.reserved : s.slope.reserved, "must be 0"));
    return STAIRWELL_BAD_VALUE;
}

rc::DemandHistogram fromC(const stairwell_histogram& histogram) noexcept {
    return std::bit_cast<rc::DemandHistogram>(histogram);
}

/// Whether it is as stairwell_recent_init left it, as far as can be seen: what is not must not lead
/// the writing elsewhere.
stairwell_status check(const stairwell_recent& recent) noexcept {
    if (recent.struct_size != sizeof recent) return STAIRWELL_BAD_STRUCT_SIZE;
    const bool inside = recent.frames >= 1 && recent.frames <= STAIRWELL_MOST_RECENT &&
                        recent.next >= 0 && recent.next < recent.frames && recent.reserved == 0;
    return inside ? STAIRWELL_OK : STAIRWELL_BAD_VALUE;
}

/// `histogram` is where the light's histogram is kept during the call.
rc::LightData fromC(const stairwell_light& light, rc::DemandHistogram& histogram) noexcept {
    rc::LightData data{.kind = static_cast<rc::LightData::Kind>(light.kind),
                       .radiusUv = light.radius_uv,
                       .histogram = nullptr,
                       .frame = {.cameraCut = light.camera_cut != 0,
                                 .dataAgeFrames = light.data_age_frames,
                                 .contrast = light.contrast,
                                 .footprintUv = light.footprint_uv,
                                 .detailTexels = light.detail_texels,
                                 .largestRadiusUv = light.largest_radius_uv}};
    if (light.budget_size != 0) data.frame.budgetSize = light.budget_size;
    if (light.kind == STAIRWELL_HISTOGRAM && light.histogram) {
        histogram = fromC(*light.histogram);
        data.histogram = &histogram;
    }
    return data;
}

stairwell_decision toC(const rc::Decision& d) noexcept {
    return {.size = d.size,
            .previous_size = d.previousSize,
            .changed = d.changed,
            .reason = static_cast<std::int32_t>(d.reason),
            .need = d.need,
            .fade_from_size = d.fadeFromSize,
            .fade_weight = d.fadeWeight,
            .artifact_ratio = d.artifactRatio,
            .share_above = d.shareAbove,
            .min_radius_uv = d.minRadiusUv,
            .viewport = d.map.viewport,
            .cleared = d.map.cleared,
            .kernel_reach_texels = d.map.kernelReachTexels,
            .reserved = 0,
            .texture_scale = d.map.textureScale,
            .texel_uv = d.map.texelUv,
            .radius_uv = d.map.radiusUv,
            .radius_texels = d.map.radiusTexels,
            .plane_bias_uv = d.map.planeBiasUv,
            .normal_offset_uv = d.map.normalOffsetUv};
}

stairwell_status check(const stairwell_light* data, std::size_t count) noexcept {
    for (std::size_t i = 0; i < count; ++i) {
        if (data[i].struct_size != sizeof(stairwell_light)) return STAIRWELL_BAD_STRUCT_SIZE;
        if (data[i].kind < STAIRWELL_NO_DATA || data[i].kind > STAIRWELL_OFF ||
            data[i].camera_cut < 0 || data[i].camera_cut > 1) {
            return STAIRWELL_BAD_VALUE;
        }
    }
    return STAIRWELL_OK;
}

}  // namespace

uint32_t stairwell_abi(void) noexcept {
    return STAIRWELL_ABI;
}

const char* stairwell_status_text(int32_t status) noexcept {
    switch (status) {
        case STAIRWELL_OK:
            return "all well";
        case STAIRWELL_NULL_ARGUMENT:
            return "a pointer that must not be NULL is NULL";
        case STAIRWELL_BAD_STRUCT_SIZE:
            return "a struct was not initialised, or is of another version of the library";
        case STAIRWELL_BAD_VALUE:
            return "a value is outside its range";
        case STAIRWELL_BAD_COUNT:
            return "the number of entries is not that of the lights, or above 4096";
        case STAIRWELL_BAD_INDEX:
            return "there is no such light";
        case STAIRWELL_NO_MEMORY:
            return "out of memory";
        case STAIRWELL_BUFFER_TOO_SMALL:
            return "the buffer is too small";
        case STAIRWELL_BAD_TRACE:
            return "the trace cannot be read";
        case STAIRWELL_TRACE_DIFFERS:
            return "the decisions differ from the recorded ones";
        default:
            return "unknown";
    }
}

const char* stairwell_reason_text(int32_t reason) noexcept {
    return rc::text(word<rc::Reason>(reason));
}

const char* stairwell_warning_text(uint32_t warning) noexcept {
    return rc::text(static_cast<rc::Warning>(warning));
}

stairwell_status stairwell_slope_init(stairwell_slope* slope, size_t size) noexcept {
    if (!slope) return STAIRWELL_NULL_ARGUMENT;
    if (size != sizeof *slope) return STAIRWELL_BAD_STRUCT_SIZE;
    *slope = toC(rc::Slope{});
    return STAIRWELL_OK;
}

stairwell_status stairwell_slope_for(const stairwell_slope* measured, double detection,
                                     double people, int32_t encoding, int32_t kernel,
                                     stairwell_slope* asked, uint32_t* warnings) noexcept {
    if (!measured || !asked) return STAIRWELL_NULL_ARGUMENT;
    if (measured->struct_size != sizeof *measured) return STAIRWELL_BAD_STRUCT_SIZE;
    if (measured->reserved != 0) return STAIRWELL_BAD_VALUE;
    if (encoding < 0 || encoding > STAIRWELL_ENCODING_UNKNOWN || kernel < 0 ||
        kernel > STAIRWELL_KERNEL_UNKNOWN) {
        return STAIRWELL_BAD_VALUE;
    }
    return guarded(nullptr, 0, [&] {
        const rc::AudienceSlope result =
            rc::slopeFor(fromC(*measured), {.detection = detection, .people = people},
                         {word<rc::Encoding>(encoding), word<rc::Kernel>(kernel)});
        *asked = toC(result.slope);
        if (warnings) *warnings = result.warnings;
        return STAIRWELL_OK;
    });
}

stairwell_status stairwell_settings_init(stairwell_settings* settings, size_t size) noexcept {
    if (!settings) return STAIRWELL_NULL_ARGUMENT;
    if (size != sizeof *settings) return STAIRWELL_BAD_STRUCT_SIZE;
    const rc::Settings s;
    *settings = {.struct_size = sizeof *settings,
                 .min_size = s.minSize,
                 .max_size = s.maxSize,
                 .driver_max_size = s.driverMaxSize,
                 .level_ratio = static_cast<std::int32_t>(s.levelRatio),
                 .lower_after_frames = s.lowerAfterFrames,
                 .lower_below_percent = s.lowerBelowPercent,
                 .start_size = s.startSize,
                 .texture_size = s.textureSize,
                 .cross_fade_frames = s.crossFadeFrames,
                 .budget_per_texel = s.budgetPerTexel,
                 .pixel_bound = s.pixelBound,
                 .texels_per_caster = s.texelsPerCaster,
                 .reserved = 0,
                 .percentile = s.percentile,
                 .slope = toC(s.slope)};
    return STAIRWELL_OK;
}

float stairwell_pixel_footprint(float dudx, float dvdx, float dudy, float dvdy) noexcept {
    return rc::pixelFootprint({dudx, dvdx, dudy, dvdy});
}

float stairwell_demand(const stairwell_settings* settings, float radius_uv, float footprint,
                       float contrast, float caster_width_uv) noexcept {
    if (!settings || !hasItsSize(*settings) || !reservesNothing(*settings)) return 0;
    return rc::demand(rc::demandRule(fromC(*settings)), {.radiusUv = radius_uv,
                                                         .footprint = footprint,
                                                         .contrast = contrast,
                                                         .casterWidthUv = caster_width_uv});
}

uint32_t stairwell_demand_weight(float shown_radius_uv, float footprint) noexcept {
    return rc::demandWeight(shown_radius_uv, footprint);
}

stairwell_status stairwell_histogram_add(stairwell_histogram* histogram, float demanded_texels,
                                         uint32_t weight) noexcept {
    if (!histogram) return STAIRWELL_NULL_ARGUMENT;
    const int bin = rc::DemandHistogram::binOf(demanded_texels);
    (bin < 0 ? histogram->rejected : histogram->counts[bin]) += weight;
    return STAIRWELL_OK;
}

stairwell_status stairwell_recent_init(stairwell_recent* recent, size_t size,
                                       int32_t frames) noexcept {
    if (!recent) return STAIRWELL_NULL_ARGUMENT;
    if (size != sizeof *recent) return STAIRWELL_BAD_STRUCT_SIZE;
    if (frames < 1 || frames > STAIRWELL_MOST_RECENT) return STAIRWELL_BAD_VALUE;
    std::memset(recent, 0, sizeof *recent);
    recent->struct_size = sizeof *recent;
    recent->frames = frames;
    return STAIRWELL_OK;
}

stairwell_status stairwell_recent_add(stairwell_recent* recent,
                                      const stairwell_histogram* newest) noexcept {
    if (!recent || !newest) return STAIRWELL_NULL_ARGUMENT;
    if (const stairwell_status bad = check(*recent)) return bad;
    stairwell_histogram& oldest = recent->last[recent->next];
    const stairwell_histogram added = *newest;  // which may be the sum itself
    rc::DemandHistogram sum = fromC(recent->sum);
    sum += fromC(added);
    sum -= fromC(oldest);
    recent->sum = std::bit_cast<stairwell_histogram>(sum);
    oldest = added;
    recent->next = (recent->next + 1) % recent->frames;
    return STAIRWELL_OK;
}

stairwell_status stairwell_recent_clear(stairwell_recent* recent) noexcept {
    if (!recent) return STAIRWELL_NULL_ARGUMENT;
    if (const stairwell_status bad = check(*recent)) return bad;
    return stairwell_recent_init(recent, sizeof *recent, recent->frames);
}

stairwell_status stairwell_light_init(stairwell_light* light, size_t size) noexcept {
    if (!light) return STAIRWELL_NULL_ARGUMENT;
    if (size != sizeof *light) return STAIRWELL_BAD_STRUCT_SIZE;
    *light = {};
    light->struct_size = sizeof *light;
    light->contrast = 1;
    return STAIRWELL_OK;
}

stairwell_status stairwell_create(const stairwell_settings* settings, size_t count,
                                  stairwell_lights** lights, char* message,
                                  size_t message_size) noexcept {
    if (!lights || (!settings && count > 0))
        return refuse(STAIRWELL_NULL_ARGUMENT, message, message_size);
    if (count > rc::kMostLights) return refuse(STAIRWELL_BAD_COUNT, message, message_size);
    return guarded(message, message_size, [&] {
        for (std::size_t i = 0; i < count; ++i) {
            const std::string whose = "light " + std::to_string(i) + ": ";
            const stairwell_status bad = check(settings[i], whose, message, message_size);
            if (bad) return bad;
        }
        std::vector<rc::Settings> each(count);
        for (std::size_t i = 0; i < count; ++i) each[i] = fromC(settings[i]);
        *lights = std::make_unique<stairwell_lights>(each).release();
        return STAIRWELL_OK;
    });
}

void stairwell_destroy(stairwell_lights* lights) noexcept {
    delete lights;
}

stairwell_status stairwell_update(stairwell_lights* lights, const stairwell_light* data,
                                  size_t count, const int64_t* budget,
                                  stairwell_decision* decisions, size_t decision_size,
                                  stairwell_summary* summary) noexcept {
    if (!lights || (count > 0 && (!data || !decisions))) return STAIRWELL_NULL_ARGUMENT;
    if (count != lights->lights.count()) return STAIRWELL_BAD_COUNT;
    if (decision_size != sizeof(stairwell_decision)) return STAIRWELL_BAD_STRUCT_SIZE;
    if (const stairwell_status bad = check(data, count)) return bad;
    for (std::size_t i = 0; i < count; ++i) {
        lights->data[i] = fromC(data[i], lights->histograms[i]);
    }
    rc::Budget shared;
    if (budget) shared.texels = *budget;
    const rc::LightSummary s = lights->lights.update(lights->data, lights->decisions, shared);
    if (lights->trace) lights->trace->frame(lights->data, shared, lights->decisions);
    for (std::size_t i = 0; i < count; ++i) decisions[i] = toC(lights->decisions[i]);
    if (summary) {
        *summary = {.feasible = s.budget.feasible,
                    .changes = s.changes,
                    .wanted = s.budget.wanted,
                    .used = s.budget.used,
                    .worst_light = s.worstLight,
                    .worst_artifact_ratio = s.worstArtifactRatio};
    }
    return STAIRWELL_OK;
}

stairwell_status stairwell_reconfigure(stairwell_lights* lights, size_t light,
                                       const stairwell_settings* settings, char* message,
                                       size_t message_size) noexcept {
    if (!lights || !settings) return refuse(STAIRWELL_NULL_ARGUMENT, message, message_size);
    if (light >= lights->lights.count()) return refuse(STAIRWELL_BAD_INDEX, message, message_size);
    return guarded(message, message_size, [&] {
        const stairwell_status bad = check(*settings, "", message, message_size);
        if (bad) return bad;
        const rc::Settings asked = fromC(*settings);
        const std::string problem = lights->lights.reconfigure(light, asked);
        if (lights->trace) lights->trace->reconfigured(light, asked);
        if (problem.empty()) return STAIRWELL_OK;
        tell(message, message_size, problem);
        return STAIRWELL_BAD_VALUE;
    });
}

stairwell_status stairwell_trace_start(stairwell_lights* lights, void* buffer,
                                       size_t buffer_size) noexcept {
    if (!lights || !buffer) return STAIRWELL_NULL_ARGUMENT;
    rc::TraceWriter trace(std::span(static_cast<std::byte*>(buffer), buffer_size));
    lights->trace.reset();
    if (!trace.begin(lights->lights)) return STAIRWELL_BUFFER_TOO_SMALL;
    lights->trace = trace;
    return STAIRWELL_OK;
}

stairwell_status stairwell_trace_stop(stairwell_lights* lights, size_t* bytes,
                                      uint64_t* lost) noexcept {
    if (!lights) return STAIRWELL_NULL_ARGUMENT;
    if (bytes) *bytes = lights->trace ? lights->trace->bytes().size() : 0;
    if (lost) *lost = lights->trace ? lights->trace->lost() : 0;
    lights->trace.reset();
    return STAIRWELL_OK;
}

stairwell_status stairwell_trace_replay(const void* trace, size_t trace_size, uint64_t* frames,
                                        char* message, size_t message_size) noexcept {
    if (!trace) return refuse(STAIRWELL_NULL_ARGUMENT, message, message_size);
    return guarded(message, message_size, [&] {
        const rc::ReplayReport report =
            rc::replay(std::span(static_cast<const std::byte*>(trace), trace_size));
        if (frames) *frames = report.frames;
        if (report.same) return STAIRWELL_OK;
        tell(message, message_size, report.problem);
        return report.differences > 0 ? STAIRWELL_TRACE_DIFFERS : STAIRWELL_BAD_TRACE;
    });
}

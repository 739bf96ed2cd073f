// SPDX-License-Identifier: MIT
#include "demo/loaded_slope.h"

#include <CLI/CLI.hpp>
#include <stdexcept>

#include "records/slope_file.h"

namespace demo {
namespace {

namespace rc = resolution_controller;

// Shadows here are filtered in light, with a disc.
constexpr rc::RendererTraits kTraits{.encoding = rc::Encoding::srgb, .kernel = rc::Kernel::disc};

rc::Encoding toController(const std::optional<records::Encoding>& encoding) {
    if (!encoding) return rc::Encoding::unknown;
    return *encoding == records::Encoding::srgb ? rc::Encoding::srgb : rc::Encoding::code;
}

rc::Kernel kernelOf(const std::string& name) {
    if (name == "disc") return rc::Kernel::disc;
    if (name == "box") return rc::Kernel::box;
    if (name == "gaussian") return rc::Kernel::gaussian;
    if (name.starts_with("poisson")) return rc::Kernel::sampled;
    return rc::Kernel::unknown;
}

rc::Slope toController(const records::Slope& slope) {
    return {.c = slope.c.estimate,
            .criterion = slope.criterion,
            .task = slope.task == records::Task::twoAfc ? rc::Task::twoAfc : rc::Task::yesNo,
            .encoding = toController(slope.encoding),
            .beta = slope.beta,
            .c90 = slope.c90.estimate,
            .contrastExponent = slope.contrastExponent ? slope.contrastExponent->estimate : 0,
            .kernel = kernelOf(slope.kernel)};
}

}  // namespace

void addSlopeOptions(CLI::App& app, SlopeOptions& options) {
    app.add_option("--slope", options.file,
                   "slope.json of a study; default: the published c = 3.47");
    app.add_option("--detection", options.detection,
                   "how often a stair-step may be detected by who looks for it; default: as the "
                   "slope was measured")
        ->check(CLI::Range(1e-6, 1 - 1e-6, "PROBABILITY"));
    app.add_option("--people", options.people,
                   "share of people of whom that holds; default: 0.5, the mean observer")
        ->check(CLI::Range(0.01, 0.99, "SHARE"));
}

LoadedSlope loadSlope(const SlopeOptions& options) {
    rc::Audience audience;
    audience.detection = options.detection.value_or(audience.detection);
    audience.people = options.people.value_or(audience.people);
    return loadSlope(options.file, audience);
}

LoadedSlope loadSlope(const std::optional<std::filesystem::path>& file,
                      const rc::Audience& audience) {
    LoadedSlope loaded;
    rc::Slope measured;
    if (file) {
        const records::Slope slope = records::readSlope(*file);
        measured = toController(slope);
        loaded.text = records::describe(slope);
        loaded.file = file->string();
    } else {
        loaded.text = rc::describe(measured) + ", as published; no slope file was given";
    }
    const rc::AudienceSlope chosen = rc::slopeFor(measured, audience, kTraits);
    loaded.slope = chosen.slope;
    if (audience != rc::kAsMeasured)
        loaded.text += "; used here: " + rc::describe(chosen.slope) + ", " + rc::describe(audience);
    for (std::uint32_t bit = 1; bit <= rc::kAllWarnings; bit *= 2)
        if ((chosen.warnings & bit) != 0) loaded.notes.push_back(rc::text(rc::Warning(bit)));
    return loaded;
}

}  // namespace demo

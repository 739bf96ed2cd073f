// SPDX-License-Identifier: MIT
#include "records/screen_luminance.h"

#include <array>
#include <nlohmann/json.hpp>

#include "records/quoted_text.h"

namespace records {
namespace {

/// Beyond every screen: the sky at noon is a tenth of it.
constexpr double kBrightest = 100000;

struct Reading {
    const char* field;
    std::optional<double> ScreenLuminance::*value;
    NumberRule rule;
};

/// From dark to bright. White keeps the name that it had when it stood alone.
constexpr std::array kReadings{
    Reading{"luminance_black_cd_m2", &ScreenLuminance::black, between(0, kBrightest)},
    Reading{"luminance_grey_cd_m2",
            &ScreenLuminance::grey,
            {.low = 0, .high = kBrightest, .lowIncluded = false}},
    Reading{"luminance_cd_m2",
            &ScreenLuminance::white,
            {.low = 0, .high = kBrightest, .lowIncluded = false}}};

struct Broken {
    const Reading& reading;
    std::string rule;
};
std::optional<Broken> firstBroken(const ScreenLuminance& luminance) {
    const Reading* darker = nullptr;
    for (const Reading& reading : kReadings) {
        const auto& value = luminance.*reading.value;
        if (!value) continue;
        if (!reading.rule.holds(*value)) return Broken{reading, reading.rule.text()};
        if (darker != nullptr && *value <= *(luminance.*darker->value)) {
            return Broken{reading, std::string("must be greater than ") + darker->field + ", " +
                                       exactText(*(luminance.*darker->value))};
        }
        darker = &reading;
    }
    return {};
}

}  // namespace

std::string validate(const ScreenLuminance& luminance) {
    const auto broken = firstBroken(luminance);
    if (!broken) return {};
    return std::string(broken->reading.field) + ": " +
           exactText(*(luminance.*broken->reading.value)) + ": " + broken->rule;
}

void addLuminance(nlohmann::ordered_json& object, const ScreenLuminance& luminance) {
    for (const Reading& reading : kReadings) {
        const auto& value = luminance.*reading.value;
        object[reading.field] =
            value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
    }
}

ScreenLuminance luminanceFrom(const JsonFields& fields) {
    ScreenLuminance luminance;
    for (const Reading& reading : kReadings) {
        luminance.*reading.value = fields.optionalNumber(reading.field, reading.rule);
    }
    if (const auto broken = firstBroken(luminance)) {
        fields.fail(broken->reading.field, broken->rule);
    }
    return luminance;
}

}  // namespace records

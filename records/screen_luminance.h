// SPDX-License-Identifier: MIT
// What a photometer read off a screen, as displays.json and every session's sidecar hold it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "records/json_fields.h"

namespace records {

/// The grey that is measured, code value: a gamma follows from it that owes nothing to the eye.
inline constexpr int kMeasuredGreyCode = 128;

/// cd/m2, of full areas of codes 0, kMeasuredGreyCode and 255; each may be unknown. Black may be 0.
struct ScreenLuminance {
    std::optional<double> black = {}, grey = {}, white = {};
    bool operator==(const ScreenLuminance&) const = default;
};

/// Empty when usable: every number is one that a screen can have, and they rise from black to
/// white. Else "<field>: <value>: <rule>".
std::string validate(const ScreenLuminance& luminance);

/// Fields luminance_black_cd_m2, luminance_grey_cd_m2 and luminance_cd_m2 (white); null: unknown.
void addLuminance(nlohmann::ordered_json& object, const ScreenLuminance& luminance);
/// Throws std::runtime_error with file, field, value and rule. Absent fields are unknown.
ScreenLuminance luminanceFrom(const JsonFields& fields);

}  // namespace records

// SPDX-License-Identifier: MIT
// JSON files as a whole: strict parsing with located errors, and writing whole or not at all.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace records {

class JsonFields;

/// Parses JSON text. `file` names it in errors. Throws std::runtime_error: a syntax error with line
/// and column, a key that an object holds twice, nesting deeper than 64, a number beyond double.
nlohmann::json parseJson(std::string_view text, const std::string& file);

/// parseJson on the content of a file.
nlohmann::json readJson(const std::filesystem::path& file);

/// Writes with two spaces of indent, whole or not at all. Throws std::runtime_error where it
/// cannot, and std::invalid_argument for a number that is not finite (JSON has none; it would
/// become null in silence).
void writeJson(const std::filesystem::path& file, const nlohmann::ordered_json& json);

/// The field `schema` with which our JSON files say what they are:
/// {"name": "stairwell slope", "major": 1, "minor": 0}. A reader knows one major; a higher minor
/// only adds fields.
nlohmann::ordered_json schemaJson(const std::string& name, int major, int minor);
/// Throws std::runtime_error unless the file is of that name and major.
void checkSchema(const JsonFields& fields, const std::string& name, int major);

}  // namespace records

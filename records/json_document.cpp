// SPDX-License-Identifier: MIT
#include "records/json_document.h"

#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <vector>

#include "records/json_fields.h"
#include "records/quoted_text.h"
#include "records/whole_file.h"

namespace records {

namespace {

using nlohmann::json;

// Deep nesting has no use here, and copying or comparing it would recurse as deep.
constexpr int kDeepest = 64;

// "line 3, column 7" of the byte after `count` bytes.
std::string position(std::string_view text, std::size_t count) {
    std::size_t line = 1, column = 1;
    for (const char character : text.substr(0, count)) {
        ++column;
        if (character == '\n') ++line, column = 1;
    }
    return "line " + std::to_string(line) + ", column " + std::to_string(column);
}

// The library's own sentence without the prefix that names its exception and its count of the
// position.
std::string reason(const std::string& what) {
    const std::string marks[] = {"syntax error", "attempting to parse", "number overflow"};
    for (const std::string& mark : marks)
        if (const auto at = what.find(mark); at != std::string::npos) return what.substr(at);
    return what;
}

// Refuses during parsing what the finished value would hide (a key written twice) or could not
// survive.
class Guard {
  public:
    explicit Guard(const std::string& file) : file_(file) {}

    bool operator()(int depth, json::parse_event_t event, const json& parsed) {
        if (depth > kDeepest)
            throw std::runtime_error(file_ + ": nested deeper than " + std::to_string(kDeepest));
        if (event == json::parse_event_t::object_start) keys_.emplace_back();
        if (event == json::parse_event_t::object_end) keys_.pop_back();
        if (event == json::parse_event_t::key &&
            !keys_.back().insert(parsed.get_ref<const std::string&>()).second)
            throw std::runtime_error(file_ + ": field " +
                                     quotedText(parsed.get_ref<const std::string&>()) +
                                     ": stands twice in one object");
        return true;
    }

  private:
    const std::string& file_;
    std::vector<std::set<std::string>> keys_;
};

void requireFinite(const nlohmann::ordered_json& value, const std::filesystem::path& file,
                   const std::string& path) {
    if (value.is_number_float() && !std::isfinite(value.get<double>()))
        throw std::invalid_argument(file.string() + ": field " + path + ": " +
                                    exactText(value.get<double>()) + ": must be a finite number");
    if (value.is_object())
        for (const auto& [key, item] : value.items())
            requireFinite(item, file, path.empty() ? key : path + "." + key);
    if (value.is_array())
        for (std::size_t i = 0; i < value.size(); ++i)
            requireFinite(value[i], file, path + "[" + std::to_string(i) + "]");
}

}  // namespace

json parseJson(std::string_view text, const std::string& file) {
    try {
        return json::parse(text, Guard(file));
    } catch (const json::parse_error& error) {
        const std::size_t before = error.byte > 0 ? error.byte - 1 : 0;
        throw std::runtime_error(file + ": " + position(text, before) + ": " +
                                 reason(error.what()));
    } catch (const json::exception& error) {
        throw std::runtime_error(file + ": " + reason(error.what()));
    }
}

json readJson(const std::filesystem::path& file) {
    return parseJson(readWholeFile(file), file.string());
}

void writeJson(const std::filesystem::path& file, const nlohmann::ordered_json& value) {
    requireFinite(value, file, "");
    // Texts from outside (a path in the command line) may hold bytes that are not UTF-8.
    writeWholeFile(file, value.dump(2, ' ', false, json::error_handler_t::replace) + "\n");
}

nlohmann::ordered_json schemaJson(const std::string& name, int major, int minor) {
    return {{"name", name}, {"major", major}, {"minor", minor}};
}

void checkSchema(const JsonFields& fields, const std::string& name, int major) {
    const JsonFields schema = fields.object("schema");
    if (schema.text("name") != name) schema.fail("name", "must be " + quotedText(name));
    if (schema.integer("major", 0) != major)
        schema.fail("major", "this program reads major version " + std::to_string(major));
    schema.integer("minor", 0);
}

}  // namespace records

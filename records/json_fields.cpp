// SPDX-License-Identifier: MIT
#include "records/json_fields.h"

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "records/quoted_text.h"

namespace records {

namespace {

using nlohmann::json;

std::string shown(const json& value) {
    if (value.is_object()) return "an object";
    if (value.is_array()) return "an array";
    if (value.is_string()) return quotedText(value.get_ref<const std::string&>());
    return value.dump();
}

std::string joined(std::span<const std::string_view> words) {
    std::string list;
    for (const std::string_view word : words) {
        if (!list.empty()) list += ", ";
        list += word;
    }
    return list;
}

[[noreturn]] void failAt(const std::string& file, const std::string& path, const json& value,
                         const std::string& rule) {
    throw std::runtime_error(file + ": field " + path + ": " + shown(value) + ": " + rule);
}

std::string element(const std::string& path, std::size_t i) {
    return path + "[" + std::to_string(i) + "]";
}

}  // namespace

JsonFields::JsonFields(const json& value, std::string file, std::string path)
    : json_(&value),
      file_(std::move(file)),
      path_(std::move(path)),
      asked_(std::make_shared<std::set<std::string>>()) {
    if (value.is_object()) return;
    const std::string place = path_.empty() ? file_ : file_ + ": field " + path_;
    throw std::runtime_error(place + ": " + shown(value) + ": must be an object");
}

std::string JsonFields::pathTo(const std::string& key) const {
    return path_.empty() ? key : path_ + "." + key;
}

std::string JsonFields::where(const std::string& key) const {
    return file_ + ": field " + pathTo(key);
}

void JsonFields::fail(const std::string& key, const std::string& rule) const {
    const json* value = find(key);
    throw std::runtime_error(where(key) + ": " + (value ? shown(*value) : "missing") + ": " + rule);
}

const json* JsonFields::find(const std::string& key) const {
    asked_->insert(key);
    const auto found = json_->find(key);
    return found == json_->end() ? nullptr : &*found;
}

const json& JsonFields::required(const std::string& key) const {
    const json* value = find(key);
    if (value == nullptr) throw std::runtime_error(where(key) + ": is missing");
    return *value;
}

bool JsonFields::has(const std::string& key) const {
    const json* value = find(key);
    return value != nullptr && !value->is_null();
}

double JsonFields::number(const std::string& key, const NumberRule& rule) const {
    const json& value = required(key);
    if (!value.is_number() || !rule.holds(value.get<double>())) fail(key, rule.text());
    return value.get<double>();
}

int JsonFields::integer(const std::string& key, int low, int high) const {
    const NumberRule rule = between(low, high);
    const json& value = required(key);
    if (!value.is_number_integer() || !rule.holds(value.get<double>()))
        fail(key, rule.text("whole number"));
    return value.get<int>();
}

std::uint64_t JsonFields::unsignedInteger(const std::string& key) const {
    const json& value = required(key);
    if (!value.is_number_unsigned()) fail(key, "must be a whole number from 0 to 2^64 - 1");
    return value.get<std::uint64_t>();
}

bool JsonFields::boolean(const std::string& key) const {
    const json& value = required(key);
    if (!value.is_boolean()) fail(key, "must be true or false");
    return value.get<bool>();
}

std::string JsonFields::text(const std::string& key) const {
    const json& value = required(key);
    if (!value.is_string() || value.get_ref<const std::string&>().empty())
        fail(key, "must be a text that is not empty");
    return value.get<std::string>();
}

std::vector<double> JsonFields::numbers(const std::string& key, const NumberRule& rule) const {
    std::vector<double> result;
    if (!required(key).is_array()) fail(key, "must be an array of numbers");
    for (const json& item : required(key)) {
        if (!item.is_number() || !rule.holds(item.get<double>()))
            failAt(file_, element(pathTo(key), result.size()), item, rule.text());
        result.push_back(item.get<double>());
    }
    return result;
}

std::vector<std::string> JsonFields::texts(const std::string& key) const {
    std::vector<std::string> result;
    if (!required(key).is_array()) fail(key, "must be an array of texts");
    for (const json& item : required(key)) {
        if (!item.is_string())
            failAt(file_, element(pathTo(key), result.size()), item, "must be a text");
        result.push_back(item.get<std::string>());
    }
    return result;
}

JsonFields JsonFields::object(const std::string& key) const {
    return {required(key), file_, pathTo(key)};
}

std::vector<JsonFields> JsonFields::objects(const std::string& key) const {
    std::vector<JsonFields> result;
    if (!required(key).is_array()) fail(key, "must be an array of objects");
    for (const json& item : required(key))
        result.emplace_back(item, file_, element(pathTo(key), result.size()));
    return result;
}

const json& JsonFields::any(const std::string& key) const {
    return required(key);
}

std::optional<double> JsonFields::optionalNumber(const std::string& key,
                                                 const NumberRule& rule) const {
    return has(key) ? std::optional(number(key, rule)) : std::nullopt;
}

std::optional<int> JsonFields::optionalInteger(const std::string& key, int low, int high) const {
    return has(key) ? std::optional(integer(key, low, high)) : std::nullopt;
}

std::optional<std::uint64_t> JsonFields::optionalUnsignedInteger(const std::string& key) const {
    return has(key) ? std::optional(unsignedInteger(key)) : std::nullopt;
}

std::optional<bool> JsonFields::optionalBoolean(const std::string& key) const {
    return has(key) ? std::optional(boolean(key)) : std::nullopt;
}

std::optional<std::string> JsonFields::optionalText(const std::string& key) const {
    return has(key) ? std::optional(text(key)) : std::nullopt;
}

std::optional<JsonFields> JsonFields::optionalObject(const std::string& key) const {
    return has(key) ? std::optional(object(key)) : std::nullopt;
}

std::size_t JsonFields::wordIndex(const std::string& key,
                                  std::span<const std::string_view> known) const {
    const json& value = required(key);
    if (value.is_string())
        for (std::size_t i = 0; i < known.size(); ++i)
            if (value.get_ref<const std::string&>() == known[i]) return i;
    fail(key, "must be one of " + joined(known));
}

void JsonFields::noOtherFields() const {
    for (const auto& [key, value] : json_->items())
        if (!asked_->contains(key))
            throw std::runtime_error(
                file_ + ": field " + pathTo(key) + ": is unknown; the fields here are " +
                joined(std::vector<std::string_view>(asked_->begin(), asked_->end())));
}

void requireNoNull(const json& value, const std::string& file, const std::string& path) {
    if (value.is_null()) failAt(file, path, value, "must have a value, or be left out");
    if (!value.is_structured()) return;
    std::size_t i = 0;
    for (const auto& [key, item] : value.items()) {
        const std::string place = path.empty() ? key : path + "." + key;
        requireNoNull(item, file, value.is_array() ? element(path, i++) : place);
    }
}

}  // namespace records

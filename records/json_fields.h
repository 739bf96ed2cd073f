// SPDX-License-Identifier: MIT
// Strict reading of JSON objects. Each getter names a field once, with the rule it must meet;
// anything else is a std::runtime_error that says where: "paper16.json: field quest.beta: -1: must
// be a number greater than 0".
//
//   const nlohmann::json json = records::readJson(file);
//   const records::JsonFields design(json, file.string());
//   const double beta = design.number("beta", records::kPositive);
//   const Task task = design.word("task", records::kTaskWords);
//   for (const auto& condition : design.objects("conditions")) read(condition);
//   design.noOtherFields();          // a misspelt field is an error, not a default
//
// The optional getters return nothing where the field is absent or null. The JSON must outlive the
// view.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "records/number_rule.h"

namespace records {

class JsonFields {
  public:
    /// `path` locates the object in the file: "" for the file's own, "quest", "conditions[3]".
    /// Throws where `json` is no object.
    JsonFields(const nlohmann::json& json, std::string file, std::string path = "");

    bool has(const std::string& key) const;  ///< there, and not null

    double number(const std::string& key, const NumberRule& rule = kFinite) const;
    int integer(const std::string& key, int low = std::numeric_limits<int>::min(),
                int high = std::numeric_limits<int>::max()) const;
    std::uint64_t unsignedInteger(const std::string& key) const;  ///< 0 .. 2^64 - 1 (seeds)
    bool boolean(const std::string& key) const;
    std::string text(const std::string& key) const;  ///< not empty
    std::vector<double> numbers(const std::string& key, const NumberRule& rule = kFinite) const;
    std::vector<std::string> texts(const std::string& key) const;
    JsonFields object(const std::string& key) const;
    std::vector<JsonFields> objects(const std::string& key) const;
    const nlohmann::json& any(const std::string& key) const;  ///< as it is; throws where absent

    std::optional<double> optionalNumber(const std::string& key,
                                         const NumberRule& rule = kFinite) const;
    std::optional<int> optionalInteger(const std::string& key,
                                       int low = std::numeric_limits<int>::min(),
                                       int high = std::numeric_limits<int>::max()) const;
    std::optional<std::uint64_t> optionalUnsignedInteger(const std::string& key) const;
    std::optional<bool> optionalBoolean(const std::string& key) const;
    std::optional<std::string> optionalText(const std::string& key) const;
    std::optional<JsonFields> optionalObject(const std::string& key) const;

    /// One of a list of words, each with the value it stands for.
    template <typename Words>
    auto word(const std::string& key, const Words& words) const {
        std::vector<std::string_view> known;
        for (const auto& [name, value] : words) known.push_back(name);
        return std::begin(words)[wordIndex(key, known)].second;
    }
    template <typename Words>
    auto optionalWord(const std::string& key, const Words& words) const {
        return has(key) ? std::optional(word(key, words))
                        : std::optional<decltype(word(key, words))>();
    }

    /// Throws where the object holds a field that no getter of this view (or a copy of it) asked
    /// for.
    void noOtherFields() const;

    /// "paper16.json: field quest.beta"
    std::string where(const std::string& key) const;
    /// Throws std::runtime_error "<where>: <value>: <rule>", for rules that span fields.
    [[noreturn]] void fail(const std::string& key, const std::string& rule) const;

  private:
    const nlohmann::json* find(const std::string& key) const;
    const nlohmann::json& required(const std::string& key) const;
    std::string pathTo(const std::string& key) const;
    std::size_t wordIndex(const std::string& key, std::span<const std::string_view> known) const;

    const nlohmann::json* json_;
    std::string file_;
    std::string path_;
    std::shared_ptr<std::set<std::string>> asked_;
};

/// For files in which a field that is not given is left out. Throws where a value is null, at any
/// depth: "d.json: field quest.beta: null: must have a value, or be left out".
void requireNoNull(const nlohmann::json& json, const std::string& file,
                   const std::string& path = "");

}  // namespace records

// SPDX-License-Identifier: MIT
#include <cassert>

#include "records/trial_table.h"

namespace records {

namespace {

template <typename Words, typename Value>
std::string_view wordFor(const Words& words, Value value) {
    for (const auto& [word, meaning] : words)
        if (meaning == value) return word;
    assert(!"a value outside its enumeration");
    return "n/a";
}

template <typename Words>
auto valueOf(const Words& words, std::string_view text)
    -> std::optional<decltype(words[0].second)> {
    for (const auto& [word, meaning] : words)
        if (word == text) return meaning;
    return std::nullopt;
}

}  // namespace

std::string_view toText(TrialType value) {
    return wordFor(kTrialTypeWords, value);
}
std::string_view toText(Pattern value) {
    return wordFor(kPatternWords, value);
}
std::string_view toText(Task value) {
    return wordFor(kTaskWords, value);
}
std::string_view toText(Response value) {
    return wordFor(kResponseWords, value);
}
std::string_view toText(TrialStatus value) {
    return wordFor(kTrialStatusWords, value);
}
std::string_view toText(Encoding value) {
    return wordFor(kEncodingWords, value);
}

std::optional<TrialType> trialTypeFromText(std::string_view text) {
    return valueOf(kTrialTypeWords, text);
}
std::optional<Pattern> patternFromText(std::string_view text) {
    return valueOf(kPatternWords, text);
}
std::optional<Task> taskFromText(std::string_view text) {
    return valueOf(kTaskWords, text);
}
std::optional<Response> responseFromText(std::string_view text) {
    return valueOf(kResponseWords, text);
}
std::optional<TrialStatus> trialStatusFromText(std::string_view text) {
    return valueOf(kTrialStatusWords, text);
}
std::optional<Encoding> encodingFromText(std::string_view text) {
    return valueOf(kEncodingWords, text);
}

}  // namespace records

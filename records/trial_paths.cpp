// SPDX-License-Identifier: MIT
#include <algorithm>
#include <stdexcept>
#include <system_error>

#include "records/quoted_text.h"
#include "records/trial_table.h"

namespace records {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kTaskEntity = "task-hideartifact";
constexpr std::string_view kSuffix = "_beh.tsv";

bool isTableName(const std::string& name) {
    return !name.starts_with('.') && name.ends_with(kSuffix) &&
           name.find(kTaskEntity) != std::string::npos;
}

void requireId(const std::string& what, const std::string& id) {
    const auto isIdCharacter = [](char c) {
        return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    };
    if (id.empty() || !std::all_of(id.begin(), id.end(), isIdCharacter))
        throw std::invalid_argument(what + ": " + quotedText(id) +
                                    ": must be letters and digits only, at least one");
}

}  // namespace

std::vector<fs::path> findTrialTables(const fs::path& fileOrFolder) {
    std::error_code error;
    const fs::file_status status = fs::status(fileOrFolder, error);
    if (!fs::exists(status))
        throw std::runtime_error(fileOrFolder.string() + ": cannot be read: " +
                                 (error ? error.message() : "no such file or folder"));
    if (!fs::is_directory(status)) return {fileOrFolder};

    std::vector<fs::path> tables;
    fs::recursive_directory_iterator entry(fileOrFolder, error);
    for (const fs::recursive_directory_iterator end; !error && entry != end;
         entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        if (entry->is_directory() && name.starts_with('.')) entry.disable_recursion_pending();
        if (isTableName(name) && !entry->is_directory()) tables.push_back(entry->path());
    }
    if (error)
        throw std::runtime_error(fileOrFolder.string() +
                                 ": cannot be searched: " + error.message());
    if (tables.empty())
        throw std::runtime_error(fileOrFolder.string() + ": holds no trial table (files named *" +
                                 std::string(kTaskEntity) + "*" + std::string(kSuffix) + ")");
    std::sort(tables.begin(), tables.end());
    return tables;
}

fs::path trialTablePath(const fs::path& dataFolder, const std::string& participant,
                        const std::optional<std::string>& session) {
    requireId("participant", participant);
    if (session) requireId("session", *session);
    const std::string subject = "sub-" + participant;
    return dataFolder / subject / "beh" /
           (subject + (session ? "_ses-" + *session : "") + "_" + std::string(kTaskEntity) +
            std::string(kSuffix));
}

}  // namespace records

// SPDX-License-Identifier: MIT
#include "records/session_sidecar.h"

#include <fcntl.h>
#include <sys/file.h>

#include <algorithm>
#include <cerrno>
#include <stdexcept>

#include "records/file_descriptor.h"
#include "records/json_document.h"
#include "records/json_fields.h"
#include "records/quoted_text.h"
#include "records/trial_columns.h"
#include "records/whole_file.h"

namespace records {

namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr char kSchemaName[] = "stairwell session";
constexpr int kMinor = 1;  // since 1: luminance of black and grey

template <typename T>
ordered_json orNull(const std::optional<T>& value) {
    return value ? ordered_json(*value) : ordered_json(nullptr);
}

ordered_json columnDescription(const TrialColumn& column) {
    ordered_json description = {{"Description", column.description}};
    if (!column.units.empty()) description["Units"] = column.units;
    for (const auto& [word, meaning] : column.levels)
        description["Levels"][std::string(word)] = meaning;
    return description;
}

ordered_json toJson(const SessionSidecar& sidecar) {
    ordered_json ours = {{"schema", schemaJson(kSchemaName, kSidecarMajor, kMinor)},
                         {"context", ordered_json(sidecar.context)},
                         {"participant", sidecar.participant},
                         {"session", orNull(sidecar.session)},
                         {"observer", sidecar.observer},
                         {"seed", sidecar.seed},
                         {"kernel", sidecar.kernel},
                         {"task", toText(sidecar.task)},
                         {"encoding", toText(sidecar.encoding)},
                         {"psychometric_slope", sidecar.beta},
                         {"criterion", sidecar.criterion},
                         {"display_width_px", sidecar.displayWidthPx},
                         {"display_height_px", sidecar.displayHeightPx},
                         {"px_per_deg", orNull(sidecar.pxPerDeg)},
                         {"display_gamma", orNull(sidecar.displayGamma)}};
    addLuminance(ours, sidecar.luminance);
    ours["design"] = ordered_json(sidecar.design);
    ordered_json file = {
        {"TaskName", "hideartifact"},
        {"TaskDescription", "Which filter radius hides the stair-steps of a shadow edge"}};
    for (const TrialColumn& column : trialColumns())
        file[std::string(column.name)] = columnDescription(column);
    file["stairwell"] = std::move(ours);
    return file;
}

SessionSidecar sidecarFrom(const json& value, const std::string& file) {
    const JsonFields fields = JsonFields(value, file).object("stairwell");
    checkSchema(fields, kSchemaName, kSidecarMajor);
    SessionSidecar sidecar;
    sidecar.context = runContextFromJson(fields.any("context"), file, "stairwell.context");
    sidecar.participant = fields.text("participant");
    sidecar.session = fields.optionalText("session");
    sidecar.observer = fields.text("observer");
    sidecar.seed = fields.unsignedInteger("seed");
    sidecar.kernel = fields.text("kernel");
    sidecar.task = fields.word("task", kTaskWords);
    sidecar.encoding = fields.word("encoding", kEncodingWords);
    sidecar.beta = fields.number("psychometric_slope", kPositive);
    sidecar.criterion = fields.number("criterion", kInsideShare);
    sidecar.displayWidthPx = fields.integer("display_width_px", 1);
    sidecar.displayHeightPx = fields.integer("display_height_px", 1);
    sidecar.pxPerDeg = fields.optionalNumber("px_per_deg", kPositive);
    sidecar.displayGamma = fields.optionalNumber("display_gamma", kPositive);
    sidecar.luminance = luminanceFrom(fields);
    fields.object("design");
    sidecar.design = fields.any("design");
    return sidecar;
}

void describeDataSet(const std::filesystem::path& dataFolder) {
    const std::filesystem::path file = dataFolder / "dataset_description.json";
    const ordered_json description = {{"Name", "Filter radius that hides shadow-map stair-steps"},
                                      {"BIDSVersion", "1.8.0"},
                                      {"DatasetType", "raw"}};
    writeWholeFileIfMissing(file, description.dump(2) + "\n");
}

// The table's lines with tabs between the cells; the first names the columns.
std::vector<std::string_view> linesOf(std::string_view text) {
    std::vector<std::string_view> lines;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        std::string_view line = text.substr(0, end);
        if (line.ends_with('\r')) line.remove_suffix(1);
        lines.push_back(line);
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return lines;
}

std::string_view firstCell(std::string_view line) {
    return line.substr(0, line.find('\t'));
}

void addParticipant(const std::filesystem::path& file, const std::string& subject) {
    const FileDescriptor descriptor = openFile(file, O_RDWR | O_CREAT | O_APPEND);
    // The lock serialises programs that register at the same time; it ends with the descriptor.
    if (!descriptor.isOpen() || ::flock(descriptor.get(), LOCK_EX) != 0)
        throwSystemError(file, "cannot be written", errno);
    const std::string text = readAll(descriptor.get(), file);
    std::string addition = text.empty() ? "participant_id\n" : "";
    std::size_t columns = 1;
    if (!text.empty()) {
        const std::vector<std::string_view> lines = linesOf(text);
        std::string_view header = lines.front();
        if (header.starts_with("\xef\xbb\xbf")) header.remove_prefix(3);
        if (firstCell(header) != "participant_id")
            throw std::runtime_error(file.string() + ": line 1: column 1: " +
                                     quotedText(firstCell(header)) + ": must be participant_id");
        for (const std::string_view line : lines)
            if (firstCell(line) == subject) return;
        columns += static_cast<std::size_t>(std::count(header.begin(), header.end(), '\t'));
        if (!text.ends_with('\n')) addition = "\n";
    }
    addition += subject;
    for (std::size_t i = 1; i < columns; ++i) addition += "\tn/a";
    addition += "\n";
    if (writeAll(descriptor.get(), addition) && syncFile(descriptor.get())) return;
    const int error = errno;
    cutFile(descriptor.get(), text.size());
    throwSystemError(file, "cannot be written", error);
}

}  // namespace

std::filesystem::path sidecarPath(const std::filesystem::path& trialTable) {
    return std::filesystem::path(trialTable).replace_extension(".json");
}

void writeSidecar(const std::filesystem::path& file, const SessionSidecar& sidecar) {
    const ordered_json written = toJson(sidecar);
    try {
        sidecarFrom(json(written), file.string());
    } catch (const std::runtime_error& error) {
        throw std::invalid_argument(error.what());
    }
    writeJson(file, written);
}

SessionSidecar parseSidecar(std::string_view text, const std::string& file) {
    return sidecarFrom(parseJson(text, file), file);
}

SessionSidecar readSidecar(const std::filesystem::path& file) {
    return parseSidecar(readWholeFile(file), file.string());
}

void registerParticipant(const std::filesystem::path& dataFolder, const std::string& participant) {
    trialTablePath(dataFolder, participant, std::nullopt);  // checks the id
    createFolders(dataFolder);
    describeDataSet(dataFolder);
    addParticipant(dataFolder / "participants.tsv", "sub-" + participant);
    syncFolder(dataFolder);
}

}  // namespace records

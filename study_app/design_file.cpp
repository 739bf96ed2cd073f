// SPDX-License-Identifier: MIT
#include "study_app/design_file.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "records/json_document.h"
#include "records/json_fields.h"
#include "records/quoted_text.h"
#include "study_app/frame_images.h"

namespace study_app {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;
using records::JsonFields;
namespace fs = std::filesystem;

constexpr const char* kSchemaName = "stairwell design";

constexpr std::pair<std::string_view, records::Pattern> kPatterns[] = {
    {"stair", records::Pattern::stair},
    {"step", records::Pattern::step},
    {"line", records::Pattern::line}};
constexpr std::pair<std::string_view, Orientation> kOrientations[] = {
    {"any", Orientation::any},
    {"horizontal", Orientation::horizontal},
    {"vertical", Orientation::vertical}};

template <typename Words, typename Value>
std::string wordFor(const Words& words, Value value) {
    for (const auto& [word, meaning] : words) {
        if (meaning == value) return std::string(word);
    }
    throw std::logic_error("study_app: a value has no word in the design file");
}

std::vector<int> readSizes(const JsonFields& fields) {
    std::vector<int> sizes;
    const std::vector<double> numbers = fields.numbers("artifact_px", records::between(-1e6, 1e6));
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (numbers[i] != std::floor(numbers[i])) {
            throw std::runtime_error(fields.where("artifact_px[" + std::to_string(i) + "]") + ": " +
                                     records::exactText(numbers[i]) +
                                     ": must be a whole number of pixels");
        }
        sizes.push_back(static_cast<int>(numbers[i]));
    }
    return sizes;
}

/// A pattern is an object, or just its word.
Silhouette readPattern(const json& item, const std::string& file, const std::string& path) {
    if (item.is_string()) {
        return readPattern(json{{"pattern", item}}, file, path);
    }
    const JsonFields fields(item, file, path);
    Silhouette s{.pattern = fields.word("pattern", kPatterns),
                 .angleDeg = fields.optionalNumber("angle_deg"),
                 .orientation =
                     fields.optionalWord("orientation", kOrientations).value_or(Orientation::any)};
    fields.noOtherFields();
    return s;
}

std::vector<Silhouette> readPatterns(const JsonFields& fields, const std::string& file) {
    const json& list = fields.any("patterns");
    if (!list.is_array()) fields.fail("patterns", "must be an array of patterns");
    std::vector<Silhouette> patterns;
    for (std::size_t i = 0; i < list.size(); ++i) {
        patterns.push_back(readPattern(list[i], file, "patterns[" + std::to_string(i) + "]"));
    }
    return patterns;
}

quest::QuestParameters preset(const JsonFields& fields, const std::string& key) {
    std::vector<std::pair<std::string_view, std::size_t>> names;
    for (std::size_t i = 0; i < quest::kPresets.size(); ++i) {
        names.emplace_back(quest::kPresets[i].name, i);
    }
    return quest::kPresets[fields.word(key, names)].parameters;
}

/// Fields that are not given come from the preset; the threshold's probability from its criterion
/// at the gamma and delta of the design.
void readStaircase(const JsonFields& design, Design& d) {
    d.staircase = quest::kDefaultParameters;
    std::optional<JsonFields> q;
    if (design.has("quest") && design.any("quest").is_string()) {
        d.staircase = preset(design, "quest");
    } else if ((q = design.optionalObject("quest")) && q->has("preset")) {
        d.staircase = preset(*q, "preset");
    }
    const quest::QuestParameters asPreset = d.staircase;
    const auto number = [&](const char* key) {
        return q ? q->optionalNumber(key) : std::optional<double>();
    };
    if (d.task == records::Task::yesNo) d.staircase.gamma = kYesNoGamma;
    d.guessRatio = number("guess_ratio").value_or(d.guessRatio);
    d.staircase.priorSd = number("prior_sd").value_or(d.staircase.priorSd);
    d.staircase.beta = number("beta").value_or(d.staircase.beta);
    d.staircase.delta = number("delta").value_or(d.staircase.delta);
    d.staircase.gamma = number("gamma").value_or(d.staircase.gamma);
    d.staircase.grain = number("grain").value_or(d.staircase.grain);
    d.staircase.range = number("range");
    const auto probability = number("threshold_probability");
    if (probability) {
        d.staircase.pThreshold = *probability;
    } else if (d.staircase.gamma != asPreset.gamma || d.staircase.delta != asPreset.delta) {
        d.staircase.pThreshold = quest::thresholdProbability(quest::criterion(asPreset),
                                                             d.staircase.gamma, d.staircase.delta);
    }
    if (q) q->noOtherFields();
}

RadiusLimits readRadius(const JsonFields& design, int windowPx) {
    RadiusLimits limits{.max = std::floor(windowPx / 2.0)};
    if (const auto fields = design.optionalObject("radius_px")) {
        limits.min = fields->optionalNumber("min").value_or(limits.min);
        limits.max = fields->optionalNumber("max").value_or(limits.max);
        limits.step = fields->optionalNumber("step").value_or(limits.step);
        fields->noOtherFields();
    }
    return limits;
}

quest::ScreeningLimits readScreening(const JsonFields& design) {
    quest::ScreeningLimits limits;
    if (const auto fields = design.optionalObject("screening")) {
        limits.falseAlarmRate =
            fields->optionalNumber("false_alarm_rate").value_or(limits.falseAlarmRate);
        limits.catchFailureShare =
            fields->optionalNumber("catch_failure_share").value_or(limits.catchFailureShare);
        fields->noOtherFields();
    }
    return limits;
}

Roving readRoving(const JsonFields& design, Roving roving) {
    if (!design.has("roving")) return roving;
    if (design.any("roving").is_boolean()) {
        const bool on = design.boolean("roving");
        return {.shift = on, .quarterTurn = on, .mirror = on, .tilt = on};
    }
    const JsonFields fields = design.object("roving");
    roving.shift = fields.optionalBoolean("shift").value_or(roving.shift);
    roving.quarterTurn = fields.optionalBoolean("quarter_turn").value_or(roving.quarterTurn);
    roving.mirror = fields.optionalBoolean("mirror").value_or(roving.mirror);
    roving.tilt = fields.optionalBoolean("tilt").value_or(roving.tilt);
    fields.noOtherFields();
    return roving;
}

std::vector<std::string> readOnly(const JsonFields& design) {
    std::vector<std::string> names = design.texts("only_conditions");
    if (names.empty()) design.fail("only_conditions", "must name at least one condition");
    return names;
}

std::map<std::string, std::string> readChecksums(const JsonFields& frames) {
    if (!frames.any("sha256").is_object()) frames.fail("sha256", "must be an object");
    const JsonFields fields = frames.object("sha256");
    std::map<std::string, std::string> sums;
    for (const auto& [name, sum] : frames.any("sha256").items()) sums[name] = fields.text(name);
    return sums;
}

/// A folder, beside the design's file; in a session's sidecar the folder with its list.
FrameSet readFrames(const JsonFields& design, const std::string& file, const fs::path& beside) {
    const json& frames = design.any("frames");
    if (frames.is_object()) {
        const JsonFields fields = design.object("frames");
        FrameSet set{.folder = fields.text("folder"),
                     .pairs = records::framePairsFromJson(frames, file, "frames", "pairs")};
        fields.any("pairs");
        if (fields.has("sha256")) set.sha256 = readChecksums(fields);
        fields.noOtherFields();
        return set;
    }
    const fs::path folder = fs::absolute(beside / design.text("frames")).lexically_normal();
    const std::vector<records::FramePair> pairs = records::readFrameManifest(folder).pairs;
    frameEdgePx(folder, pairs);  // every picture is looked at: no session stops in its middle
    return {.folder = folder, .pairs = pairs, .sha256 = frameChecksums(folder, pairs)};
}

void readFrameDesign(const JsonFields& fields, const std::string& where, const fs::path& beside,
                     Design& d) {
    for (const char* field : {"artifact_px", "patterns", "lit_levels", "kernels", "noise_levels",
                              "dither", "localise", "radius_px"}) {
        if (fields.has(field)) fields.fail(field, "must not stand beside frames");
    }
    d.frames = readFrames(fields, where, beside);
    const auto window = fields.optionalInteger("window_px");
    d.windowPx = fields.any("frames").is_object() && window
                     ? *window
                     : frameEdgePx(d.frames->folder, d.frames->pairs);
    if (window && *window != d.windowPx) {
        fields.fail("window_px", "must be the edge of the frames, " + std::to_string(d.windowPx));
    }
    d.roving = readRoving(fields, {.shift = false, .quarterTurn = false, .tilt = false});
}

void readEdgeDesign(const JsonFields& fields, const std::string& where, Design& d) {
    d.windowPx = fields.optionalInteger("window_px").value_or(d.windowPx);
    d.artifactPx = readSizes(fields);
    d.patterns = readPatterns(fields, where);
    if (fields.has("lit_levels")) d.litLevels = fields.numbers("lit_levels");
    if (fields.has("kernels")) d.kernels = fields.texts("kernels");
    if (fields.has("noise_levels")) d.noiseLevels = fields.numbers("noise_levels");
    d.dither = fields.optionalBoolean("dither").value_or(d.dither);
    d.localise = fields.optionalBoolean("localise").value_or(d.localise);
    d.radius = readRadius(fields, d.windowPx);
    d.roving = readRoving(fields, {});
}

ordered_json patternJson(const Silhouette& s) {
    ordered_json j{{"pattern", records::toText(s.pattern)}};
    if (s.angleDeg) j["angle_deg"] = *s.angleDeg;
    if (s.pattern != records::Pattern::stair) {
        j["orientation"] = wordFor(kOrientations, s.orientation);
    }
    return j;
}

ordered_json edgeJson(const Design& d) {
    ordered_json patterns = ordered_json::array();
    for (const Silhouette& s : d.patterns) patterns.push_back(patternJson(s));
    return {{"artifact_px", d.artifactPx},
            {"patterns", patterns},
            {"lit_levels", d.litLevels},
            {"kernels", d.kernels},
            {"noise_levels", d.noiseLevels},
            {"dither", d.dither},
            {"localise", d.localise},
            {"radius_px", {{"min", d.radius.min}, {"max", d.radius.max}, {"step", d.radius.step}}}};
}

ordered_json staircaseJson(const Design& d) {
    const quest::QuestParameters& q = d.staircase;
    ordered_json j{{"guess_ratio", d.guessRatio},
                   {"prior_sd", q.priorSd},
                   {"threshold_probability", q.pThreshold},
                   {"beta", q.beta},
                   {"delta", q.delta},
                   {"gamma", q.gamma},
                   {"grain", q.grain}};
    if (q.range) j["range"] = *q.range;
    return j;
}

fs::path executableFolder() {
    std::error_code error;
    const fs::path self = fs::read_symlink("/proc/self/exe", error);
    return error ? fs::path() : self.parent_path();
}

}  // namespace

Design designFromJson(const json& value, const std::string& where, const fs::path& beside) {
    const JsonFields fields(value, where);
    records::checkSchema(fields, kSchemaName, kDesignMajor);
    records::requireNoNull(value, where);
    Design d;
    d.name = fields.text("name");
    d.description = fields.optionalText("description").value_or("");
    d.task = fields.optionalWord("task", records::kTaskWords).value_or(d.task);
    d.encoding = fields.optionalWord("encoding", records::kEncodingWords).value_or(d.encoding);
    if (fields.has("frames")) {
        readFrameDesign(fields, where, beside, d);
    } else {
        readEdgeDesign(fields, where, d);
    }
    d.trialsPerCondition = fields.integer("trials_per_condition");
    d.catchShare = fields.optionalNumber("catch_share").value_or(d.catchShare);
    readStaircase(fields, d);
    if (fields.has("presentation")) {
        d.presentation = presentationFromJson(fields.any("presentation"), where, "presentation");
    }
    d.screening = readScreening(fields);
    if (fields.has("only_conditions")) d.onlyConditions = readOnly(fields);
    fields.noOtherFields();
    if (const std::string found = validate(d); !found.empty()) {
        throw std::runtime_error(where + ": field " + found);
    }
    return d;
}

Design readDesign(const fs::path& file) {
    return designFromJson(records::readJson(file), file.string(), file.parent_path());
}

ordered_json normalisedJson(const Design& d) {
    ordered_json text{{"schema", records::schemaJson(kSchemaName, kDesignMajor, 0)},
                      {"name", d.name}};
    if (!d.description.empty()) text["description"] = d.description;
    text.update(ordered_json{{"task", records::toText(d.task)},
                             {"encoding", records::toText(d.encoding)},
                             {"window_px", d.windowPx}});
    if (d.frames) {
        text["frames"] = {{"folder", d.frames->folder.string()},
                          {"pairs", records::toJson(d.frames->pairs)}};
        if (!d.frames->sha256.empty()) text["frames"]["sha256"] = d.frames->sha256;
    } else {
        text.update(edgeJson(d));
    }
    text.update(ordered_json{{"trials_per_condition", d.trialsPerCondition},
                             {"catch_share", d.catchShare},
                             {"quest", staircaseJson(d)},
                             {"roving",
                              {{"shift", d.roving.shift},
                               {"quarter_turn", d.roving.quarterTurn},
                               {"mirror", d.roving.mirror},
                               {"tilt", d.roving.tilt}}},
                             {"presentation", presentationJson(d.presentation)},
                             {"screening",
                              {{"false_alarm_rate", d.screening.falseAlarmRate},
                               {"catch_failure_share", d.screening.catchFailureShare}}}});
    if (!d.onlyConditions.empty()) text["only_conditions"] = d.onlyConditions;
    return text;
}

std::string designDifference(const json& there, const json& here) {
    const auto comparable = [](json design) {
        if (design.is_object()) design.erase("description");
        // Frames may be moved; their list stays.
        if (design.contains("frames")) design["frames"].erase("folder");
        return design.flatten();
    };
    const json a = comparable(there), b = comparable(here);
    const auto shown = [](const json& flat, const std::string& key) {
        return flat.contains(key) ? flat[key].dump() : std::string("absent");
    };
    for (const json* side : {&a, &b}) {
        for (const auto& [key, value] : side->items()) {
            if (shown(a, key) == shown(b, key)) continue;
            std::string field = key.substr(1);
            std::replace(field.begin(), field.end(), '/', '.');
            return field + " is " + shown(a, key) + " there and " + shown(b, key) + " here";
        }
    }
    return {};
}

std::vector<fs::path> designFolders() {
    if (const char* data = std::getenv("STAIRWELL_DATA"); data != nullptr && *data != '\0') {
        return {fs::path(data) / "designs"};
    }
    const fs::path bin = executableFolder();
    return {(bin / "../../../data/designs").lexically_normal(),
            (bin / "../share/stairwell/designs").lexically_normal(), "data/designs"};
}

std::vector<ShippedDesign> shippedDesigns() {
    std::vector<ShippedDesign> found;
    std::string searched;
    for (const fs::path& folder : designFolders()) {
        searched += (searched.empty() ? "" : ", ") + folder.string();
        std::error_code error;
        for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
            const fs::path& file = entry.path();
            const auto sameName = [&](const ShippedDesign& d) { return d.name == file.stem(); };
            if (file.extension() != ".json" || std::ranges::any_of(found, sameName)) continue;
            found.push_back({file, file.stem().string(), readDesign(file).description});
        }
    }
    if (found.empty()) throw std::runtime_error("no designs found (looked in " + searched + ")");
    std::ranges::sort(found, {}, &ShippedDesign::name);
    return found;
}

fs::path findDesign(const std::string& nameOrPath) {
    const fs::path path(nameOrPath);
    std::error_code error;
    if (path.has_parent_path() || path.extension() == ".json" || fs::is_regular_file(path, error)) {
        return path;
    }
    std::string searched;
    for (const fs::path& folder : designFolders()) {
        const fs::path file = folder / (nameOrPath + ".json");
        if (fs::is_regular_file(file, error)) return file;
        searched += (searched.empty() ? "" : ", ") + file.string();
    }
    throw std::runtime_error("--design " + records::quotedText(nameOrPath) +
                             ": no such file, and no shipped design of that name (looked for " +
                             searched + "; --list-designs prints the shipped ones)");
}

}  // namespace study_app

// SPDX-License-Identifier: MIT
#include "records/frame_manifest.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "records/json_document.h"
#include "records/json_fields.h"
#include "records/quoted_text.h"

namespace records {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr const char* kSchemaName = "stairwell frames";
constexpr int kMinor = 0;

std::string plainText(const JsonFields& fields, const std::string& key) {
    const std::string text = fields.text(key);
    if (!isPlainText(text)) fields.fail(key, "must be a text of one line");
    return text;
}

/// A name, not a path: the folder can be moved, and nothing outside it is read.
std::string fileName(const JsonFields& fields, const std::string& key) {
    const std::string name = plainText(fields, key);
    if (name.find('/') != name.npos || name == "." || name == "..") {
        fields.fail(key, "must be the name of a file in the folder of the manifest");
    }
    return name;
}

FramePair readPair(const JsonFields& fields) {
    FramePair pair{.artifact = fileName(fields, "artifact"),
                   .converged = fileName(fields, "converged"),
                   .artifactPx = fields.number("artifact_px", kPositive),
                   .radiusPx = fields.number("radius_px", kPositive),
                   .scene = plainText(fields, "scene"),
                   .technique = plainText(fields, "technique")};
    fields.noOtherFields();
    return pair;
}

bool sameStimulus(const FramePair& a, const FramePair& b) {
    return a.scene == b.scene && a.technique == b.technique && a.radiusPx == b.radiusPx &&
           a.artifactPx == b.artifactPx;
}

void requireOnce(const JsonFields& fields, const std::vector<FramePair>& before,
                 const std::string& key, const std::string& place) {
    const FramePair& pair = before.back();
    for (std::size_t i = 0; i + 1 < before.size(); ++i) {
        const std::string there = key + "[" + std::to_string(i) + "]";
        if (before[i].artifact == pair.artifact) {
            fields.fail("artifact", "must stand in the list once, and is in " + there + " as well");
        }
        if (sameStimulus(before[i], pair)) {
            fields.fail("artifact_px", "must be another one than in " + there +
                                           ", which has the same scene, technique and radius");
        }
    }
    if (pair.artifact == pair.converged) {
        fields.fail("converged", "must be another file than the artifact of " + place);
    }
}

ordered_json manifestJson(const FrameManifest& manifest) {
    ordered_json file{{"schema", schemaJson(kSchemaName, kFramesMajor, kMinor)}};
    if (manifest.context) file["context"] = ordered_json(*manifest.context);
    file["frames"] = toJson(manifest.pairs);
    return file;
}

FrameManifest manifestFrom(const json& value, const std::string& file) {
    const JsonFields fields(value, file);
    checkSchema(fields, kSchemaName, kFramesMajor);
    FrameManifest manifest;
    if (fields.has("context")) manifest.context = runContextFromJson(fields.any("context"), file);
    fields.any("frames");
    manifest.pairs = framePairsFromJson(value, file, "", "frames");
    fields.noOtherFields();
    return manifest;
}

}  // namespace

std::vector<FramePair> framePairsFromJson(const json& object, const std::string& file,
                                          const std::string& path, const std::string& key) {
    const JsonFields fields(object, file, path);
    std::vector<FramePair> pairs;
    for (const JsonFields& entry : fields.objects(key)) {
        pairs.push_back(readPair(entry));
        requireOnce(entry, pairs, key, "the same pair");
    }
    if (pairs.empty()) fields.fail(key, "must hold at least one pair of frames");
    return pairs;
}

ordered_json toJson(const std::vector<FramePair>& pairs) {
    ordered_json list = ordered_json::array();
    for (const FramePair& pair : pairs) {
        list.push_back({{"artifact", pair.artifact},
                        {"converged", pair.converged},
                        {"artifact_px", pair.artifactPx},
                        {"radius_px", pair.radiusPx},
                        {"scene", pair.scene},
                        {"technique", pair.technique}});
    }
    return list;
}

FrameManifest readFrameManifest(const std::filesystem::path& folder) {
    const std::filesystem::path file = folder / kManifestName;
    return manifestFrom(readJson(file), file.string());
}

void writeFrameManifest(const std::filesystem::path& folder, const FrameManifest& manifest) {
    const std::filesystem::path file = folder / kManifestName;
    const ordered_json written = manifestJson(manifest);
    try {
        manifestFrom(json(written), file.string());
    } catch (const std::runtime_error& error) {
        throw std::invalid_argument(error.what());
    }
    writeJson(file, written);
}

}  // namespace records

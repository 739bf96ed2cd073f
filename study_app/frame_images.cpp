// SPDX-License-Identifier: MIT
#include "study_app/frame_images.h"

#include <stb_image.h>

#include <memory>
#include <stdexcept>

#include "records/file_checksum.h"
#include "records/whole_file.h"
#include "stimulus/silhouette.h"

namespace study_app {
namespace {

namespace fs = std::filesystem;
using records::FramePair;

[[noreturn]] void fail(const fs::path& file, const std::string& sentence) {
    throw std::runtime_error(file.string() + ": " + sentence);
}

const stbi_uc* bytesOf(const std::string& text) {
    return reinterpret_cast<const stbi_uc*>(text.data());
}

std::string bytesIn(const fs::path& file) {
    if (!fs::is_regular_file(file)) fail(file, "no such file");
    return records::readWholeFile(file);
}

int edgeOf(const fs::path& file, const std::string& bytes) {
    const int size = static_cast<int>(bytes.size());
    int width = 0, height = 0, channels = 0;
    if (stbi_info_from_memory(bytesOf(bytes), size, &width, &height, &channels) == 0) {
        fail(file, "cannot be read as a picture: must be an 8-bit grey PNG");
    }
    if (channels != 1 || stbi_is_16_bit_from_memory(bytesOf(bytes), size) != 0) {
        fail(file, (channels != 1 ? std::to_string(channels) + " channels" : "16 bits") +
                       ": must be 8-bit grey: its codes go to the screen as they are");
    }
    if (width != height) {
        fail(file, std::to_string(width) + " x " + std::to_string(height) +
                       " px: must be square, as two of them stand side by side");
    }
    if (width < 16 || width > stimulus::kMaxWindowPx) {
        fail(file, std::to_string(width) + " px: must be 16 to " +
                       std::to_string(stimulus::kMaxWindowPx) + " px wide");
    }
    return width;
}

void requirePinned(const FrameSet& frames, const std::string& name, const std::string& bytes) {
    if (frames.sha256.empty()) return;
    const auto pinned = frames.sha256.find(name);
    if (pinned != frames.sha256.end() && pinned->second == records::sha256(bytes)) return;
    fail(frames.folder / name,
         "is another picture than the one that the session began with (its SHA-256 differs): put "
         "that one back, or choose another session");
}

template <typename Use>
void forEachPicture(const std::vector<FramePair>& pairs, Use use) {
    for (const FramePair& pair : pairs) {
        for (const std::string& name : {pair.artifact, pair.converged}) use(name);
    }
}

}  // namespace

int frameEdgePx(const fs::path& folder, const std::vector<FramePair>& pairs) {
    const fs::path first = folder / pairs.front().artifact;
    const int edge = edgeOf(first, bytesIn(first));
    forEachPicture(pairs, [&](const std::string& name) {
        const fs::path file = folder / name;
        const int other = edgeOf(file, bytesIn(file));
        if (other == edge) return;
        fail(file, std::to_string(other) + " px: must be as wide as " + first.string() + ", " +
                       std::to_string(edge) + " px");
    });
    return edge;
}

std::map<std::string, std::string> frameChecksums(const fs::path& folder,
                                                  const std::vector<FramePair>& pairs) {
    std::map<std::string, std::string> sums;
    forEachPicture(pairs, [&](const std::string& name) {
        if (!sums.contains(name)) sums[name] = records::sha256(bytesIn(folder / name));
    });
    return sums;
}

cv::Mat readFrame(const FrameSet& frames, const std::string& name, int edgePx) {
    const fs::path file = frames.folder / name;
    const std::string bytes = bytesIn(file);
    requirePinned(frames, name, bytes);
    if (const int edge = edgeOf(file, bytes); edge != edgePx) {
        fail(file, std::to_string(edge) + " px: must be " + std::to_string(edgePx) +
                       " px wide, as the design's first frame");
    }
    int width = 0, height = 0, channels = 0;
    const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> codes(
        stbi_load_from_memory(bytesOf(bytes), static_cast<int>(bytes.size()), &width, &height,
                              &channels, 1),
        &stbi_image_free);
    if (!codes) fail(file, std::string("cannot be decoded: ") + stbi_failure_reason());
    return cv::Mat(height, width, CV_8UC1, codes.get()).clone();
}

void requireFrames(const FrameSet& frames) {
    forEachPicture(frames.pairs, [&](const std::string& name) {
        requirePinned(frames, name, bytesIn(frames.folder / name));
    });
}

}  // namespace study_app

// SPDX-License-Identifier: MIT
// Files that are read and written as a whole. Every error is a std::runtime_error that names the
// file and the system's reason.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace records {

/// The bytes of a file (or pipe). Throws where it cannot be read, is a folder, or exceeds 1 GiB.
std::string readWholeFile(const std::filesystem::path& file);

/// Replaces the file whole or not at all: writes a temporary file beside it, syncs it, renames it
/// and syncs the folder. Creates missing folders. A reader sees the old or the new content, never a
/// part; where it fails (disk full), the old content stays and the temporary file is removed. What
/// exists and is no regular file (a pipe, /dev/stdout) is written straight into.
void writeWholeFile(const std::filesystem::path& file, std::string_view bytes);

/// Like writeWholeFile, but only where nothing exists under that name yet; returns whether it
/// wrote. Of several programs at once, one writes.
bool writeWholeFileIfMissing(const std::filesystem::path& file, std::string_view bytes);

/// Creates the folder and its missing parents, on disk before it returns. Nothing where it exists.
void createFolders(const std::filesystem::path& folder);

/// Syncs a folder, so that a file created or renamed in it survives a power cut.
void syncFolder(const std::filesystem::path& folder);

}  // namespace records

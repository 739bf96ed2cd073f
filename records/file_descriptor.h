// SPDX-License-Identifier: MIT
// POSIX files for the writers of this folder: ownership, and calls that retry when a signal
// interrupts them.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

namespace records {

/// Owns an open file; closes it.
class FileDescriptor {
  public:
    FileDescriptor() = default;
    explicit FileDescriptor(int descriptor) : descriptor_(descriptor) {}
    FileDescriptor(FileDescriptor&& other) noexcept
        : descriptor_(std::exchange(other.descriptor_, -1)) {}
    FileDescriptor& operator=(FileDescriptor&& other) noexcept;
    ~FileDescriptor();

    bool isOpen() const { return descriptor_ >= 0; }
    int get() const { return descriptor_; }

  private:
    int descriptor_ = -1;
};

/// open(2) with O_CLOEXEC and mode 0666 (less the umask); not open (errno set) where it fails.
FileDescriptor openFile(const std::filesystem::path& file, int flags);

/// Writes everything. False (errno set) when the disk is full or the write fails; a part may be
/// written.
bool writeAll(int descriptor, std::string_view bytes);
/// Reads to the end. Throws std::runtime_error naming `file`.
std::string readAll(int descriptor, const std::filesystem::path& file);
/// fsync, fdatasync and ftruncate; false (errno set) where they fail.
bool syncFile(int descriptor);
bool syncData(int descriptor);
bool cutFile(int descriptor, std::size_t bytes);

/// Throws std::runtime_error "<file>: <what>: <reason of errno>".
[[noreturn]] void throwSystemError(const std::filesystem::path& file, const std::string& what,
                                   int error);

}  // namespace records

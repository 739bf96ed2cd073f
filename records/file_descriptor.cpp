// SPDX-License-Identifier: MIT
#include "records/file_descriptor.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <stdexcept>
#include <system_error>

namespace records {

namespace {

constexpr std::size_t kLargestFile = std::size_t{1} << 30;

template <typename Call>
auto retried(Call call) {
    auto result = call();
    while (result < 0 && errno == EINTR) result = call();
    return result;
}

}  // namespace

FileDescriptor& FileDescriptor::operator=(FileDescriptor&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
}

FileDescriptor::~FileDescriptor() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

FileDescriptor openFile(const std::filesystem::path& file, int flags) {
    return FileDescriptor(retried([&] { return ::open(file.c_str(), flags | O_CLOEXEC, 0666); }));
}

bool writeAll(int descriptor, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written =
            retried([&] { return ::write(descriptor, bytes.data(), bytes.size()); });
        if (written < 0) return false;
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return true;
}

std::string readAll(int descriptor, const std::filesystem::path& file) {
    std::string bytes;
    constexpr std::size_t kBlock = 1 << 16;
    for (std::size_t size = 0;;) {
        bytes.resize(size + kBlock);
        const ssize_t count =
            retried([&] { return ::read(descriptor, bytes.data() + size, kBlock); });
        if (count < 0) throwSystemError(file, "cannot be read", errno);
        size += static_cast<std::size_t>(count);
        if (size > kLargestFile) throw std::runtime_error(file.string() + ": is larger than 1 GiB");
        if (count == 0) {
            bytes.resize(size);
            return bytes;
        }
    }
}

bool syncFile(int descriptor) {
    return retried([&] { return ::fsync(descriptor); }) == 0;
}

bool syncData(int descriptor) {
    return retried([&] { return ::fdatasync(descriptor); }) == 0;
}

bool cutFile(int descriptor, std::size_t bytes) {
    return retried([&] { return ::ftruncate(descriptor, static_cast<off_t>(bytes)); }) == 0;
}

void throwSystemError(const std::filesystem::path& file, const std::string& what, int error) {
    throw std::runtime_error(file.string() + ": " + what + ": " +
                             std::generic_category().message(error));
}

}  // namespace records

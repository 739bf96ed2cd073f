// SPDX-License-Identifier: MIT
#include "records/whole_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <vector>

#include "records/file_descriptor.h"

namespace records {

namespace {

std::filesystem::path folderOf(const std::filesystem::path& file) {
    return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

// A complete, synced file under a name that no one else uses; removed unless it was moved away.
class TemporaryFile {
  public:
    TemporaryFile(const std::filesystem::path& target, std::string_view bytes) {
        FileDescriptor descriptor;
        for (int attempt = 0; !descriptor.isOpen(); ++attempt) {
            std::string name = ".";
            name += target.filename().string();
            for (const int part : {static_cast<int>(::getpid()), attempt})
                name.append(".").append(std::to_string(part));
            name += ".tmp";
            path_ = folderOf(target) / name;
            descriptor = openFile(path_, O_WRONLY | O_CREAT | O_EXCL);
            if (!descriptor.isOpen() && errno != EEXIST)
                throwSystemError(target, "cannot be written", errno);
        }
        if (!writeAll(descriptor.get(), bytes) || !syncFile(descriptor.get())) {
            const int error = errno;
            ::unlink(path_.c_str());
            throwSystemError(target, "cannot be written", error);
        }
    }
    ~TemporaryFile() {
        if (!moved_) ::unlink(path_.c_str());
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    void replace(const std::filesystem::path& target) {
        if (::rename(path_.c_str(), target.c_str()) != 0)
            throwSystemError(target, "cannot be written", errno);
        moved_ = true;
    }

    // link(2) refuses an existing name, which rename does not. exFAT and its like know no links
    // (EPERM); a race between two programs stays open there, and both would write the same.
    bool becomeIfMissing(const std::filesystem::path& target) {
        if (::link(path_.c_str(), target.c_str()) == 0) return true;
        if (errno == EEXIST) return false;
        if (errno != EPERM && errno != EOPNOTSUPP)
            throwSystemError(target, "cannot be written", errno);
        replace(target);
        return true;
    }

  private:
    std::filesystem::path path_;
    bool moved_ = false;
};

void writeStraight(const std::filesystem::path& file, std::string_view bytes) {
    const FileDescriptor descriptor = openFile(file, O_WRONLY);
    if (!descriptor.isOpen() || !writeAll(descriptor.get(), bytes))
        throwSystemError(file, "cannot be written", errno);
}

}  // namespace

std::string readWholeFile(const std::filesystem::path& file) {
    const FileDescriptor descriptor = openFile(file, O_RDONLY);
    if (!descriptor.isOpen()) throwSystemError(file, "cannot be read", errno);
    return readAll(descriptor.get(), file);
}

void writeWholeFile(const std::filesystem::path& file, std::string_view bytes) {
    struct stat status;
    if (::stat(file.c_str(), &status) == 0 && !S_ISREG(status.st_mode)) {
        if (S_ISDIR(status.st_mode)) throwSystemError(file, "cannot be written", EISDIR);
        return writeStraight(file, bytes);
    }
    createFolders(folderOf(file));
    TemporaryFile(file, bytes).replace(file);
    syncFolder(folderOf(file));
}

bool writeWholeFileIfMissing(const std::filesystem::path& file, std::string_view bytes) {
    if (std::filesystem::exists(file)) return false;
    createFolders(folderOf(file));
    const bool written = TemporaryFile(file, bytes).becomeIfMissing(file);
    syncFolder(folderOf(file));
    return written;
}

void createFolders(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> missing;
    for (std::filesystem::path at = folder; !at.empty(); at = at.parent_path()) {
        struct stat status;
        if (::stat(at.c_str(), &status) == 0) {
            if (!S_ISDIR(status.st_mode))
                throwSystemError(folder, "cannot be created as a folder", ENOTDIR);
            break;
        }
        if (errno != ENOENT) throwSystemError(folder, "cannot be created as a folder", errno);
        missing.push_back(at);
        if (at == at.parent_path()) break;
    }
    for (auto at = missing.rbegin(); at != missing.rend(); ++at) {
        if (::mkdir(at->c_str(), 0777) != 0 && errno != EEXIST)
            throwSystemError(folder, "cannot be created as a folder", errno);
        syncFolder(folderOf(*at));
    }
}

void syncFolder(const std::filesystem::path& folder) {
    const FileDescriptor descriptor = openFile(folder, O_RDONLY | O_DIRECTORY);
    // Some file systems cannot sync a folder (EINVAL); there is nothing more that can be done
    // there.
    if (!descriptor.isOpen() || (!syncFile(descriptor.get()) && errno != EINVAL))
        throwSystemError(folder, "folder cannot be synced", errno);
}

}  // namespace records

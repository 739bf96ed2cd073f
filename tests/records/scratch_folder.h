// SPDX-License-Identifier: MIT
// A folder of its own for one test, and the questions that tests ask about files and errors.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace tests {

/// A fresh temporary folder; removed with everything in it.
class ScratchFolder {
  public:
    ScratchFolder();
    ~ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

  private:
    std::filesystem::path path_;
};

void writeBytes(const std::filesystem::path& file, const std::string& bytes);
std::string readBytes(const std::filesystem::path& file);

/// The sentence of the exception of type E that `action` throws; "(no error)" where it throws none.
template <typename E>
std::string errorOf(const std::function<void()>& action) {
    try {
        action();
    } catch (const E& error) {
        return error.what();
    }
    return "(no error)";
}

/// Runs `action` in a child process whose files cannot grow beyond `bytes`: what a full disk looks
/// like to it. Returns the child's exit code: 0, or 99 where `action` throws.
int runWithFullDisk(std::size_t bytes, const std::function<void()>& action);
/// Lifts the limit again, in the child.
void freeTheDisk();

}  // namespace tests

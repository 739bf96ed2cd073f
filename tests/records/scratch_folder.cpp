// SPDX-License-Identifier: MIT
#include "tests/records/scratch_folder.h"

#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace tests {

ScratchFolder::ScratchFolder() {
    // In memory where there is such a place: what is tested here syncs after every row.
    const bool inMemory = ::access("/dev/shm", W_OK | X_OK) == 0;
    const std::filesystem::path parent =
        inMemory ? "/dev/shm" : std::filesystem::temp_directory_path();
    std::string name = (parent / "stairwell-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = name;
}

ScratchFolder::~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

void writeBytes(const std::filesystem::path& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
}

std::string readBytes(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

namespace {

void limitFiles(rlim_t bytes) {
    rlimit limit{};
    ::getrlimit(RLIMIT_FSIZE, &limit);
    limit.rlim_cur = bytes;
    ::setrlimit(RLIMIT_FSIZE, &limit);
}

}  // namespace

void freeTheDisk() {
    rlimit limit{};
    ::getrlimit(RLIMIT_FSIZE, &limit);
    limitFiles(limit.rlim_max);
}

int runWithFullDisk(std::size_t bytes, const std::function<void()>& action) {
    const pid_t child = ::fork();
    if (child == 0) {
        std::signal(SIGXFSZ, SIG_IGN);
        limitFiles(bytes);
        try {
            action();
        } catch (const std::exception& error) {
            freeTheDisk();  // standard error may be a file as well
            std::fprintf(stderr, "in the child: %s\n", error.what());
            ::_exit(99);
        }
        ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace tests

// SPDX-License-Identifier: MIT
#include "analysis/gnuplot.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

extern char** environ;

namespace analysis {
namespace {

// Both ends of a pipe, closed when done.
struct Pipe {
    int end[2] = {-1, -1};
    Pipe() {
        if (pipe2(end, O_CLOEXEC) != 0) {
            throw std::runtime_error(std::string("gnuplot: no pipe: ") + std::strerror(errno));
        }
    }
    ~Pipe() {
        for (const int descriptor : end) {
            if (descriptor >= 0) close(descriptor);
        }
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
};

std::string readAll(int descriptor) {
    std::string text;
    char buffer[4096];
    while (true) {
        const ssize_t got = read(descriptor, buffer, sizeof buffer);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return text;
        text.append(buffer, static_cast<std::size_t>(got));
    }
}

// gnuplot repeats the command and points at the place; the last line says what is wrong.
std::string lastLine(std::string text) {
    while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
    const std::size_t start = text.rfind('\n');
    return start == std::string::npos ? text : text.substr(start + 1);
}

}  // namespace

void runGnuplot(const std::filesystem::path& folder, const std::vector<std::string>& scripts) {
    Pipe output;
    const std::string where = std::filesystem::absolute(folder).string();
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addchdir_np(&actions, where.c_str());
    posix_spawn_file_actions_adddup2(&actions, output.end[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, output.end[1], STDERR_FILENO);
    std::vector<std::string> words = {"gnuplot"};
    words.insert(words.end(), scripts.begin(), scripts.end());
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    pid_t child = 0;
    const int failed =
        posix_spawnp(&child, "gnuplot", &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (failed != 0) {
        throw std::runtime_error(where + ": gnuplot, which draws the figures, cannot be started (" +
                                 std::strerror(failed) + "): install the package gnuplot-nox");
    }
    close(output.end[1]);
    output.end[1] = -1;
    const std::string said = readAll(output.end[0]);
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (status != 0) {
        throw std::runtime_error(where + ": gnuplot failed on " + scripts.front() +
                                 (scripts.size() > 1 ? " or a later script" : "") + ": " +
                                 lastLine(said));
    }
}

std::string quotedForGnuplot(const std::string& text) {
    std::string quoted = "'";
    for (const char c : text) {
        if (c == '\n' || c == '\r') continue;
        if (std::strchr("_^@{}&~\\", c) && c != '\0') quoted += '\\';
        quoted += c;
        if (c == '\'') quoted += c;
    }
    return quoted + "'";
}

}  // namespace analysis

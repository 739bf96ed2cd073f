// SPDX-License-Identifier: MIT
#include "tests/study_app/window_person.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <fstream>
#include <mutex>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <thread>

#include "tests/project_folders.h"

namespace tests {
namespace {

using namespace std::chrono_literals;

constexpr auto kPatience = 30s;

struct Spawn {
    std::vector<std::string> arguments;
    std::string display{};
    int out = -1, error = -1;  // descriptors that become standard output and error
    std::map<std::string, std::string> environment{};
};

pid_t spawn(const Spawn& what) {
    std::vector<char*> argv;
    for (const std::string& argument : what.arguments) {
        argv.push_back(const_cast<char*>(argument.c_str()));
    }
    argv.push_back(nullptr);
    const pid_t process = ::fork();
    if (process != 0) return process;
    if (!what.display.empty()) ::setenv("DISPLAY", what.display.c_str(), 1);
    // The GL driver leaves a few bytes behind in modules that are unloaded at the exit; under a
    // leak check that would be the program's exit code. The rest of the sanitizer stays on.
    const char* sanitizer = std::getenv("ASAN_OPTIONS");
    const std::string options =
        std::string(sanitizer == nullptr ? "" : sanitizer) + ":detect_leaks=0";
    ::setenv("ASAN_OPTIONS", options.c_str(), 1);
    for (const auto& [name, value] : what.environment) ::setenv(name.c_str(), value.c_str(), 1);
    ::signal(SIGXFSZ, SIG_IGN);  // of limitFileSize(): a write fails instead
    if (what.out >= 0) ::dup2(what.out, 1);
    if (what.error >= 0) ::dup2(what.error, 2);
    ::execvp(argv[0], argv.data());
    ::_exit(127);
}

std::string readAll(int descriptor) {
    std::string text;
    char buffer[256];
    for (ssize_t n; (n = ::read(descriptor, buffer, sizeof buffer)) > 0;) {
        text.append(buffer, static_cast<std::size_t>(n));
        if (text.ends_with('\n') && text.size() > 1) break;
    }
    return text;
}

std::string contentOf(const std::filesystem::path& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

XServer::XServer(const std::string& screen) {
    int ends[2];
    if (::pipe(ends) != 0) throw std::runtime_error("Xvfb: no pipe");
    const int quiet = ::open("/dev/null", O_WRONLY);
    // The server writes its number to standard output once it is ready.
    process_ =
        spawn({.arguments = {"Xvfb", "-displayfd", "1", "-screen", "0", screen, "-nolisten", "tcp",
                             "-noreset"},  // else it starts anew whenever a program has gone
               .out = ends[1],
               .error = quiet});
    ::close(ends[1]);
    ::close(quiet);
    std::string number = readAll(ends[0]);
    ::close(ends[0]);
    while (number.ends_with('\n')) number.pop_back();
    if (number.empty()) throw std::runtime_error("Xvfb: cannot be started (package xvfb)");
    display_ = ":" + number;
}

XServer::~XServer() {
    ::kill(process_, SIGTERM);
    ::waitpid(process_, nullptr, 0);
}

WindowPerson::WindowPerson(const XServer& server, const std::filesystem::path& folder,
                           std::vector<std::string> arguments,
                           const std::map<std::string, std::string>& environment)
    : display_(server.display()), log_(folder / "events.log"), errors_(folder / "errors.txt") {
    std::filesystem::remove(log_);
    arguments.insert(arguments.begin(), (programFolder() / "study_app").string());
    for (const std::string& more :
         {std::string("--event-log"), log_.string(), std::string("--displays"),
          (folder / "displays.json").string(), std::string("--verify-pixels")}) {
        arguments.push_back(more);
    }
    const int errors = ::open(errors_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    process_ = spawn({.arguments = arguments,
                      .display = display_,
                      .out = errors,
                      .error = errors,
                      .environment = environment});
    ::close(errors);
}

WindowPerson::~WindowPerson() {
    kill();
}

bool WindowPerson::running() {
    if (process_ < 0) return false;
    siginfo_t ended{};
    ::waitid(P_PID, static_cast<id_t>(process_), &ended, WEXITED | WNOHANG | WNOWAIT);
    if (ended.si_pid == 0) return true;
    killer_ = {};  // before the number of the process is free for another one
    int status = 0;
    ::waitpid(process_, &status, 0);
    exitCode_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    process_ = -1;
    return false;
}

void WindowPerson::kill() {
    if (!running()) return;
    ::kill(process_, SIGKILL);
    siginfo_t ended{};
    ::waitid(P_PID, static_cast<id_t>(process_), &ended, WEXITED | WNOWAIT);
    running();
}

void WindowPerson::killAfter(std::chrono::microseconds time) {
    killer_ = std::jthread([time, process = process_](std::stop_token stop) {
        std::mutex mutex;
        std::unique_lock lock(mutex);
        std::condition_variable_any stopped;
        stopped.wait_for(lock, stop, time, [] { return false; });
        if (!stop.stop_requested()) ::kill(process, SIGKILL);
    });
}

bool WindowPerson::killed() const {
    return exitCode_ == 128 + SIGKILL;
}

bool WindowPerson::killedWithin(std::chrono::milliseconds time) {
    const auto start = std::chrono::steady_clock::now();
    while (running() && std::chrono::steady_clock::now() - start < time) {
        std::this_thread::sleep_for(1ms);
    }
    return killed();
}

std::vector<std::string> WindowPerson::events() const {
    std::istringstream log(contentOf(log_));
    std::vector<std::string> lines;
    for (std::string line; std::getline(log, line);) lines.push_back(line);
    return lines;
}

int WindowPerson::exitCode() {
    const auto start = std::chrono::steady_clock::now();
    while (running()) {
        if (std::chrono::steady_clock::now() - start > kPatience) {
            throw std::runtime_error("study_app does not end");
        }
        std::this_thread::sleep_for(5ms);
    }
    return exitCode_;
}

std::string WindowPerson::errors() const {
    return contentOf(errors_);
}

std::string WindowPerson::waitFor(const std::string& beginning) {
    const auto start = std::chrono::steady_clock::now();
    while (std::chrono::steady_clock::now() - start < kPatience) {
        const bool ended = !running();
        const std::string text = contentOf(log_);
        for (std::size_t end; (end = text.find('\n', read_)) != text.npos;) {
            const std::string line = text.substr(read_, end - read_);
            read_ = end + 1;
            if (line.starts_with(beginning)) return line;
        }
        if (ended)
            throw std::runtime_error("study_app ended before '" + beginning + "': " + errors());
        std::this_thread::sleep_for(2ms);
    }
    throw std::runtime_error("no event '" + beginning + "' came");
}

void WindowPerson::limitFileSize(std::uintmax_t bytes) {
    const rlimit limit{.rlim_cur = bytes, .rlim_max = RLIM_INFINITY};
    if (::prlimit(process_, RLIMIT_FSIZE, &limit, nullptr) != 0) {
        throw std::system_error(errno, std::generic_category(), "prlimit");
    }
}

std::string WindowPerson::outputOf(const std::vector<std::string>& command) {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error(command.front() + ": no pipe");
    const pid_t process = spawn({.arguments = command, .display = display_, .out = ends[1]});
    ::close(ends[1]);
    // A tool that waits for a window waits for ever once the program is gone.
    int status = 0;
    const auto start = std::chrono::steady_clock::now();
    while (::waitpid(process, &status, WNOHANG) == 0) {
        std::this_thread::sleep_for(1ms);
        if (running() || std::chrono::steady_clock::now() - start < 1s) continue;
        ::kill(process, SIGKILL);
    }
    const std::string output = readAll(ends[0]);
    ::close(ends[0]);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return output;
    throw std::runtime_error(command.front() + " " + command.at(1) +
                             ": failed (packages xdotool, x11-xserver-utils)");
}

void WindowPerson::onDisplay(const std::string& tool, const std::vector<std::string>& arguments) {
    std::vector<std::string> command{tool};
    command.insert(command.end(), arguments.begin(), arguments.end());
    outputOf(command);
}

std::string WindowPerson::window() {
    if (!windowId_.empty()) return windowId_;
    std::istringstream ids(
        outputOf({"xdotool", "search", "--sync", "--onlyvisible", "--name", "Stairwell study"}));
    ids >> windowId_;
    // Without a window manager nobody else gives it the focus.
    xdotool({"windowfocus", "--sync", windowId_});
    return windowId_;
}

void WindowPerson::press(const std::string& keys) {
    window();
    std::vector<std::string> arguments{"key", "--delay", "0"};
    std::istringstream words(keys);
    for (std::string key; words >> key;) arguments.push_back(key);
    xdotool(arguments);
}

double WindowPerson::processorSeconds() const {
    std::string stat = contentOf("/proc/" + std::to_string(process_) + "/stat");
    stat.erase(0, stat.rfind(')') + 2);  // the name may hold blanks
    std::istringstream fields(stat);
    std::string skipped;
    for (int i = 0; i < 11; ++i) fields >> skipped;
    double user = 0, system = 0;
    fields >> user >> system;
    return (user + system) / static_cast<double>(::sysconf(_SC_CLK_TCK));
}

}  // namespace tests

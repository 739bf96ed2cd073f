// SPDX-License-Identifier: MIT
#include "program/run_program.h"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include "program/build_info.h"

namespace program {

namespace {

constexpr int kSuccess = 0, kFailure = 1, kBadUsage = 2;

// One line on standard error whatever the message holds: line ends and escape sequences out of
// files and arguments must not reach the terminal.
int report(const std::string& programName, std::string sentence, int exitCode) {
    std::string line;
    for (const char character : sentence) {
        const auto code = static_cast<unsigned char>(character);
        line += code < 0x20 || code == 0x7f ? ' ' : character;
    }
    while (!line.empty() && line.back() == ' ') line.pop_back();
    std::fflush(stdout);
    std::fprintf(stderr, "%s: %s\n", programName.c_str(), line.c_str());
    return exitCode;
}

// A program whose answer never reached the file behind `> file` has not succeeded.
void flushStandardOutput() {
    errno = 0;
    std::cout.flush();
    const bool flushed = std::fflush(stdout) == 0;
    if (flushed && std::cout.good() && std::ferror(stdout) == 0) return;
    // The reason of an earlier failure, in the middle of the run, is not known any more.
    const std::string reason = errno != 0 ? std::string(": ") + std::strerror(errno) : "";
    throw std::runtime_error("standard output: cannot be written" + reason);
}

std::string nameOf(const CLI::App& app, int argc, char** argv) {
    if (!app.get_name().empty()) return app.get_name();
    if (argc < 1 || argv[0] == nullptr) return "stairwell";
    return std::filesystem::path(argv[0]).filename().string();
}

// A misspelt option is what the user must hear of first, also where a required one is missing
// besides: CLI11 finds the missing one first.
std::string usageSentence(const CLI::App& app, const CLI::ParseError& error) {
    const std::vector<std::string> unknown = app.remaining();
    if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr && !unknown.empty()) {
        return CLI::ExtrasError(app.get_name(), unknown).what();
    }
    return error.what();
}

}  // namespace

int run(CLI::App& app, int argc, char** argv, const std::function<void()>& body) {
    std::signal(SIGXFSZ, SIG_IGN);
    const std::string name = nameOf(app, argc, argv);
    app.name(name);
    try {
        try {
            app.set_version_flag("--version", versionLine(name), "Print the version and exit");
            app.parse(argc, argv);
            body();
        } catch (const CLI::Success& success) {  // --help, --version
            app.exit(success);
        }
        flushStandardOutput();
        return kSuccess;
    } catch (const CLI::ParseError& error) {
        return report(name, usageSentence(app, error) + " (see --help)", kBadUsage);
    } catch (const std::bad_alloc&) {
        return report(name, "out of memory", kFailure);
    } catch (const std::exception& error) {
        return report(name, error.what(), kFailure);
    }
}

}  // namespace program

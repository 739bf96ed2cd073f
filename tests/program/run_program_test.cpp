// SPDX-License-Identifier: MIT
#include "program/run_program.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include "program/build_info.h"

namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

struct Ending {
    int exitCode = -1;
    std::string out, err;
};

std::string drained(std::FILE* file) {
    std::string text;
    std::rewind(file);
    for (int c; (c = std::fgetc(file)) != EOF;) text += static_cast<char>(c);
    std::fclose(file);
    return text;
}

// Runs program::run in a process of its own, as main would; standard output goes to `outPath` where
// it is given.
Ending ending(std::vector<std::string> arguments, const std::function<void()>& body,
              const char* outPath = nullptr) {
    std::FILE* out = std::tmpfile();
    std::FILE* err = std::tmpfile();
    std::fflush(nullptr);
    const pid_t child = ::fork();
    if (child == 0) {
        ::dup2(outPath ? ::open(outPath, O_WRONLY) : ::fileno(out), STDOUT_FILENO);
        ::dup2(::fileno(err), STDERR_FILENO);
        CLI::App app{"Does nothing, politely."};
        int count = 1;
        std::string input;
        app.add_option("--count", count, "how many");
        app.add_option("input", input, "what to read")->required();
        arguments.insert(arguments.begin(), "/some/where/probe");
        std::vector<char*> argv;
        for (std::string& argument : arguments) argv.push_back(argument.data());
        argv.push_back(nullptr);
        const int argc = static_cast<int>(arguments.size());
        const int code = program::run(app, argc, argv.data(), body);
        std::fflush(nullptr);
        ::_exit(code);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return {.exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
            .out = drained(out),
            .err = drained(err)};
}

const std::function<void()> kSayHello = [] { std::cout << "hello\n"; };

TEST(RunProgram, SuccessIsExitZeroAndQuiet) {
    const Ending end = ending({"in", "--count", "3"}, kSayHello);
    EXPECT_EQ(end.exitCode, 0);
    EXPECT_EQ(end.out, "hello\n");
    EXPECT_EQ(end.err, "");
}

TEST(RunProgram, AnErrorIsOneSentenceAndExitOne) {
    const Ending end =
        ending({"in"}, [] { throw std::runtime_error("a.tsv: line 3: bad\nthing \x1b[31m"); });
    EXPECT_EQ(end.exitCode, 1);
    EXPECT_EQ(end.err, "probe: a.tsv: line 3: bad thing  [31m\n");
    EXPECT_EQ(ending({"in"}, [] { throw std::invalid_argument("x"); }).err, "probe: x\n");
    EXPECT_EQ(ending({"in"}, [] { throw std::bad_alloc(); }).err, "probe: out of memory\n");
}

TEST(RunProgram, BadUsageIsOneSentenceAndExitTwo) {
    const std::vector<std::vector<std::string>> kBad = {
        {},
        {"in", "--unknown"},
        {"in", "more"},
        {"in", "--count"},
        {"in", "--count", "three"},
        {"in", "--count", "1", "--count", "2", "--no"},
        {"in", "--count=99999999999999999999"}};
    for (const auto& arguments : kBad) {
        const Ending end = ending(arguments, kSayHello);
        EXPECT_EQ(end.exitCode, 2) << end.err;
        EXPECT_EQ(end.out, "") << "the body did not run";
        EXPECT_THAT(end.err, StartsWith("probe: "));
        EXPECT_THAT(end.err, EndsWith("\n"));
        EXPECT_EQ(std::count(end.err.begin(), end.err.end(), '\n'), 1) << end.err;
    }
    EXPECT_THAT(ending({"in", "--unknown"}, kSayHello).err, HasSubstr("--unknown"));
    EXPECT_THAT(ending({}, kSayHello).err, HasSubstr("input is required"));
}

TEST(RunProgram, HelpAndVersionSucceedWithoutTheRequiredArguments) {
    const Ending help = ending({"--help"}, kSayHello);
    EXPECT_EQ(help.exitCode, 0);
    EXPECT_THAT(help.out, HasSubstr("Does nothing, politely."));
    EXPECT_THAT(help.out, HasSubstr("Usage: probe"));
    EXPECT_THAT(help.out, HasSubstr("--version"));
    const Ending version = ending({"--version"}, kSayHello);
    EXPECT_EQ(version.exitCode, 0);
    EXPECT_EQ(version.out, program::versionLine("probe") + "\n");
}

TEST(RunProgram, AnswersThatCannotBeWrittenAreNoSuccess) {
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"in"}, {"--help"}, {"--version"}}) {
        const Ending end = ending(arguments, kSayHello, "/dev/full");
        EXPECT_EQ(end.exitCode, 1);
        EXPECT_THAT(end.err, StartsWith("probe: standard output: cannot be written"));
    }
    const auto much = [] {
        for (int i = 0; i < 100000; ++i) std::cout << "hello\n";
    };
    EXPECT_EQ(ending({"in"}, much, "/dev/full").exitCode, 1);
    const auto sayWithPrintf = [] { std::printf("hello\n"); };
    EXPECT_EQ(ending({"in"}, sayWithPrintf, "/dev/full").exitCode, 1);
}

}  // namespace

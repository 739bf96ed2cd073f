// SPDX-License-Identifier: MIT
// Runs one of our programs as its user would, for tests: by argument list (no shell), with standard
// output and error captured.
#pragma once

#include <string>
#include <vector>

namespace tests {

struct CommandResult {
    int exitCode = -1;  // 128 + signal where a signal ended it
    std::string out;    // standard output
    std::string err;    // standard error
};

/// `program` is a name in build/<preset>/bin.
CommandResult runProgram(const std::string& program, const std::vector<std::string>& arguments);

}  // namespace tests

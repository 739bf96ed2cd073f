// SPDX-License-Identifier: MIT
// The shell that every program's main shares: parse, run, and turn errors into sentences and exit
// codes.
//
//   int main(int argc, char** argv) {
//       CLI::App app{"Fits the slope c of r = c a."};
//       std::string out;
//       app.add_option("--out", out, "folder of the report")->required();
//       return program::run(app, argc, argv, [&] { fit(out); });
//   }
//
// Exit codes: 0 success; 1 a located sentence on standard error ("<program>: <sentence>"), from any
// std::exception that `body` throws, or because standard output could not be written (a full disk
// behind
// `> file`); 2 bad usage (unknown option, missing argument, a value of the wrong type), with the
// sentence of what was wrong. `--help` and `--version` are added here and exit 0.
//
// Leave files and folders to `body`: a missing file is an error of the run (exit 1), not of usage,
// so CLI::ExistingFile and its like are not for these programs. A file-size limit (ulimit -f) is an
// error like a full disk here: run ignores SIGXFSZ.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace program {

int run(CLI::App& app, int argc, char** argv, const std::function<void()>& body);

}  // namespace program

// SPDX-License-Identifier: MIT
// Any bytes as a trial table: trials that can be written and read back, or a located error.
#include <random>
#include <stdexcept>
#include <string_view>

#include "records/trial_table.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/records/random_records.h"

std::vector<std::string> fuzz::seeds() {
    std::mt19937_64 random(9);
    std::vector<std::string> result;
    for (int i = 0; i < 5; ++i) {
        result.push_back(tests::tableText(tests::randomTrials(random, 4, 1), {"extra"}));
    }
    return result;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        const records::TrialTable table =
            records::parseTrialTable({reinterpret_cast<const char*>(data), size}, "file");
        const std::string rewritten = tests::tableText(table.trials, table.extraColumns);
        fuzz::require(records::parseTrialTable(rewritten, "file").trials == table.trials,
                      "what was read can be written and read again");
    } catch (const std::runtime_error& error) {
        fuzz::require(std::string_view(error.what()).starts_with("file"), "errors name the file");
    }
    return 0;
}

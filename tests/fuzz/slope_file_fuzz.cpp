// SPDX-License-Identifier: MIT
// Any bytes as slope.json: a slope that describes itself and validates, or a located error.
#include <fstream>
#include <iterator>
#include <random>
#include <stdexcept>
#include <string_view>

#include "records/slope_file.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/records/random_records.h"
#include "tests/temporary_folder.h"

std::vector<std::string> fuzz::seeds() {
    const tests::TemporaryFolder folder;
    std::mt19937_64 random(7);
    std::vector<std::string> result;
    for (int i = 0; i < 5; ++i) {
        const auto path = folder.path() / "slope.json";
        records::writeSlope(path, tests::randomSlope(random));
        std::ifstream file(path, std::ios::binary);
        result.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
    }
    return result;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        const records::Slope slope =
            records::parseSlope({reinterpret_cast<const char*>(data), size}, "file");
        fuzz::require(!records::describe(slope).empty(), "a slope can be shown");
        fuzz::require(slope.c.estimate > 0 && slope.beta > 0, "what was read is usable");
    } catch (const std::runtime_error& error) {
        fuzz::require(std::string_view(error.what()).starts_with("file"), "errors name the file");
    }
    return 0;
}

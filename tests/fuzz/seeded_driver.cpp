// SPDX-License-Identifier: MIT
// Runs a fuzz target on damaged copies of its seeds, with a fixed random seed: the short run that
// every compiler can do. Also what prepares and repeats a long one:
//     X_seeded [RUNS [SEED]]    damaged seeds (default 20000, 1)
//     X_seeded --write FOLDER   writes the seeds as files
//     X_seeded --file FILE      one input
// An input that crashes is left in crash-input in the working folder.
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <string_view>

#include "tests/fuzz/fuzz_target.h"

namespace {

std::string current;

extern "C" void keepInput(int signal) {
    if (std::FILE* file = std::fopen("crash-input", "wb")) {
        std::fwrite(current.data(), 1, current.size(), file);
        std::fclose(file);
    }
    std::signal(signal, SIG_DFL);
    std::raise(signal);
}

std::string damaged(std::mt19937_64& random, const std::vector<std::string>& seeds) {
    std::string bytes = seeds[random() % seeds.size()];
    for (auto count = 1 + random() % 4; count > 0; --count) {
        const std::size_t at = bytes.empty() ? 0 : random() % bytes.size();
        const std::size_t length = std::min<std::size_t>(random() % 16, bytes.size() - at);
        switch (random() % 7) {
            case 0:
                bytes.erase(at, length);
                break;
            case 1:
                bytes.insert(at, bytes.substr(at, random() % 200));
                break;
            case 2:
                bytes.resize(at);
                break;
            case 3:
                bytes.insert(at, 1 + random() % 8, static_cast<char>(random()));
                break;
            case 4: {  // a piece of another seed
                const std::string& other = seeds[random() % seeds.size()];
                bytes.replace(at, length, other, other.empty() ? 0 : random() % other.size(), 40);
                break;
            }
            case 5:
                for (std::size_t i = at; i < at + length; ++i)
                    bytes[i] = static_cast<char>(random());
                break;
            default:
                if (!bytes.empty()) bytes[at] = static_cast<char>(bytes[at] ^ (1 << random() % 8));
        }
    }
    return bytes;
}

int run(const std::string& input) {
    current = input;
    return LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(current.data()),
                                  current.size());
}

int writeSeeds(const std::string& folder) {
    const auto seeds = fuzz::seeds();
    for (std::size_t i = 0; i < seeds.size(); ++i) {
        std::ofstream file(folder + "/seed" + std::to_string(i), std::ios::binary);
        file << seeds[i];
        if (!file.flush()) return 1;
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    const std::string_view first = argc > 1 ? argv[1] : "";
    if (first == "--write" && argc == 3) return writeSeeds(argv[2]);
    if (first == "--file" && argc == 3) {
        std::ifstream file(argv[2], std::ios::binary);
        return run(std::string(std::istreambuf_iterator<char>(file), {}));
    }
    for (const int signal : {SIGABRT, SIGSEGV, SIGFPE}) std::signal(signal, keepInput);
    const long runs = argc > 1 ? std::atol(argv[1]) : 20000;
    std::mt19937_64 random(argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1);
    const auto seeds = fuzz::seeds();
    run("");
    for (const std::string& seed : seeds) run(seed);
    for (long i = 0; i < runs; ++i) run(damaged(random, seeds));
    std::printf("%ld damaged inputs from %zu seeds\n", runs, seeds.size());
    return 0;
}

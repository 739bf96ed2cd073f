// SPDX-License-Identifier: MIT
// Prints how exact every technique is on its hard cases: docs/results/technique-errors.md.
//   technique_errors > docs/results/technique-errors.md
#include <cstdio>

#include "tests/renderer/hard_cases.h"

int main() {
    std::printf(
        "# Worst errors of the shadow techniques on their hard cases\n\n"
        "Largest difference in visibility from the technique's own formula in long double, over "
        "%zu "
        "distributions of depth\nunder the kernel with receivers at and around every depth "
        "(`tests/renderer/hard_cases.cpp`), at default parameters.\nTechniques that compare depths "
        "one by one are held against themselves in double. An error of 1 is a step that falls\nthe "
        "other way: 11 bits cannot hold the depths that the default bias is made for.\n\n"
        "Written by `technique_errors` on the CPU; no time, GPU or random number takes part. "
        "Compiler: GCC or clang, x86-64\n(`long double` of 64 bits).\n\n"
        "| technique | map in halves | as stored | double | worst as stored |\n"
        "|---|---|---|---|---|\n",
        tests::hardCases().size());
    for (const renderer::Technique& technique : renderer::techniques()) {
        std::printf("| %s |", std::string(technique.name).c_str());
        for (const tests::Precision precision : tests::kPrecisions)
            std::printf(" %.2g |", tests::worstError(technique, precision).worst);
        const tests::HardError stored = tests::worstError(technique, tests::Precision::asStored);
        std::printf(" %s |\n", stored.worst > 0 ? stored.where.c_str() : "none");
    }
    return 0;
}

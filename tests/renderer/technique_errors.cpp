// SPDX-License-Identifier: MIT
// Prints how exact every technique is on its hard cases: docs/results/technique-errors.md.
//   technique_errors > docs/results/technique-errors.md
#include <cstdio>

#include "tests/renderer/hard_cases.h"

int main() {
    std::printf(
        "# Worst errors of the shadow techniques on their hard cases\n\n"
        "Largest difference in visibility from the technique's own formula in long double "
        "(`tests/renderer/exact_technique.cpp`), over %zu maps\nwith receivers at and around every "
        "depth (`tests/renderer/hard_cases.cpp`), at default parameters but for those named.\nAn "
        "error of 1 is a step that falls the other way: 11 bits cannot hold the depths that the "
        "default bias is made for.\nThe full disc (pcf_disc, pcss) is off in double too: its "
        "weights are a midpoint rule (`shared/disc_kernel.glsl`); so are\nsums (vsm_sat, "
        "pcss_sat), "
        "which count whole units (`shared/summed_map.glsl`).\n\n"
        "Written by `technique_errors` on the CPU; no time, GPU or random number takes part. "
        "Compiler: GCC or clang, x86-64\n(`long double` of 64 bits).\n\n"
        "| technique | parameters | map in halves | as stored | double | worst as stored |\n"
        "|---|---|---|---|---|---|\n",
        tests::hardCases().size());
    for (const renderer::Technique& technique : renderer::techniques())
        for (const tests::Variant& variant : tests::variantsOf(technique)) {
            std::printf("| %s | %s |", std::string(technique.name).c_str(),
                        tests::toText(variant).c_str());
            tests::HardError stored;
            for (const tests::Precision precision : tests::kPrecisions) {
                const tests::HardError error = tests::worstError(technique, precision, variant);
                std::printf(" %.2g |", error.worst);
                if (precision == tests::Precision::asStored) stored = error;
            }
            std::printf(" %s |\n", stored.worst > 0 ? stored.where.c_str() : "none");
        }
    return 0;
}

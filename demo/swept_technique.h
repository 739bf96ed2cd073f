// SPDX-License-Identifier: MIT
// A technique with its parameters as sweeps take it: "vsm", "pcf_taps:taps=16",
// "pcf_taps:taps=16:rotated=0". The text is its name in tables.
#pragma once

#include <string>
#include <vector>

#include "renderer/technique.h"

namespace demo {

struct SweptTechnique {
    std::string name;
    const renderer::Technique* technique = nullptr;
    renderer::ParameterValues parameters{};
};

/// Throws std::invalid_argument that names what of the text is not known or out of range.
SweptTechnique parseSweptTechnique(const std::string& text);
std::vector<SweptTechnique> parseSweptTechniques(const std::vector<std::string>& texts);

}  // namespace demo

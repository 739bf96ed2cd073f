// SPDX-License-Identifier: MIT
// Designs that the tests share.
#pragma once

#include <filesystem>
#include <string>

#include "study_app/design.h"

namespace tests {

/// A design of the source tree by name.
study_app::Design shippedDesign(const std::string& name);
std::filesystem::path shippedDesignFile(const std::string& name);

/// Small, with every kind of silhouette, two kernels, dither, clicks where the task has
/// them, and catch trials.
study_app::Design variedDesign(records::Task task);

}  // namespace tests

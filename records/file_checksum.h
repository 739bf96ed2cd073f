// SPDX-License-Identifier: MIT
// SHA-256 of a file, so that a report names the data it came from beyond doubt.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace records {

std::string sha256(std::string_view bytes);  ///< 64 hexadecimal digits

/// A line "<digits>  <path>" for each file, as `sha256sum --check` reads it. Throws
/// std::runtime_error, located, where a file cannot be read.
std::string checksumLines(std::span<const std::filesystem::path> files);

}  // namespace records

// SPDX-License-Identifier: MIT
#include "records/quoted_text.h"

#include <array>
#include <charconv>
#include <cstddef>

namespace records {

namespace {

constexpr std::size_t kShownBytes = 60;

bool isControl(unsigned char byte) {
    return byte < 0x20 || byte == 0x7f;
}

// Length of the well-formed UTF-8 sequence (Unicode, table 3-7) at the start of `text`, 0 where
// there is none.
std::size_t sequenceLength(std::string_view text) {
    const auto byte = [&](std::size_t i) {
        return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
    };
    const auto within = [](unsigned value, unsigned low, unsigned high) {
        return value >= low && value <= high;
    };
    const unsigned lead = byte(0);
    if (lead < 0x80) return 1;
    unsigned low = 0x80, high = 0xbf;
    std::size_t length = 0;
    if (within(lead, 0xc2, 0xdf)) length = 2;
    if (within(lead, 0xe0, 0xef)) length = 3;
    if (within(lead, 0xf0, 0xf4)) length = 4;
    if (lead == 0xe0) low = 0xa0;   // overlong
    if (lead == 0xed) high = 0x9f;  // surrogates
    if (lead == 0xf0) low = 0x90;   // overlong
    if (lead == 0xf4) high = 0x8f;  // beyond U+10FFFF
    if (length == 0 || !within(byte(1), low, high)) return 0;
    for (std::size_t i = 2; i < length; ++i)
        if (!within(byte(i), 0x80, 0xbf)) return 0;
    return length;
}

void appendEscaped(std::string& out, unsigned char byte) {
    static constexpr char kDigits[] = "0123456789abcdef";
    out += "\\x";
    out += kDigits[byte >> 4];
    out += kDigits[byte & 15];
}

}  // namespace

std::string quotedText(std::string_view text) {
    std::string out = "\"";
    for (std::size_t i = 0; i < text.size();) {
        if (i >= kShownBytes) return out + "...\"";
        const std::size_t length = sequenceLength(text.substr(i));
        const auto byte = static_cast<unsigned char>(text[i]);
        if (length == 0 || isControl(byte)) {
            appendEscaped(out, byte);
            ++i;
        } else {
            out += text.substr(i, length);
            i += length;
        }
    }
    return out + "\"";
}

bool isPlainText(std::string_view text) {
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t length = sequenceLength(text.substr(i));
        if (length == 0 || isControl(static_cast<unsigned char>(text[i]))) return false;
        i += length;
    }
    return true;
}

std::string exactText(double value) {
    std::array<char, 32> digits;
    const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), value);
    return {digits.data(), result.ptr};
}

}  // namespace records

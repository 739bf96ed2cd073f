// SPDX-License-Identifier: MIT
#include "records/file_checksum.h"

#include <openssl/evp.h>

#include <stdexcept>

#include "records/whole_file.h"

namespace records {

std::string sha256(std::string_view bytes) {
    unsigned char digest[EVP_MAX_MD_SIZE];
    unsigned int length = 0;
    if (EVP_Digest(bytes.data(), bytes.size(), digest, &length, EVP_sha256(), nullptr) != 1) {
        throw std::runtime_error("SHA-256: libcrypto refuses it");
    }
    constexpr char kDigits[] = "0123456789abcdef";
    std::string text;
    for (unsigned int i = 0; i < length; ++i) {
        text += kDigits[digest[i] >> 4];
        text += kDigits[digest[i] & 15];
    }
    return text;
}

std::string checksumLines(std::span<const std::filesystem::path> files) {
    std::string lines;
    for (const std::filesystem::path& file : files) {
        lines += sha256(readWholeFile(file)) + "  " + file.string() + "\n";
    }
    return lines;
}

}  // namespace records

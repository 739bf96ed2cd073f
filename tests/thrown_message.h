// SPDX-License-Identifier: MIT
// What a call throws, as its sentence, for tests of the sentences.
#pragma once

#include <exception>
#include <string>

namespace tests {

template <class Exception = std::exception, class Call>
std::string messageOf(const Call& call) {
    try {
        call();
    } catch (const Exception& error) {
        return error.what();
    }
    return "nothing was thrown";
}

}  // namespace tests

// SPDX-License-Identifier: MIT
#include "demo/sweep_context.h"

#include <sstream>

namespace demo {

std::string contextLine(const std::string& context, const std::string& name) {
    std::istringstream lines(context);
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with(name + " ")) continue;
        const std::size_t text = line.find_first_not_of(' ', name.size());
        return text == std::string::npos ? "" : line.substr(text);
    }
    return "";
}

std::vector<std::string> contextDifferences(const std::string& before, const std::string& now,
                                            const std::vector<std::string>& names) {
    std::vector<std::string> differences;
    for (const std::string& name : names) {
        const std::string was = contextLine(before, name);
        const std::string is = contextLine(now, name);
        if (was != is)
            differences.push_back(name + " is \"" + was + "\" there and \"" + is + "\" here");
    }
    return differences;
}

}  // namespace demo

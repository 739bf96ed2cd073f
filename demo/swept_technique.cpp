// SPDX-License-Identifier: MIT
#include "demo/swept_technique.h"

#include <charconv>
#include <stdexcept>

namespace demo {

SweptTechnique parseSweptTechnique(const std::string& text) {
    SweptTechnique swept{.name = text};
    std::size_t colon = text.find(':');
    swept.technique = &renderer::findTechnique(text.substr(0, colon));
    swept.parameters = swept.technique->standardParameters();
    while (colon != std::string::npos) {
        const std::size_t next = text.find(':', colon + 1);
        const std::string setting = text.substr(colon + 1, next - colon - 1);
        const std::size_t equals = setting.find('=');
        float value = 0;
        const char* const end = setting.data() + setting.size();
        const auto [rest, error] = equals == std::string::npos
                                       ? std::from_chars_result{end, std::errc::invalid_argument}
                                       : std::from_chars(setting.data() + equals + 1, end, value);
        if (error != std::errc() || rest != end)
            throw std::invalid_argument("technique \"" + text + "\": \"" + setting +
                                        "\" must be PARAMETER=NUMBER");
        renderer::setParameter(*swept.technique, swept.parameters, setting.substr(0, equals),
                               value);
        colon = next;
    }
    return swept;
}

std::vector<SweptTechnique> parseSweptTechniques(const std::vector<std::string>& texts) {
    std::vector<SweptTechnique> all;
    for (const std::string& text : texts) all.push_back(parseSweptTechnique(text));
    return all;
}

}  // namespace demo

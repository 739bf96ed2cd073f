// SPDX-License-Identifier: MIT
#include "demo/map_names.h"

#include <algorithm>
#include <array>

namespace demo {

std::vector<std::string> mapNames(std::span<const renderer::LightView> views) {
    // As lampViews() has them.
    constexpr std::array<const char*, 6> kFaces = {"+x", "-x", "+y", "-y", "+z", "-z"};
    std::vector<std::string> names;
    std::size_t ofLight = 0;
    for (std::size_t i = 0; i < views.size(); ++i) {
        const std::size_t light = views[i].light;
        ofLight = i > 0 && views[i - 1].light == light ? ofLight + 1 : 0;
        const bool several = std::ranges::count(views, light, &renderer::LightView::light) > 1;
        std::string name = light == 0 ? "sun" : "lamp " + std::to_string(light);
        if (several && light == 0) name += ", cascade " + std::to_string(ofLight + 1);
        if (several && light > 0) name += std::string(", face ") + kFaces.at(ofLight);
        names.push_back(std::move(name));
    }
    return names;
}

}  // namespace demo

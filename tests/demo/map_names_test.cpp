// SPDX-License-Identifier: MIT
#include "demo/map_names.h"

#include <gmock/gmock.h>

#include "renderer/scene.h"

namespace {

using renderer::LightView;
using testing::ElementsAre;

TEST(MapNames, SayWhichPartOfWhichLight) {
    EXPECT_THAT(demo::mapNames(std::vector<LightView>(1)), ElementsAre("sun"));
    EXPECT_THAT(demo::mapNames(std::vector<LightView>(2)),
                ElementsAre("sun, cascade 1", "sun, cascade 2"));
    std::vector<LightView> views(1);
    const renderer::Lamp point{.kind = renderer::Lamp::Kind::point};
    for (const LightView& face : renderer::lampViews(point, 1)) views.push_back(face);
    for (const LightView& spot : renderer::lampViews({}, 2)) views.push_back(spot);
    EXPECT_THAT(demo::mapNames(views),
                ElementsAre("sun", "lamp 1, face +x", "lamp 1, face -x", "lamp 1, face +y",
                            "lamp 1, face -y", "lamp 1, face +z", "lamp 1, face -z", "lamp 2"));
    EXPECT_TRUE(demo::mapNames({}).empty());
}

// The names are given by place, the faces are made elsewhere.
TEST(MapNames, NameTheAxisThatAFaceLooksAlong) {
    const renderer::Lamp point{.kind = renderer::Lamp::Kind::point, .position = {0, 0, 0}};
    const auto faces = renderer::lampViews(point, 1);
    const auto names = demo::mapNames(faces);
    for (std::size_t i = 0; i < faces.size(); ++i) {
        glm::dvec4 ahead(0, 0, 0, 1);
        ahead[names[i].back() - 'x'] = names[i][names[i].size() - 2] == '+' ? 1 : -1;
        const glm::dvec4 seen = faces[i].window.shadowFromWorld * ahead;
        EXPECT_NEAR(seen.w, 1, 1e-12) << names[i] << ": the distance along the axis";
        EXPECT_NEAR(seen.x / seen.w, 0.5, 1e-12) << names[i];
    }
}

}  // namespace

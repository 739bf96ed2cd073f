// SPDX-License-Identifier: MIT
// The textures that a frame's maps take: as many bytes as are reported, none that nobody reads, and
// none made anew while nothing has changed.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "renderer/renderer.h"
#include "tests/headless_gl.h"

namespace {

using renderer::Prefilter;
using renderer::Technique;
using tests::gl;

/// The names of all textures that carry a label.
std::vector<GLuint> labelled(const std::string& label) {
    std::vector<GLuint> found;
    for (GLuint name = 1; name < 2000; ++name) {
        if (glIsTexture(name) != GL_TRUE) continue;
        std::array<char, 64> text{};
        glGetObjectLabel(GL_TEXTURE, name, static_cast<GLsizei>(text.size()), nullptr, text.data());
        if (label == text.data()) found.push_back(name);
    }
    return found;
}

/// Texels of all levels and layers.
std::size_t texelsOf(GLuint texture) {
    GLint levels = 0;
    glGetTextureParameteriv(texture, GL_TEXTURE_IMMUTABLE_LEVELS, &levels);
    std::size_t texels = 0;
    for (GLint level = 0; level < levels; ++level) {
        std::size_t product = 1;
        for (const GLenum side : {GL_TEXTURE_WIDTH, GL_TEXTURE_HEIGHT, GL_TEXTURE_DEPTH}) {
            GLint size = 0;
            glGetTextureLevelParameteriv(texture, level, side, &size);
            product *= static_cast<std::size_t>(size);
        }
        texels += product;
    }
    return texels;
}

TEST(MapTextures, BytesAreThoseOfTheTexturesThatThePrefilterNeeds) {
    renderer::Renderer frame(gl(), renderer::makeScene("planar_occluder"), 16, 9);
    for (const Technique& technique : renderer::techniques()) {
        frame.render({.technique = &technique, .resolution = 64, .radiusUv = 0.02F});
        std::size_t bytes = texelsOf(labelled("shadow map").at(0)) * 4;
        const std::size_t texel = static_cast<std::size_t>(bytesPerTexel(technique.format));
        const auto filtered = labelled("filtered map");
        const auto rows = labelled("filtered rows");
        for (const GLuint texture : filtered) bytes += texelsOf(texture) * texel;
        for (const GLuint texture : rows) bytes += texelsOf(texture) * texel;
        EXPECT_EQ(frame.mapBytes(), bytes) << technique.name;
        const bool inPlace = technique.prefilter == Prefilter::none ||
                             technique.prefilter == Prefilter::converted ||
                             technique.prefilter == Prefilter::mips;
        EXPECT_EQ(filtered.size(), technique.prefilter == Prefilter::none ? 0U : 1U);
        EXPECT_EQ(rows.size(), inPlace ? 0U : 1U) << technique.name;
    }
    // Depth, and a texel of three numbers and none beside: with a second texture it would be 36.
    const Technique& stored = renderer::findTechnique("gsm_stored");
    frame.render({.technique = &stored, .resolution = 1024});
    EXPECT_NEAR(static_cast<double>(frame.mapBytes()) / (1024 * 1024),
                4 + bytesPerTexel(stored.format), 0.5);
}

const renderer::Lamp kSpot{
    .position = {0, 9, 0.1F}, .target = {0, 0, 0}, .coneDeg = 8, .farM = 20};
const renderer::Lamp kLowSpot{
    .position = {-5, 2, 1}, .target = {0, 0.5F, 0}, .coneDeg = 70, .farM = 30};

renderer::FrameSettings layeredSettings(const Technique& technique, int resolution) {
    renderer::ParameterValues parameters = technique.standardParameters();
    setParameter(technique, parameters, "layers", 0);
    return {.technique = &technique,
            .parameters = parameters,
            .resolution = resolution,
            .radiusUv = 0.01F};
}

/// The layers that the maps' depths have asked for.
std::vector<float> layerCounts(const renderer::Renderer& frame, const Technique& technique) {
    const std::size_t slot = *technique.parameterSlot("layers");
    std::vector<float> counts;
    for (std::size_t view = 0; view < frame.lightViews().size(); ++view)
        counts.push_back(
            frame.shadowConstants(view).parameters[slot / 4][static_cast<glm::length_t>(slot % 4)]);
    return counts;
}

/// Two frames, since layers lie where the depths of the frame before were.
renderer::Renderer settled(std::vector<renderer::Lamp> lamps,
                           const renderer::FrameSettings& settings) {
    renderer::Renderer frame(gl(), renderer::makeScene("yard"), 96, 54);
    frame.setLamps(std::move(lamps));
    frame.render(settings);
    frame.render(settings);
    return frame;
}

// Their guard bands differ too.
TEST(MapTextures, MapsOfOtherLayerCountsShareThemAndShowWhatTheyShowAlone) {
    for (const char* name : {"lvsm", "power_cdf"}) {
        const Technique& technique = renderer::findTechnique(name);
        const auto settings = layeredSettings(technique, 200);
        renderer::Renderer all = settled({kSpot, kLowSpot}, settings);
        const std::vector<float> counts = layerCounts(all, technique);
        EXPECT_NE(counts[0], counts[1]) << name << ": nothing was compared";
        EXPECT_NE(counts[1], counts[2]) << name << ": nothing was compared";

        const std::string kept = std::string("kept of ") + name;
        for (const char* label : {"filtered map", "filtered rows"})
            for (const GLuint texture : labelled(label))
                glObjectLabel(GL_TEXTURE, texture, -1, kept.c_str());
        const std::size_t bytes = all.mapBytes();
        all.render(settings);
        EXPECT_EQ(labelled(kept).size(), 2U) << "some were made anew";
        EXPECT_EQ(all.mapBytes(), bytes);

        const auto sun = settled({}, settings).readVisibility(0).values;
        const auto spot = settled({kSpot}, settings).readVisibility(1).values;
        const auto lowSpot = settled({kLowSpot}, settings).readVisibility(1).values;
        EXPECT_EQ(all.readVisibility(0).values, sun) << name;
        EXPECT_EQ(all.readVisibility(1).values, spot) << name;
        EXPECT_EQ(all.readVisibility(2).values, lowSpot) << name;

        // And give room back.
        const auto smaller = layeredSettings(technique, 100);
        all.render(smaller);
        EXPECT_EQ(all.mapBytes(), settled({kSpot, kLowSpot}, smaller).mapBytes()) << name;
    }
}

}  // namespace

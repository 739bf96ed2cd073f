// SPDX-License-Identifier: MIT
#include "renderer/detail_probe.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numeric>

namespace renderer {
namespace {

// Texels around a tile that its pixels' walks may enter, so that no caster on a border is missed.
constexpr int kMargin = 3 * DetailProbe::kWidestTexels + 2;
constexpr int kDrawnEdge = DetailProbe::kTileEdge + 2 * kMargin;
// One pixel of each cell is asked: a bar as wide as a pixel gives a sample for every 4 pixels of
// its length.
constexpr int kCellEdge = 2;
// Samples that may be tips and corners.
constexpr std::uint32_t kLeastSamples = 12;
constexpr std::uint32_t kTopShare = 16;  // one in so many is left out

GLuint groups(int cells, int perGroup) {
    return static_cast<GLuint>((cells + perGroup - 1) / perGroup);
}

/// A step that visits every tile and is never the next one: what moves through the map is met soon.
int tileOf(std::uint64_t submission) {
    constexpr std::uint64_t kStep = 7;
    static_assert(std::gcd(int{kStep}, DetailProbe::kTiles) == 1);
    return static_cast<int>(submission % DetailProbe::kTiles * kStep % DetailProbe::kTiles);
}

}  // namespace

int detailOf(const DemandPass::Counters& counters) {
    constexpr std::size_t kBins = 64;
    const std::uint32_t total = std::accumulate(counters.begin(), counters.begin() + kBins, 0U);
    const std::uint32_t above = std::max(kLeastSamples, total / kTopShare);
    if (total <= above) return 0;
    std::uint32_t passed = 0;
    for (std::size_t bin = kBins; bin-- > 0;) {
        passed += counters[bin];
        if (passed > above)
            return static_cast<int>(std::ceil(std::exp2(static_cast<double>(bin + 1) / 4)));
    }
    return 0;
}

DetailProbe::DetailProbe(const ShaderLibrary& shaders, const std::string& demandGlsl)
    : demandGlsl_(demandGlsl),
      program_(makeDetailProgram(shaders)),
      depths_(makeTexture(GL_DEPTH_COMPONENT32F, kDrawnEdge, kDrawnEdge, "detail tile")),
      target_(makeFramebuffer({}, depths_.name(), "detail tile")),
      shadowBlock_(makeBuffer(nullptr, sizeof(f32::ShadowConstants), GL_DYNAMIC_STORAGE_BIT,
                              "detail constants")) {}

Program DetailProbe::makeDetailProgram(const ShaderLibrary& shaders) const {
    return makeComputeProgram(withDemand(shaders, demandGlsl_), "passes/detail.comp",
                              {.defines = {{"MAP_SAMPLER", "sampler2D"},
                                           {"CELL", std::to_string(kCellEdge)},
                                           {"WIDEST_TEXELS", std::to_string(kWidestTexels)}},
                               .substitutions = {{"demand", kDemandInclude}}});
}

void DetailProbe::reload(const ShaderLibrary& shaders) {
    program_ = makeDetailProgram(shaders);
}

void DetailProbe::submit(const Renderer& frame, const DemandRule& rule, std::size_t view) {
    const auto inputs = frame.outputs(view);
    if (!inputs) return;
    while (answers_.size() <= view) answers_.push_back(std::make_unique<Answers>());
    Answers& answers = *answers_[view];
    answers.take();
    if (!answers.ring.hasRoom()) return;
    const int tile = tileOf(answers.ring.submissions());
    const glm::ivec2 lowest =
        glm::ivec2(tile % kTilesAlong, tile / kTilesAlong) * kTileEdge - glm::ivec2(kMargin);
    const glm::dvec2 tileUv = glm::dvec2(lowest + kMargin) / static_cast<double>(kFineEdge);
    const PixelRect pixels =
        frame.pixelsBetween(view, tileUv, tileUv + 1.0 / static_cast<double>(kTilesAlong));
    if (pixels.empty()) {  // an answer like another
        answers.ring.begin();
        answers.ring.end();
        return;
    }
    const double edgeUv = static_cast<double>(kDrawnEdge) / kFineEdge;
    const glm::dvec2 lowestUv = glm::dvec2(lowest) / static_cast<double>(kFineEdge);

    f32::ShadowConstants shadow = frame.shadowConstants(view);
    const glm::dmat4 tileFromMap =
        glm::scale(glm::dmat4(1), glm::dvec3(1 / edgeUv, 1 / edgeUv, 1)) *
        glm::translate(glm::dmat4(1), glm::dvec3(-lowestUv, 0));
    shadow.shadowFromWorld = glm::mat4(tileFromMap * glm::dmat4(shadow.shadowFromWorld));
    shadow.map = {kFineEdge, 1.0F / kFineEdge, 0, shadow.map.w};
    frame.bindConstants(view);
    glNamedBufferSubData(shadowBlock_.name(), 0, sizeof shadow, &shadow);
    glBindBufferBase(GL_UNIFORM_BUFFER, kShadowBinding, shadowBlock_.name());
    frame.drawCasters(target_, kDrawnEdge, shadow);

    glUseProgram(program_.name());
    glBindTextureUnit(0, inputs->positions);
    glBindTextureUnit(1, inputs->planes);
    glBindTextureUnit(2, depths_.name());
    glUniform4f(0, rule.c, rule.pixelBound, rule.contrastExponent, rule.texelsPerCaster);
    glUniform1ui(1, inputs->hasKernel ? 1 : 0);
    const glm::ivec2 first = glm::ivec2(pixels.x, pixels.y) / kCellEdge;
    const glm::ivec2 last =
        glm::ivec2(pixels.x + pixels.width - 1, pixels.y + pixels.height - 1) / kCellEdge;
    const glm::ivec2 cells = last - first + 1;
    glUniform4i(2, first.x, first.y, cells.x, cells.y);
    glUniform4i(3, lowest.x, lowest.y, kMargin, kDrawnEdge);
    answers.ring.begin();
    glDispatchCompute(groups(cells.x, 16), groups(cells.y, 8), 1);
    answers.ring.end();
    frame.bindConstants(view);
}

void DetailProbe::Answers::take() {
    while (const auto reading = ring.next())
        std::copy_n(reading->counters.begin(), DemandPass::kCounters,
                    tiles[static_cast<std::size_t>(tileOf(reading->submission))].begin());
}

void DetailProbe::submitAll(const Renderer& frame, const DemandRule& rule, std::size_t view) {
    for (int tile = 0; tile < kTiles; ++tile) {
        submit(frame, rule, view);
        glFinish();
    }
    if (view < answers_.size()) answers_[view]->take();
}

int DetailProbe::detailTexels(std::size_t view) {
    if (view >= answers_.size()) return 0;
    answers_[view]->take();
    DemandPass::Counters all{};
    for (const DemandPass::Counters& tile : answers_[view]->tiles)
        for (std::size_t i = 0; i < all.size(); ++i) all[i] += tile[i];
    return std::min(detailOf(all), kFineEdge);
}

void DetailProbe::forget() {
    for (const auto& answers : answers_) {
        answers->tiles = {};
        answers->ring.forget();
    }
}

}  // namespace renderer

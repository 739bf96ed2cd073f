// SPDX-License-Identifier: MIT
#include "renderer/demand_pass.h"

#include <algorithm>
#include <numeric>

namespace renderer {
namespace {

/// Order in which the pixels of a cell are taken: steps that are coprime to the cell visit every
/// pixel of it, and a step of about half the cell goes far from one frame to the next.
glm::ivec2 pixelOfCell(int edge, std::uint64_t turn) {
    const auto cell = static_cast<unsigned>(edge * edge);
    unsigned step = cell / 2 + 1;
    while (std::gcd(step, cell) != 1) ++step;
    const auto pixel = static_cast<int>(turn % cell * step % cell);
    return {pixel % edge, pixel / edge};
}

}  // namespace

ShaderLibrary withDemand(const ShaderLibrary& shaders, const std::string& demandGlsl) {
    ShaderLibrary::Files files = shaders.files();
    files[kDemandInclude] = demandGlsl;
    return ShaderLibrary(std::move(files), shaders.place());
}

bool hasOwnRadius(const ShaderLibrary& shaders, const Technique& technique) {
    return shaders.text(technique.shaderFile()).find("real penumbraRadiusUv(") != std::string::npos;
}

PixelDemandPrograms::PixelDemandPrograms(const ShaderLibrary& shaders, Make make)
    : shaders_(shaders), make_(std::move(make)) {
    programOf({nullptr, false});
}

const Program& PixelDemandPrograms::programOf(const Technique& technique, const DemandRule& rule) {
    return programOf(
        {hasOwnRadius(shaders_, technique) ? &technique : nullptr, rule.contrastExponent != 0});
}

const Program& PixelDemandPrograms::programOf(Key key) {
    if (const auto program = programs_.find(key); program != programs_.end())
        return program->second;
    const auto& [technique, withContrast] = key;
    ShaderOptions options;
    if (technique != nullptr)
        options = techniqueOptions(*technique);
    else
        options = {.defines = {{"MAP_SAMPLER", "sampler2D"}},
                   .substitutions = {{"technique", "shared/one_radius.glsl"}}};
    options.substitutions.emplace("demand", kDemandInclude);
    if (withContrast) options.defines.push_back({"WITH_CONTRAST", "1"});
    return programs_.emplace(key, make_(options)).first->second;
}

void PixelDemandPrograms::prepareAs(const PixelDemandPrograms& other) {
    for (const auto& [key, program] : other.programs_) programOf(key);
}

void PixelDemandPrograms::use(const Renderer::Outputs& frame, const DemandRule& rule) {
    const Program& program = programOf(*frame.technique, rule);
    const std::array<GLuint, kTextures> textures = {frame.positions,  frame.planes,
                                                    frame.visibility, frame.normals,
                                                    frame.albedos,    frame.depths};
    glBindTextures(0, kTextures, textures.data());
    glUseProgram(program.name());
    glUniform4f(0, rule.c, rule.pixelBound, rule.contrastExponent, rule.texelsPerCaster);
    glUniform1ui(1, frame.hasKernel ? 1 : 0);
}

DemandPass::DemandPass(const ShaderLibrary& shaders, const std::string& demandGlsl)
    : demandGlsl_(demandGlsl), programs_(makePrograms(shaders)) {}

PixelDemandPrograms DemandPass::makePrograms(const ShaderLibrary& shaders) const {
    return {shaders, [library = withDemand(shaders, demandGlsl_)](const ShaderOptions& options) {
                return makeComputeProgram(library, "passes/demand.comp", options);
            }};
}

void DemandPass::reload(const ShaderLibrary& shaders) {
    PixelDemandPrograms programs = makePrograms(shaders);
    programs.prepareAs(programs_);
    programs_ = std::move(programs);
}

bool DemandPass::submit(const Renderer& frame, const DemandRule& rule, PassClock* clock,
                        std::size_t view) {
    const auto inputs = frame.outputs(view);
    if (!inputs) return false;
    while (rings_.size() <= view)
        rings_.push_back(std::make_unique<CounterRing>(kCounters, "demand"));
    CounterRing& ring = *rings_[view];
    if (!ring.hasRoom()) return false;
    frame.bindConstants(view);
    if (clock != nullptr) clock->begin(Pass::demand);
    programs_.use(*inputs, rule);
    const SparsePixels pixels = sparsePixels(frame, view, ring.submissions());
    glUniform3i(2, pixels.cell.x, pixels.cell.y, pixels.cell.z);
    ring.begin();
    glDispatchCompute(pixels.groupsX, pixels.groupsY, 1);
    ring.end();
    if (clock != nullptr) clock->end(Pass::demand);
    return true;
}

std::optional<DemandPass::Counters> DemandPass::next(std::size_t view) {
    if (view >= rings_.size()) return std::nullopt;
    const auto reading = rings_[view]->next();
    if (!reading) return std::nullopt;
    Counters counters;
    std::copy_n(reading->counters.begin(), kCounters, counters.begin());
    return counters;
}

void DemandPass::forget() {
    for (const auto& ring : rings_) ring->forget();
}

int DemandPass::cellEdge(int widthPx, int heightPx) {
    constexpr std::int64_t kLargePx = 1 << 19;
    return std::int64_t{widthPx} * heightPx > kLargePx ? kLargeCellEdge : kCellEdge;
}

SparsePixels sparsePixels(const Renderer& frame, std::size_t view, std::uint64_t turn) {
    const int edge = DemandPass::cellEdge(frame.widthPx(), frame.heightPx());
    const PixelRect served = frame.servedPixels()[view];
    // Cells begin at the screen's corner, so that a map that serves more has the same.
    const glm::ivec2 first = glm::ivec2(served.x, served.y) / edge;
    const auto groups = [edge](int endPx, int firstCell, int perGroup) {
        const int cells = std::max((endPx + edge - 1) / edge - firstCell, 0);
        return static_cast<GLuint>((cells + perGroup - 1) / perGroup);
    };
    return {{first * edge + pixelOfCell(edge, turn), edge},
            groups(served.x + served.width, first.x, 16),
            groups(served.y + served.height, first.y, 8)};
}

}  // namespace renderer

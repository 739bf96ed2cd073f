// SPDX-License-Identifier: MIT
#include "renderer/demand_pass.h"

#include <cstring>
#include <numeric>
#include <stdexcept>

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

DemandPass::DemandPass(const ShaderLibrary& shaders, const std::string& demandGlsl)
    : program_(makeComputeProgram(withDemand(shaders, demandGlsl), "passes/demand.comp",
                                  {.defines = {}, .substitutions = {{"demand", kDemandInclude}}})) {
    counters_ = makeBuffer(nullptr, kSlotBytes, 0, "demand counters");
    constexpr GLbitfield access = GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
    ring_ = makeBuffer(nullptr, kRing * kSlotBytes, access, "demand ring");
    mapped_ = static_cast<const std::byte*>(
        glMapNamedBufferRange(ring_.name(), 0, kRing * kSlotBytes, access));
    if (mapped_ == nullptr)
        throw std::runtime_error("demand pass: the driver cannot map its read-back buffer");
}

DemandPass::~DemandPass() {
    for (Slot& slot : slots_) release(slot);
}

void DemandPass::release(Slot& slot) {
    if (slot.fence != nullptr) glDeleteSync(slot.fence);
    slot.fence = nullptr;
}

void DemandPass::submit(const Renderer& frame, const DemandRule& rule, PassClock* clock) {
    const auto inputs = frame.outputs();
    if (!inputs) return;
    frame.bindConstants();
    if (clock != nullptr) clock->begin(Pass::demand);
    const std::uint32_t zero = 0;
    glClearNamedBufferData(counters_.name(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &zero);
    glBindTextureUnit(0, inputs->positions);
    glBindTextureUnit(1, inputs->planes);
    glBindTextureUnit(2, inputs->visibility);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, counters_.name());
    glUseProgram(program_.name());
    const glm::ivec2 pixel = pixelOfCell(kCellEdge, submissions_);
    glUniform3i(0, pixel.x, pixel.y, kCellEdge);
    glUniform1ui(1, inputs->hasKernel ? 1 : 0);
    glUniform4f(2, rule.c, rule.pixelBound, rule.contrastExponent, rule.texelsPerCaster);
    const auto groups = [](int pixels, int perGroup) {
        const int cells = (pixels + kCellEdge - 1) / kCellEdge;
        return static_cast<GLuint>((cells + perGroup - 1) / perGroup);
    };
    glDispatchCompute(groups(frame.widthPx(), 16), groups(frame.heightPx(), 8), 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);

    Slot& slot = slots_[submissions_ % kRing];
    if (slot.fence != nullptr) ++lost_;
    release(slot);
    glCopyNamedBufferSubData(counters_.name(), ring_.name(), 0,
                             static_cast<GLintptr>(submissions_ % kRing * kSlotBytes),
                             kCounters * sizeof(std::uint32_t));
    glMemoryBarrier(GL_CLIENT_MAPPED_BUFFER_BARRIER_BIT);
    slot = {.fence = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0), .submission = submissions_++};
    glFlush();  // or the fence might never be passed
    if (clock != nullptr) clock->end(Pass::demand);
}

std::optional<DemandPass::Reading> DemandPass::newest() {
    std::optional<Reading> reading;
    for (std::uint64_t age = 0; age < kRing && age < submissions_ && !reading; ++age) {
        const std::size_t at = (submissions_ - 1 - age) % kRing;
        if (slots_[at].fence == nullptr) break;  // returned before, as were those before it
        GLint state = GL_UNSIGNALED;
        glGetSynciv(slots_[at].fence, GL_SYNC_STATUS, 1, nullptr, &state);
        if (state != GL_SIGNALED) continue;
        reading.emplace();
        std::memcpy(reading->counters.data(), mapped_ + at * kSlotBytes, sizeof reading->counters);
        reading->ageFrames = static_cast<int>(age);
    }
    if (!reading) return reading;
    // Older ones are of no use any more.
    const std::uint64_t returned =
        submissions_ - 1 - static_cast<std::uint64_t>(reading->ageFrames);
    for (Slot& slot : slots_)
        if (slot.submission <= returned) release(slot);
    return reading;
}

}  // namespace renderer

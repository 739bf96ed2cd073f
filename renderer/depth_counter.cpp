// SPDX-License-Identifier: MIT
#include "renderer/depth_counter.h"

#include <algorithm>
#include <stdexcept>

namespace renderer {
namespace {

constexpr int kSamplesAlongEdge = 128;
constexpr int kGroupEdge = 16;  // of depths.comp
constexpr GLuint64 kLongestWaitNs = 10'000'000'000;

Program compiled(const ShaderLibrary& shaders) {
    return makeComputeProgram(
        shaders, "passes/depths.comp",
        {.defines = {{"DEPTH_BINS", std::to_string(kDepthBins)}}, .substitutions = {}});
}

}  // namespace

DepthCounter::~DepthCounter() {
    forget();
}

void DepthCounter::reload(const ShaderLibrary& shaders) {
    if (program_.name() != 0) program_ = compiled(shaders);
}

void DepthCounter::forget() {
    if (underWay_ != nullptr) glDeleteSync(underWay_);
    underWay_ = nullptr;
    newest_.reset();
}

void DepthCounter::submit(const Texture& map, int resolution) {
    const std::uint32_t zero = 0;
    glClearNamedBufferData(counters_.name(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &zero);
    glBindTextureUnit(0, map.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, counters_.name());
    glUseProgram(program_.name());
    const int step = std::max(resolution / kSamplesAlongEdge, 1);
    glUniform2i(0, step, resolution);
    const int samples = (resolution + step - 1) / step;
    const auto groups = static_cast<GLuint>((samples + kGroupEdge - 1) / kGroupEdge);
    glDispatchCompute(groups, groups, 1);
    glMemoryBarrier(GL_CLIENT_MAPPED_BUFFER_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    underWay_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    glFlush();  // or the fence might never be passed
}

void DepthCounter::take(bool wait) {
    if (underWay_ == nullptr) return;
    const GLenum state =
        glClientWaitSync(underWay_, GL_SYNC_FLUSH_COMMANDS_BIT, wait ? kLongestWaitNs : 0);
    if (state == GL_TIMEOUT_EXPIRED && !wait) return;
    if (state == GL_TIMEOUT_EXPIRED || state == GL_WAIT_FAILED)
        throw std::runtime_error("depth counter: the driver does not finish counting");
    newest_.emplace();
    std::copy_n(mapped_, newest_->size(), newest_->begin());
    glDeleteSync(underWay_);
    underWay_ = nullptr;
}

void DepthCounter::prepare(const ShaderLibrary& shaders) {
    if (program_.name() != 0) return;
    program_ = compiled(shaders);
    constexpr GLbitfield access = GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
    counters_ = makeBuffer(nullptr, sizeof(DepthHistogram), access, "depth counters");
    mapped_ = static_cast<const std::uint32_t*>(
        glMapNamedBufferRange(counters_.name(), 0, sizeof(DepthHistogram), access));
    if (mapped_ == nullptr)
        throw std::runtime_error("depth counter: the driver cannot map its buffer");
}

const DepthHistogram& DepthCounter::count(const ShaderLibrary& shaders, const Texture& map,
                                          int resolution) {
    prepare(shaders);
    take(false);
    if (underWay_ == nullptr) submit(map, resolution);
    if (!newest_) take(true);
    return *newest_;
}

}  // namespace renderer

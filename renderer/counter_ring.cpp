// SPDX-License-Identifier: MIT
#include "renderer/counter_ring.h"

#include <cassert>
#include <cstring>
#include <stdexcept>
#include <string>

namespace renderer {

CounterRing::CounterRing(std::size_t counters, std::string_view label)
    : bytes_(counters * sizeof(std::uint32_t)) {
    assert(counters <= kMostCounters);
    counters_ = makeBuffer(nullptr, kSlotBytes, 0, std::string(label) + " counters");
    constexpr GLbitfield access = GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
    ring_ = makeBuffer(nullptr, kFrames * kSlotBytes, access, std::string(label) + " ring");
    mapped_ = static_cast<const std::byte*>(
        glMapNamedBufferRange(ring_.name(), 0, kFrames * kSlotBytes, access));
    if (mapped_ == nullptr)
        throw std::runtime_error(std::string(label) +
                                 " pass: the driver cannot map its read-back buffer");
}

CounterRing::~CounterRing() {
    forget();
}

void CounterRing::release() {
    glDeleteSync(fences_[oldest()]);
    ++returned_;
}

void CounterRing::forget() {
    // What is still under way is written before what takes its place.
    while (returned_ < submissions_) release();
}

void CounterRing::begin() {
    assert(hasRoom());
    const std::uint32_t zero = 0;
    glClearNamedBufferData(counters_.name(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &zero);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, counters_.name());
}

void CounterRing::end() {
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    const std::size_t at = submissions_++ % kFrames;
    glCopyNamedBufferSubData(counters_.name(), ring_.name(), 0,
                             static_cast<GLintptr>(at * kSlotBytes),
                             static_cast<GLsizeiptr>(bytes_));
    glMemoryBarrier(GL_CLIENT_MAPPED_BUFFER_BARRIER_BIT);
    fences_[at] = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    glFlush();  // or the fence might never be passed
}

std::optional<CounterRing::Reading> CounterRing::next() {
    if (returned_ == submissions_) return std::nullopt;
    GLint state = GL_UNSIGNALED;
    glGetSynciv(fences_[oldest()], GL_SYNC_STATUS, 1, nullptr, &state);
    if (state != GL_SIGNALED) return std::nullopt;
    Reading reading{.counters = {}, .submission = returned_};
    std::memcpy(reading.counters.data(), mapped_ + oldest() * kSlotBytes, bytes_);
    release();
    return reading;
}

}  // namespace renderer

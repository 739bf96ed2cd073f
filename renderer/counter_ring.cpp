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
    for (Slot& slot : slots_) release(slot);
}

void CounterRing::release(Slot& slot) {
    if (slot.fence != nullptr) glDeleteSync(slot.fence);
    slot.fence = nullptr;
}

void CounterRing::begin() {
    const std::uint32_t zero = 0;
    glClearNamedBufferData(counters_.name(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &zero);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, counters_.name());
}

void CounterRing::end() {
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    Slot& slot = slots_[submissions_ % kFrames];
    if (slot.fence != nullptr) ++lost_;
    release(slot);
    glCopyNamedBufferSubData(counters_.name(), ring_.name(), 0,
                             static_cast<GLintptr>(submissions_ % kFrames * kSlotBytes),
                             static_cast<GLsizeiptr>(bytes_));
    glMemoryBarrier(GL_CLIENT_MAPPED_BUFFER_BARRIER_BIT);
    slot = {.fence = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0), .submission = submissions_++};
    glFlush();  // or the fence might never be passed
}

std::optional<CounterRing::Reading> CounterRing::newest() {
    std::optional<Reading> reading;
    for (std::uint64_t age = 0; age < kFrames && age < submissions_ && !reading; ++age) {
        const std::size_t at = (submissions_ - 1 - age) % kFrames;
        if (slots_[at].fence == nullptr) break;  // returned before, as were those before it
        GLint state = GL_UNSIGNALED;
        glGetSynciv(slots_[at].fence, GL_SYNC_STATUS, 1, nullptr, &state);
        if (state != GL_SIGNALED) continue;
        reading.emplace();
        std::memcpy(reading->counters.data(), mapped_ + at * kSlotBytes, bytes_);
        reading->age = static_cast<int>(age);
        reading->submission = submissions_ - 1 - age;
    }
    if (!reading) return reading;
    // Older ones are of no use any more.
    for (Slot& slot : slots_)
        if (slot.submission <= reading->submission) release(slot);
    return reading;
}

}  // namespace renderer

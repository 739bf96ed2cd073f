// SPDX-License-Identifier: MIT
// How settings, states and data lie in a trace: one list of fields for each, used for writing and
// for reading alike.
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include "resolution_controller/light_set.h"

namespace resolution_controller {

/// Little-endian numbers into a buffer; stays failed once something did not fit.
class ByteWriter {
  public:
    explicit ByteWriter(std::span<std::byte> buffer) noexcept : buffer_(buffer) {}

    template <typename T>
    void number(const T& value) noexcept {
        if constexpr (std::same_as<T, bool>) {
            unsignedNumber(std::uint8_t{value});
        } else if constexpr (std::is_enum_v<T>) {
            unsignedNumber(static_cast<std::uint8_t>(value));
        } else if constexpr (std::same_as<T, double>) {
            unsignedNumber(std::bit_cast<std::uint64_t>(value));
        } else if constexpr (std::same_as<T, float>) {
            unsignedNumber(std::bit_cast<std::uint32_t>(value));
        } else {
            unsignedNumber(static_cast<std::make_unsigned_t<T>>(value));
        }
    }
    bool good() const noexcept { return good_; }
    std::size_t used() const noexcept { return used_; }

  private:
    template <std::unsigned_integral T>
    void unsignedNumber(T value) noexcept {
        if (buffer_.size() - used_ < sizeof(T)) good_ = false;
        if (!good_) return;
        for (std::size_t i = 0; i < sizeof(T); ++i) {
            buffer_[used_++] = static_cast<std::byte>(std::uint64_t{value} >> (8 * i));
        }
    }

    std::span<std::byte> buffer_;
    std::size_t used_ = 0;
    bool good_ = true;
};

/// The same the other way round; zeros once the bytes have ended.
class ByteReader {
  public:
    explicit ByteReader(std::span<const std::byte> bytes) noexcept : bytes_(bytes) {}

    template <typename T>
    void number(T& value) noexcept {
        if constexpr (std::same_as<T, bool>) {
            const auto byte = unsignedNumber<std::uint8_t>();
            if (byte > 1) good_ = false;
            value = byte == 1;
        } else if constexpr (std::is_enum_v<T>) {
            value = static_cast<T>(unsignedNumber<std::uint8_t>());
        } else if constexpr (std::same_as<T, double>) {
            value = std::bit_cast<double>(unsignedNumber<std::uint64_t>());
        } else if constexpr (std::same_as<T, float>) {
            value = std::bit_cast<float>(unsignedNumber<std::uint32_t>());
        } else {
            value = static_cast<T>(unsignedNumber<std::make_unsigned_t<T>>());
        }
    }
    template <typename T>
    T take() noexcept {
        T value{};
        number(value);
        return value;
    }
    bool good() const noexcept { return good_; }
    bool atEnd() const noexcept { return used_ == bytes_.size(); }
    std::size_t used() const noexcept { return used_; }
    std::size_t left() const noexcept { return bytes_.size() - used_; }

  private:
    template <std::unsigned_integral T>
    T unsignedNumber() noexcept {
        if (left() < sizeof(T)) good_ = false;
        if (!good_) return 0;
        std::uint64_t value = 0;
        for (std::size_t i = 0; i < sizeof(T); ++i) {
            value |= std::to_integer<std::uint64_t>(bytes_[used_++]) << (8 * i);
        }
        return static_cast<T>(value);
    }

    std::span<const std::byte> bytes_;
    std::size_t used_ = 0;
    bool good_ = true;
};

template <typename Stream, typename... T>
void numbers(Stream& stream, T&... values) noexcept {
    (stream.number(values), ...);
}

/// A struct that is written and one that is read differ in const alone.
template <typename S, typename T>
concept Is = std::same_as<std::remove_const_t<S>, T>;

template <typename Stream, Is<Settings> S>
void fields(Stream& stream, S& s) noexcept {
    numbers(stream, s.slope.c, s.slope.criterion, s.slope.task, s.slope.encoding, s.slope.beta,
            s.slope.c90, s.slope.contrastExponent, s.slope.kernel, s.slope.major, s.minSize,
            s.maxSize, s.driverMaxSize, s.levelRatio, s.percentile, s.lowerAfterFrames,
            s.lowerBelowPercent, s.startSize, s.textureSize, s.crossFadeFrames, s.pixelBound,
            s.texelsPerCaster, s.budgetPerTexel);
}

/// Since 1.3; of 1.2 only how long a need's fall is on trial.
template <typename Stream, Is<FallMemory> S>
void fields(Stream& stream, S& s) noexcept {
    numbers(stream, s.trialFrames, s.takenBack, s.pauseFrames, s.size, s.framesOnSize,
            s.needOnSize);
}

template <typename Stream, Is<ControllerState> S>
void fields(Stream& stream, S& s, Rules rules) noexcept {
    auto& d = s.last;
    numbers(stream, d.size, d.previousSize, d.changed, d.fadeFromSize, d.fadeWeight, d.reason,
            d.need, d.artifactRatio, d.shareAbove, d.minRadiusUv);
    numbers(stream, s.radiusUv, s.largestRadiusUv, s.framesBelow, s.largestNeedBelow,
            s.framesSinceCut, s.fadeFrame, s.hadData, s.cutPending, s.settingsRefused,
            s.slopeRefused);
    if (rules >= Rules::fallsRemembered) {
        numbers(stream, s.fellTo);
        fields(stream, s.falls);
    }
}

template <typename Stream, Is<HeldNeed> S>
void fields(Stream& stream, S& s, Rules rules) noexcept {
    numbers(stream, s.texels, s.framesBelow, s.largestBelow);
    if (rules == Rules::needsRemembered) {
        numbers(stream, s.fellTo, s.falls.trialFrames, s.regretted, s.fellBy);
    } else if (rules >= Rules::fallsRemembered) {
        numbers(stream, s.fellTo, s.fellBy);
        fields(stream, s.falls);
    }
}

/// What a trace keeps of a decision; the rest follows from it.
struct TracedDecision {
    std::int32_t size = 0, need = 0;
    Reason reason = Reason::heldWithoutData;
    double fadeWeight = 0, minRadiusUv = 0;

    TracedDecision() = default;
    explicit TracedDecision(const Decision& d) noexcept
        : size(d.size),
          need(d.need),
          reason(d.reason),
          fadeWeight(d.fadeWeight),
          minRadiusUv(d.minRadiusUv) {}
    bool operator==(const TracedDecision&) const = default;
};

template <typename Stream, Is<TracedDecision> S>
void fields(Stream& stream, S& s) noexcept {
    numbers(stream, s.size, s.need, s.reason, s.fadeWeight, s.minRadiusUv);
}

}  // namespace resolution_controller

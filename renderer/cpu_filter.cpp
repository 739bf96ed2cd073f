// SPDX-License-Identifier: MIT
// The files under shaders/filters, compiled as C++, and the passes between them.
#include "renderer/cpu_filter.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <stdexcept>
#include <string>

#include "renderer/cpu_penumbra.h"

namespace renderer {
namespace {

std::size_t requiredSlot(std::string_view file, std::string_view name) {
    for (const Technique& technique : techniques())
        if (technique.fileName() == file)
            if (const auto slot = technique.parameterSlot(name)) return *slot;
    throw std::logic_error("filters/" + std::string(file) + ".glsl reads PARAMETER_" +
                           std::string(name) + ", which its row in technique.cpp does not have");
}

/// One file's functions: onDepth of a technique that reads depths, the others
/// of one that reads a filtered map, onSums in place of onFiltered of one that
/// reads sums.
template <class Real>
struct CompiledFilter {
    std::string_view file;
    Real (*onDepth)(MapView, ReceiverOf<Real>, ConstantsOf<Real>);
    glm::vec<4, Real> (*mapTexel)(Real, glm::vec<2, Real>, int, ConstantsOf<Real>);
    Real (*onFiltered)(LayeredMapView<glm::vec<4, Real>>, ReceiverOf<Real>, ConstantsOf<Real>);
    Real (*onSums)(LayeredMapView<glm::uvec4>, ReceiverOf<Real>, ConstantsOf<Real>);
    Real (*radius)(MapView, ReceiverOf<Real>, ConstantsOf<Real>);  // null without one of its own
};

}  // namespace

// What PARAMETER_<name> means on the CPU: the slot that the row gives the name.
#define PARAMETER_VALUE(file, name)                                               \
    [&shadow] {                                                                   \
        static const std::size_t slot = requiredSlot(file, name);                 \
        return shadow.parameters[slot / 4][static_cast<glm::length_t>(slot % 4)]; \
    }()

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-parameter"  // not every technique needs all it is given
namespace f32 {
using GeneratedRow = CompiledFilter<float>;
#include "cpu_filters.inc"
}  // namespace f32

namespace f64 {
using GeneratedRow = CompiledFilter<double>;
#include "cpu_filters.inc"
}  // namespace f64
#pragma GCC diagnostic pop

#undef PARAMETER_VALUE

namespace {

template <class Real>
const CompiledFilter<Real>& compiled(const Technique& technique) {
    const auto find = [&](const auto& rows) -> const CompiledFilter<Real>& {
        for (const auto& row : rows)
            if (row.file == technique.fileName()) return row;
        throw std::logic_error("technique " + std::string(technique.name) + " has no file " +
                               technique.shaderFile());
    };
    if constexpr (std::is_same_v<Real, float>)
        return find(f32::kGeneratedRows);
    else
        return find(f64::kGeneratedRows);
}

template <class Real>
Real stored(Real value, MapFormat format, Storage storage) {
    if (storage == Storage::exact) return value;
    const auto narrow = static_cast<float>(value);
    if (storage == Storage::half) return static_cast<Real>(roundedToHalf(narrow));
    switch (format) {
        case MapFormat::r16f:
        case MapFormat::rg16f:
        case MapFormat::rgba16f:
        case MapFormat::rg16fSplit:
            return static_cast<Real>(roundedToHalf(narrow));
        case MapFormat::rgba16:
            return static_cast<Real>(
                static_cast<float>(std::floor(std::clamp(narrow, 0.0F, 1.0F) * 65535 + 0.5F)) /
                65535);
        default:
            return static_cast<Real>(narrow);
    }
}

template <class Real>
glm::vec<4, Real> stored(const glm::vec<4, Real>& texel, MapFormat format, Storage storage) {
    glm::vec<4, Real> kept(0);
    for (int i = 0; i < channelsOf(format); ++i) kept[i] = stored(texel[i], format, storage);
    return kept;
}

/// Adds the levels above the first.
template <class Real, class Stored>
void addMips(CpuMap<Real>& map, int levels, const Stored& storedAs) {
    int edge = map.edge;
    for (int level = 0; level < levels; ++level) {
        edge /= 2;
        for (int y = 0; y < edge; ++y)
            for (int x = 0; x < edge; ++x) {
                const glm::ivec2 texel(x, y);
                if constexpr (std::is_same_v<Real, float>)
                    map.texels.push_back(storedAs(f32::mipTexel(map.view(), texel, level)));
                else
                    map.texels.push_back(storedAs(f64::mipTexel(map.view(), texel, level)));
            }
    }
}

/// Turns the texels into sums.
template <class Real>
void sumUp(CpuMap<Real>& map, const ConstantsOf<Real>& constants) {
    const auto edge = static_cast<std::size_t>(map.edge);
    for (const auto& texel : map.texels) map.sums.push_back(unitsOf(texel, constants));
    map.texels.clear();
    for (std::size_t i = 0; i < map.sums.size(); ++i)
        if (i % edge != 0) map.sums[i] += map.sums[i - 1];
    for (std::size_t i = edge; i < map.sums.size(); ++i) map.sums[i] += map.sums[i - edge];
}

}  // namespace

float roundedToHalf(float value) {
    return glm::unpackHalf1x16(glm::packHalf1x16(value));
}

template <class Real>
CpuMap<Real> cpuMap(const Technique& technique, MapView depths, const ConstantsOf<Real>& constants,
                    Storage storage) {
    CpuMap<Real> map{.depths = depths, .edge = 0, .layers = 1, .texels = {}, .sums = {}};
    if (technique.prefilter == Prefilter::none) return map;
    const CompiledFilter<Real>& filter = compiled<Real>(technique);
    map.edge = filteredEdge(constants);
    if (const auto slot = technique.parameterSlot(technique.termsParameter)) {
        ParameterValues values{};
        const auto component = static_cast<glm::length_t>(*slot % 4);
        values[*slot] = static_cast<float>(constants.parameters[*slot / 4][component]);
        map.layers = technique.mapLayers(values);
    }
    const auto pass = [&](const auto& texelAt) {
        std::vector<glm::vec<4, Real>> out;
        out.reserve(static_cast<std::size_t>(map.layers) * static_cast<std::size_t>(map.edge) *
                    static_cast<std::size_t>(map.edge));
        for (int layer = 0; layer < map.layers; ++layer)
            for (int y = 0; y < map.edge; ++y)
                for (int x = 0; x < map.edge; ++x)
                    out.push_back(stored(packedTexel(texelAt(glm::ivec2(x, y), layer), constants),
                                         technique.format, storage));
        map.texels = std::move(out);
    };
    pass([&](const glm::ivec2& texel, int layer) {
        return filter.mapTexel(casterDepth(depths, texel, 0, constants),
                               casterSlope(depths, texel, 0, constants), layer, constants);
    });
    if (technique.prefilter == Prefilter::mips) {
        addMips(map, mipLevels(constants), [&](const glm::vec<4, Real>& texel) {
            return stored(texel, technique.format, storage);
        });
        return map;
    }
    if (technique.prefilter == Prefilter::sums) {
        sumUp(map, constants);
        return map;
    }
    if (kernelTaps(constants) == 0) return map;
    for (const glm::ivec2& axis : {glm::ivec2(1, 0), glm::ivec2(0, 1)})
        pass([&](const glm::ivec2& texel, int layer) {
            return filteredLine(map.view(), texel, axis, layer,
                                static_cast<int>(technique.prefilter), constants);
        });
    return map;
}

template <class Real>
Real cpuVisibility(const Technique& technique, const CpuMap<Real>& map,
                   const ReceiverOf<Real>& receiver, const ConstantsOf<Real>& constants) {
    const CompiledFilter<Real>& filter = compiled<Real>(technique);
    switch (technique.prefilter) {
        case Prefilter::none:
            return filter.onDepth(map.depths, receiver, constants);
        case Prefilter::sums:
            return filter.onSums(map.summedView(), receiver, constants);
        default:
            return filter.onFiltered(map.view(), receiver, constants);
    }
}

template <class Real>
Real cpuPenumbraRadiusUv(const Technique& technique, MapView depths,
                         const ReceiverOf<Real>& receiver, const ConstantsOf<Real>& constants) {
    const auto radius = compiled<Real>(technique).radius;
    return radius == nullptr ? constants.kernel.x : radius(depths, receiver, constants);
}

template CpuMap<float> cpuMap(const Technique&, MapView, const f32::ShadowConstants&, Storage);
template CpuMap<double> cpuMap(const Technique&, MapView, const f64::ShadowConstants&, Storage);
template float cpuVisibility(const Technique&, const CpuMap<float>&, const f32::ShadowReceiver&,
                             const f32::ShadowConstants&);
template double cpuVisibility(const Technique&, const CpuMap<double>&, const f64::ShadowReceiver&,
                              const f64::ShadowConstants&);
template float cpuPenumbraRadiusUv(const Technique&, MapView, const f32::ShadowReceiver&,
                                   const f32::ShadowConstants&);
template double cpuPenumbraRadiusUv(const Technique&, MapView, const f64::ShadowReceiver&,
                                    const f64::ShadowConstants&);

}  // namespace renderer

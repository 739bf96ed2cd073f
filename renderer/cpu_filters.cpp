// SPDX-License-Identifier: MIT
// The files under shaders/filters, compiled as C++.
#include <stdexcept>
#include <type_traits>

#include "renderer/technique.h"

namespace renderer {
namespace {

/// What PARAMETER_<name> means on the CPU: the slot that the technique's row gives the name.
template <class Constants>
auto parameterValue(const Constants& shadow, std::string_view technique, std::string_view name) {
    const auto& parameters = findTechnique(technique).parameters;
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        const auto component = static_cast<glm::length_t>(i % 4);
        if (parameters[i].name == name) return shadow.parameters[i / 4][component];
    }
    throw std::logic_error("filters/" + std::string(technique) + ".glsl reads PARAMETER_" +
                           std::string(name) + ", which its row in technique.cpp does not have");
}

template <class Function>
struct GeneratedFilter {
    std::string_view name;
    Function function;
};
using FloatFilter = GeneratedFilter<float (*)(MapView, f32::ShadowReceiver, f32::ShadowConstants)>;
using DoubleFilter =
    GeneratedFilter<double (*)(MapView, f64::ShadowReceiver, f64::ShadowConstants)>;

}  // namespace

namespace f32 {
using GeneratedRow = FloatFilter;
#include "cpu_filters.inc"
}  // namespace f32

namespace f64 {
using GeneratedRow = DoubleFilter;
#include "cpu_filters.inc"
}  // namespace f64

const CpuFilter& cpuFilter(const Technique& technique) {
    static const auto filters = [] {
        std::array<CpuFilter, std::size(f32::kGeneratedRows)> rows;
        for (std::size_t i = 0; i < rows.size(); ++i)
            rows[i] = {f32::kGeneratedRows[i].name, f32::kGeneratedRows[i].function,
                       f64::kGeneratedRows[i].function};
        return rows;
    }();
    for (const CpuFilter& filter : filters)
        if (filter.name == technique.name) return filter;
    throw std::logic_error("technique " + std::string(technique.name) + " has no file " +
                           technique.shaderFile());
}

}  // namespace renderer

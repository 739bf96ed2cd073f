// SPDX-License-Identifier: MIT
// What is read back from the GPU: plain rows of values, first row at the top of the screen (v = 0
// for maps).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace renderer {

template <class T>
struct Image {
    int width = 0;
    int height = 0;
    int channels = 1;
    std::vector<T> values;  ///< width * height * channels, row by row

    Image() = default;
    Image(int w, int h, int c = 1)
        : width(w),
          height(h),
          channels(c),
          values(static_cast<std::size_t>(w) * static_cast<std::size_t>(h) *
                 static_cast<std::size_t>(c)) {}

    std::size_t index(int x, int y, int channel = 0) const {
        return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                static_cast<std::size_t>(x)) *
                   static_cast<std::size_t>(channels) +
               static_cast<std::size_t>(channel);
    }
    T& at(int x, int y, int channel = 0) { return values[index(x, y, channel)]; }
    const T& at(int x, int y, int channel = 0) const { return values[index(x, y, channel)]; }
};

using FloatImage = Image<float>;
using ByteImage = Image<std::uint8_t>;

}  // namespace renderer

// SPDX-License-Identifier: MIT
// Pictures for people: PNG files, enlarged details, error pictures.
#pragma once

#include <filesystem>

#include "renderer/image.h"

namespace demo {

/// Means over blocks x blocks pixels of sRGB codes, taken in linear light. Both edges must divide
/// by `block`.
renderer::ByteImage averagedInLight(const renderer::ByteImage& image, int block);

/// PNG of 1 or 3 channels, whole or not at all. Throws std::runtime_error naming file and reason.
void writePng(const std::filesystem::path& file, const renderer::ByteImage& image);

/// Part of an image, each pixel repeated `scale` times along both axes. The part is moved into the
/// image where it sticks out.
struct Part {
    int x = 0, y = 0, width = 0, height = 0;
};
renderer::ByteImage enlarged(const renderer::ByteImage& image, Part part, int scale);

/// Where image and reference differ most, as a part of the given size: the one with the largest sum
/// of squares.
Part worstPart(const renderer::FloatImage& image, const renderer::FloatImage& reference, int width,
               int height);

/// Difference of two visibility images: white where there is none, orange where light leaks in,
/// blue where it is too dark; full colour at `full`.
renderer::ByteImage differencePicture(const renderer::FloatImage& image,
                                      const renderer::FloatImage& reference, double full);

/// The colours of differencePicture() from -full to full, with their numbers.
renderer::ByteImage differenceLegend(double full);

}  // namespace demo

// SPDX-License-Identifier: MIT
// A finished frame as a viewer shows it: split against another frame of the same view, their
// difference, or with penumbrae, demand or the map's texels painted over it.
//
//   renderer::ViewPass pass(ShaderLibrary::embedded(), demandGlsl);
//   pass.draw(frame, &other, {.view = View::difference, .gain = 8});
//   window.present(pass.framebuffer(), ...);  or  pass.read()
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "renderer/demand_pass.h"

namespace renderer {

enum class View {
    picture,
    split,       ///< this frame on the left, the other on the right of a line
    difference,  ///< of the visibilities: orange where this one is lighter, blue where darker
    demand,      ///< texels that the penumbra asks for, on a log scale
    penumbra,    ///< visibility where it is between 0 and 1
    texels,      ///< borders of the map's texels, where they are larger than two pixels
};
inline constexpr std::array<View, 6> kAllViews = {View::picture, View::split,    View::difference,
                                                  View::demand,  View::penumbra, View::texels};
std::string_view toText(View view);
/// Whether it shows a second frame.
bool compares(View view);

struct ViewSettings {
    View view = View::picture;
    float splitAt = 0.5F;  ///< the line's place, as a share of the width, [0, 1]
    float gain = 4;        ///< of the difference: 1 / gain is painted in full, > 0
    DemandRule rule;       ///< for the demand
    std::size_t map = 0;   ///< of Renderer::lightViews(), whose light and texels are shown
};

class ViewPass {
  public:
    /// The demand's colour scale goes from one to the other, texels.
    static constexpr float kLeastDemand = 64, kMostDemand = 8192;

    /// See DemandPass for `demandGlsl`. Throws std::runtime_error where it does not compile.
    ViewPass(const ShaderLibrary& shaders, const std::string& demandGlsl);

    /// Compiles what technique and rule need, if it has not been; throws as the constructor does.
    void prepare(const Technique& technique, const DemandRule& rule) {
        programs_.prepare(technique, rule);
    }

    /// Both frames are drawn, of one size and have such a map. `other` may be null for a view that
    /// does not compare. Throws std::invalid_argument otherwise.
    void draw(const Renderer& frame, const Renderer* other, const ViewSettings& settings);

    unsigned framebuffer() const { return framebuffer_.name(); }
    ByteImage read() const;  ///< sRGB codes, 3 channels

  private:
    PixelDemandPrograms programs_;
    VertexArray noGeometry_;
    Texture target_;
    Framebuffer framebuffer_;
    int widthPx_ = 0, heightPx_ = 0;
};

}  // namespace renderer

// SPDX-License-Identifier: MIT
// An OpenGL 4.5 core context without a window (EGL), and what is known of the driver behind a
// context.
//
//   renderer::HeadlessContext context;         // current on this thread from here on
//   renderer::Renderer renderer(context.info(), ...);
//
// EGL's surfaceless platform is taken where it gives a context on hardware; where it gives only a
// software rasteriser, an EGL device on hardware (NVIDIA's driver has no surfaceless platform) is
// preferred, and the software rasteriser is what remains. GlInfo says which it was.
#pragma once

#include <memory>
#include <string>

namespace renderer {

struct GlInfo {
    std::string renderer;             ///< GL_RENDERER
    std::string version;              ///< GL_VERSION
    std::string platform;             ///< "EGL surfaceless", "EGL device 0", "window"
    bool softwareRasteriser = false;  ///< time passes by finish and clock: timer queries lie there
    int maxResolution = 0;            ///< largest map edge that the driver allows, in texels
};

/// Of the context that is current on this thread. Also sets the state that all of renderer/ relies
/// on: clip space depth in [0,1], no dithering, and in Debug builds GL's debug output on standard
/// error.
GlInfo prepareCurrentContext(std::string platform);

class HeadlessContext {
  public:
    /// Throws std::runtime_error that names every platform tried and why it failed.
    HeadlessContext();
    ~HeadlessContext();
    HeadlessContext(const HeadlessContext&) = delete;
    HeadlessContext& operator=(const HeadlessContext&) = delete;

    const GlInfo& info() const { return info_; }

  private:
    struct Handle;
    std::unique_ptr<Handle> handle_;
    GlInfo info_;
};

}  // namespace renderer

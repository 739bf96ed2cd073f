// SPDX-License-Identifier: MIT
// A frame: depth pass (the light's map at N x N), prefilter of that map where the technique has
// one, prepass (visible surfaces), lookup pass (visibility of every pixel, into its own target),
// lit pass. It renders whatever N, radius and technique it is given and knows nothing of how they
// were chosen; demand_pass.h counts what a chooser needs to know of the frame.
//
//   renderer::HeadlessContext context;
//   renderer::Renderer renderer(context.info(), renderer::makeScene("yard"), 1280, 720);
//   renderer.render({.technique = &renderer::findTechnique("pcf_disc"), .resolution = 1024,
//   .radiusUv = .004F}); const renderer::ByteImage picture = renderer.readLit();
#pragma once

#include <optional>
#include <vector>

#include "renderer/depth_counter.h"
#include "renderer/gl_context.h"
#include "renderer/gl_object.h"
#include "renderer/image.h"
#include "renderer/map_filter.h"
#include "renderer/pass_clock.h"
#include "renderer/scene.h"
#include "renderer/shader_library.h"
#include "renderer/shadow_window.h"
#include "renderer/technique.h"

namespace renderer {

/// What a light's map covers: all casters, or of them what throws shadows into the view.
enum class WindowFit { casters, view };

/// Room around a window narrowed to the view, in softnesses: a kernel that grows with the distance
/// of its casters, as that of PCSS, gets this wide.
inline constexpr double kReachOfSoftness = 4;

struct FrameSettings {
    const Technique* technique = nullptr;            ///< null: the table's first
    std::optional<ParameterValues> parameters = {};  ///< absent: the technique's defaults
    int resolution = 1024;        ///< N, texels along the map's edge, 1 .. GlInfo::maxResolution
    float radiusUv = 0;           ///< kernel radius as a fraction of the map's extent, 0 .. 1
    float minRadiusUv = 0;        ///< least radius where a texel is larger than a pixel, 0 .. 1
    bool lit = true;              ///< false leaves the lit pass out
    int samplesPerPixelEdge = 1;  ///< viewport pixels along a screen pixel's edge, 1 .. 16
    /// While a change of N is faded, the visibility is fadeWeight times this map's and the rest that
    /// of a map with N = fadeFrom, drawn before it. 1: no fade, fadeFrom is not looked at.
    float fadeWeight = 1;
    int fadeFrom = 1024;

    /// Throws std::invalid_argument that names the field, its value and its range.
    void validate(const GlInfo& info) const;
};

/// A texture of 8-bit codes as a picture, 3 channels. Waits for the GPU.
ByteImage readColours(const Texture& texture, int width, int height);

class Renderer {
  public:
    /// Compiles every pass. Throws std::runtime_error for a shader that does not compile.
    Renderer(const GlInfo& info, Scene scene, int widthPx, int heightPx,
             const ShaderLibrary& shaders = ShaderLibrary::embedded());

    /// Takes these shaders from now on. Throws std::runtime_error where a pass that has been used
    /// does not compile, and then the last good programs stay.
    void reload(const ShaderLibrary& shaders);
    const ShaderLibrary& shaders() const { return shaders_; }
    /// Compiles what the technique needs, if it has not been; throws as render() would.
    void prepare(const Technique& technique);

    void setScene(Scene scene);
    void resize(int widthPx, int heightPx);
    void setCamera(const OrbitCamera& camera);
    void setSun(const Sun& sun);
    /// What the map's window is fitted to, from the next camera, sun or size on.
    void setWindowFit(WindowFit fit);
    /// How far across the light the widest kernel reads, m, so that a window narrowed to what is
    /// seen has room for it; at first kReachOfSoftness times the scene's softness.
    void setReach(double reachM);
    /// The window of another view of the same scene under the same light, to compare the two; until
    /// camera, sun, size, fit or reach change.
    void setWindow(const ShadowWindow& window);
    /// From now on the map's texture has at least this edge, and a smaller N takes a sub-rectangle
    /// of it; 0 (the default) makes the texture anew whenever N changes, exactly as large as the
    /// map.
    void reserveMap(int edge);

    const Scene& scene() const { return scene_; }
    /// As the last frame had it; its extent is already that of the next one.
    const ShadowWindow& window() const { return window_; }
    int widthPx() const { return widthPx_; }
    int heightPx() const { return heightPx_; }

    /// Draws a frame. With a clock its passes are timed. Throws std::invalid_argument for settings
    /// out of range and std::runtime_error where the driver has no room for the map or reports an
    /// error.
    void render(const FrameSettings& settings, PassClock* clock = nullptr);

    /// Textures of the last frame, for passes that read it (demand_pass.h, view_pass.h); absent
    /// before the first one.
    struct Outputs {
        GLuint positions = 0, planes = 0, normals = 0, albedos = 0, visibility = 0, lit = 0;
        GLuint depths = 0;                     ///< the shadow map, before any filter
        const Technique* technique = nullptr;  ///< never null
        bool hasKernel = false;                ///< the technique's, of a radius above 0
    };
    std::optional<Outputs> outputs() const;
    /// Binds the last frame's uniform blocks for such a pass.
    void bindConstants() const;
    /// The depths of the casters into the lower left corner of a target, `edge` texels wide, under
    /// the shadow block that is bound.
    void drawCasters(const Framebuffer& target, int edge) const;

    ByteImage readLit();          ///< sRGB codes, 3 channels
    FloatImage readVisibility();  ///< 1 lit
    FloatImage readShadowMap();   ///< N x N linear depth
    /// What the lookup read; empty after a technique without prefilter.
    FilteredTexels readFilteredMap();
    FloatImage readPositions();  ///< 4 channels: relative to the eye; w 0 is sky
    FloatImage readPlanes();     ///< 4 channels: unit normal of the triangle
    unsigned litFramebuffer() const { return litTarget_.name(); }

    /// As the last frame had them: the CPU evaluates the same pixels with these.
    const f32::ViewConstants& viewConstants() const { return view_; }
    const f32::ShadowConstants& shadowConstants() const { return shadow_; }

    std::size_t mapBytes() const;     ///< of the last frame's map and what it was filtered in
    std::size_t targetBytes() const;  ///< of everything that has the viewport's size
    std::size_t triangles() const;

  private:
    struct DrawRange {
        Material material;
        GLsizei indices = 0;
        std::size_t firstIndex = 0;
    };

    void fitWindow();
    void uploadScene();
    void updateConstants(const FrameSettings& settings);
    void ensureMap(int resolution);
    const Program& lookupProgram(const Technique& technique);
    /// Depth pass, prefilter and lookup, added to the visibility with the weight.
    void drawShadows(const FrameSettings& settings, const Technique& technique, float weight,
                     PassClock* clock);
    /// The parameters of a layered technique with the layers that the map asks for, entered into
    /// the shadow block; those of others as they are.
    ParameterValues withLayers(const Technique& technique, const ParameterValues& asked);
    void drawPrepass();
    void drawLookup(const Technique& technique, float weight);
    void drawLit();

    GlInfo info_;
    ShaderLibrary shaders_;
    Scene scene_;
    WindowFit windowFit_ = WindowFit::view;
    double reachM_ = 0;
    std::optional<int> windowStep_;  // extent of the window before
    ShadowWindow fitted_;            // before it is moved to the texel grid
    ShadowWindow window_;
    int widthPx_ = 0;
    int heightPx_ = 0;

    Buffer vertices_, indices_;
    VertexArray geometry_, noGeometry_;
    std::vector<DrawRange> ranges_;
    std::size_t indexCount_ = 0;

    Buffer viewBlock_, shadowBlock_, lookBlock_;
    f32::ViewConstants view_{};
    f32::ShadowConstants shadow_{};
    const Technique* lastTechnique_ = nullptr;  // null before the first frame
    bool lastFrameSoft_ = false;

    Program depthProgram_, prepassProgram_, litProgram_;
    std::vector<Program>
        lookupPrograms_;  // one per row of the technique table, made when first used

    int reservedEdge_ = 0;
    int mapEdge_ = 0;
    Texture map_;
    Framebuffer mapTarget_;
    MapFilter mapFilter_;
    DepthCounter depthCounter_;
    Texture positions_, planes_, normals_, albedos_, surfaceDepth_, visibility_, lit_;
    Framebuffer prepassTarget_, visibilityTarget_, litTarget_;
};

}  // namespace renderer

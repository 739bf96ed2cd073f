// SPDX-License-Identifier: MIT
// A frame: prepass (visible surfaces), then for every map of every light (light_views.h) depth pass
// (the map at N x N), prefilter of that map where the technique has one, and lookup pass
// (visibility of the pixels that the map serves, into the light's own target); lit pass. It renders
// whatever N, radius and technique it is given and knows nothing of how they were chosen;
// demand_pass.h counts what a chooser needs to know of the frame.
//
//   renderer::HeadlessContext context;
//   renderer::Renderer renderer(context.info(), renderer::makeScene("yard"), 1280, 720);
//   renderer.render({.technique = &renderer::findTechnique("pcf_disc"), .resolution = 1024,
//   .radiusUv = .004F}); const renderer::ByteImage picture = renderer.readLit();
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "renderer/depth_counter.h"
#include "renderer/gl_context.h"
#include "renderer/gl_object.h"
#include "renderer/image.h"
#include "renderer/light_views.h"
#include "renderer/map_filter.h"
#include "renderer/mesh_pieces.h"
#include "renderer/pass_clock.h"
#include "renderer/scene.h"
#include "renderer/served_pixels.h"
#include "renderer/shader_library.h"
#include "renderer/technique.h"

namespace renderer {

/// What a light's map covers: all casters, or of them what throws shadows into the view.
enum class WindowFit { casters, view };

/// Of one map, where a frame's maps differ.
struct MapSettings {
    int resolution = 1024;  ///< as in FrameSettings
    float radiusUv = 0;
    float minRadiusUv = 0;
    float fadeWeight = 1;
    int fadeFrom = 1024;
};

struct FrameSettings {
    const Technique* technique = nullptr;            ///< null: the table's first
    std::optional<ParameterValues> parameters = {};  ///< absent: the technique's defaults
    int resolution = 1024;  ///< N, texels along the map's edge, 1 .. GlInfo::maxResolution
    float radiusUv = 0;     ///< kernel radius as a fraction of the map's extent, 0 .. 1
    float minRadiusUv = 0;  ///< least radius where a texel is larger than a pixel, 0 .. 1
    bool lit = true;        ///< false leaves the lit pass out
    /// Filters a map also where nothing that is seen looks it up, as it otherwise may not; the
    /// picture is the same.
    bool filterUnseen = false;
    /// Filters a map also where nothing can lie in a penumbra (filter_tiles.h), as it otherwise may
    /// not; the picture is the same to the eye.
    bool filterOutsidePenumbrae = false;
    /// Draws the triangles too that lie outside a map or the view, as it otherwise does not; maps
    /// and picture are the same.
    bool drawOutside = false;
    int samplesPerPixelEdge = 1;  ///< viewport pixels along a screen pixel's edge, 1 .. 16
    /// While a change of N is faded, the visibility is fadeWeight times this map's and the rest
    /// that of a map with N = fadeFrom, drawn before it. 1: no fade, fadeFrom is not looked at.
    float fadeWeight = 1;
    int fadeFrom = 1024;
    /// One for each of lightViews(), in place of size, radii and fade above; empty: all maps have
    /// the same N, and only the sun's first has a least radius and a fade. Its blur in metres is
    /// that of all cascades; a lamp's is its softness.
    std::vector<MapSettings> maps = {};

    /// Throws std::invalid_argument that names the field, its value and its range.
    void validate(const GlInfo& info) const;
};

/// A texture of 8-bit codes as a picture, 3 channels. Waits for the GPU.
ByteImage readColours(const Texture& texture, int width, int height);
/// What the context's window shows at its next swap, likewise.
ByteImage readWindow(int width, int height);

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
    /// Maps of the sun, 1 to kMostCascades: each serves a stretch of the view.
    void setCascades(int count);
    /// At most kMostLamps. Throws std::invalid_argument for one that cannot be drawn.
    void setLamps(std::vector<Lamp> lamps);
    /// Those of another frame of the same view, to compare the two; until camera, lights, size, fit
    /// or reach change.
    void setLightViews(std::span<const LightView> views);
    /// From now on every map's texture has at least this edge, and a smaller N takes a
    /// sub-rectangle of it; 0 (the default) makes the texture anew whenever N changes, exactly as
    /// large as the map.
    void reserveMap(int edge);

    const Scene& scene() const { return scene_; }
    /// All maps of a frame, the sun's first. As the last frame had them; their extents are already
    /// those of the next one.
    std::span<const LightView> lightViews() const { return views_; }
    /// The pixels that each of them can matter to; a frame draws nothing of it for the others.
    std::span<const PixelRect> servedPixels() const { return served_; }
    /// Bounds of those that may show what lies between two places on a map of the last frame.
    PixelRect pixelsBetween(std::size_t view, const glm::dvec2& lowUv,
                            const glm::dvec2& highUv) const;
    /// The sun's, or its first cascade's.
    const ShadowWindow& window() const { return views_.front().window; }
    std::size_t lights() const { return 1 + scene_.lamps.size(); }
    int widthPx() const { return widthPx_; }
    int heightPx() const { return heightPx_; }

    /// What a frame with these settings gives one of lightViews().
    MapSettings mapSettings(const FrameSettings& settings, std::size_t view) const;

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
        bool hasKernel = false;                ///< of a radius above 0, or of a least one
    };
    /// Those of one of lightViews(): its map, and its light's visibility.
    std::optional<Outputs> outputs(std::size_t view = 0) const;
    /// Binds the last frame's uniform blocks for such a pass, those of one of lightViews().
    void bindConstants(std::size_t view = 0) const;
    /// The depths of the casters into the lower left corner of a target, `edge` texels wide, under
    /// the shadow block that is bound, which holds `shadow`: a view's or that of a part of it.
    /// Returns how many triangles that took: those near the map, or with `outside` all.
    std::size_t drawCasters(const Framebuffer& target, int edge, const f32::ShadowConstants& shadow,
                            bool outside = false) const;

    ByteImage readLit();                               ///< sRGB codes, 3 channels
    FloatImage readVisibility(std::size_t light = 0);  ///< 1 lit
    FloatImage readShadowMap(std::size_t view = 0);    ///< N x N linear depth
    /// What the lookup reads of one of lightViews(), filtered once more as a whole; empty after a
    /// technique without prefilter and for a map that serves no pixel.
    FilteredTexels readFilteredMap(std::size_t view = 0);
    /// Share of the tiles that the prefilter of the frame's last map had to do along lines.
    double readFilteredShare() const { return mapFilter_.readShare(); }
    FloatImage readPositions();  ///< 4 channels: relative to the eye; w 0 is sky
    FloatImage readPlanes();     ///< 4 channels: unit normal of the triangle
    unsigned litFramebuffer() const { return litTarget_.name(); }

    /// As the last frame had them: the CPU evaluates the same pixels with these.
    const f32::ViewConstants& viewConstants() const { return view_; }
    const f32::ShadowConstants& shadowConstants(std::size_t view = 0) const {
        return shadows_.at(view);
    }

    std::size_t mapBytes() const;     ///< of the last frame's map and what it was filtered in
    std::size_t targetBytes() const;  ///< of everything that has the viewport's size
    std::size_t triangles() const;    ///< of the scene
    /// That the last frame drew into its maps, a triangle once for each.
    std::size_t drawnTriangles() const { return drawnTriangles_; }

  private:
    struct DrawRange {
        Material material;
        std::vector<MeshPiece> pieces;
    };

    void fitViews();
    void useViews(std::vector<LightView> fitted);
    void makeVisibilities();
    void uploadScene();
    /// Throws std::invalid_argument for settings that are out of range or of other maps.
    void checkSettings(const FrameSettings& settings) const;
    void updateConstants(const FrameSettings& settings);
    void setShadowConstants(const FrameSettings& settings, std::size_t view, int resolution);
    void ensureMap(std::size_t view, int resolution, int samples);
    const Program& lookupProgram(const Technique& technique, bool ofPart);
    /// Of one view: depth pass, prefilter and lookup, added to the visibility with the weight.
    void drawShadows(const FrameSettings& settings, const Technique& technique, std::size_t view,
                     float weight, PassClock* clock);
    /// What the technique's prefilter makes of a view's map, but for what is left out.
    void filterMap(const Technique& technique, std::size_t view, const LeftOut& leave);
    void drawLookup(const Technique& technique, std::size_t view, float weight);
    /// Enters the layers that the map asks for into the shadow block of a layered technique.
    void enterLayers(const Technique& technique, const ParameterValues& asked, std::size_t view);
    void forgetDepths();
    void drawPrepass(bool outside);
    void clearVisibilities();
    void drawLit();

    GlInfo info_;
    ShaderLibrary shaders_;
    Scene scene_;
    WindowFit windowFit_ = WindowFit::view;
    double reachM_ = 0;
    std::vector<std::optional<int>> windowSteps_;  // extents of the sun's windows before
    std::vector<std::optional<int>> lampSteps_;    // and of the lamps'
    std::vector<LightView> fitted_;                // before they are moved to their texel grids
    std::vector<LightView> views_;
    std::vector<PixelRect> served_;  // one for each view
    Bounds surfaces_;                // of all objects
    int widthPx_ = 0;
    int heightPx_ = 0;

    Buffer vertices_, indices_;
    VertexArray geometry_, noGeometry_;
    std::vector<DrawRange> ranges_;  // one for each object
    std::vector<MeshPiece> pieces_;  // of all of them
    std::size_t indexCount_ = 0;
    std::size_t drawnTriangles_ = 0;

    Buffer viewBlock_, lookBlock_;
    std::vector<Buffer> shadowBlocks_;  // one for each view
    f32::ViewConstants view_{};
    std::vector<f32::ShadowConstants> shadows_;  // one for each view
    const Technique* lastTechnique_ = nullptr;   // null before the first frame

    Program depthProgram_, lampDepthProgram_, prepassProgram_, litProgram_, lampLitProgram_;
    /// Made when first used: for every row of the technique table one for a map that serves all
    /// pixels, then for every row one for a map that serves a part of them.
    std::vector<Program> lookupPrograms_;

    int reservedEdge_ = 0;
    struct Map {
        int edge = 0;
        Texture depths;
        Framebuffer target;
        int samples = 1;        // asked for
        Texture sampledDepths;  // beside the others, which whoever reads a depth reads
        Framebuffer sampledTarget;
    };
    std::vector<Map> maps_;  // one for each view
    MapFilter mapFilter_;
    int filterSpare_ = 0;                                       // see MapFilter::run
    std::vector<std::unique_ptr<DepthCounter>> depthCounters_;  // one for each view that has layers
    Texture positions_, planes_, normals_, albedos_, surfaceDepth_, lit_;
    Texture lampVisibilities_;           // a layer for each lamp
    std::vector<Texture> visibilities_;  // the sun's own and views of those layers
    std::vector<Framebuffer> visibilityTargets_;
    Framebuffer prepassTarget_, litTarget_;
};

}  // namespace renderer

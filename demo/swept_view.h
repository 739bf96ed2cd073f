// SPDX-License-Identifier: MIT
// The views that a sweep measures: a frame of a scene's path at a softness, in a renderer that
// keeps its programs from scene to scene.
#pragma once

#include <memory>
#include <string>

#include "demo/shadow_run.h"
#include "renderer/gl_context.h"
#include "renderer/renderer.h"
#include "renderer/scene.h"

namespace demo {

/// The scene as its paths have it at frame i of n: camera and light go on together.
struct PathView {
    renderer::OrbitCamera camera;
    renderer::Sun sun;
};
PathView pathView(const renderer::Scene& scene, int frame, int frames);

/// A scene at a softness, as the journals name it: "yard", "yard softness 2".
std::string sweptScene(const std::string& source, double softness);

class SweptView {
  public:
    SweptView(const renderer::GlInfo& info, int widthPx, int heightPx, int frames)
        : info_(info), widthPx_(widthPx), heightPx_(heightPx), frames_(frames) {}

    /// `softness` is times the scene's own; `source` as renderer::openScene() takes it.
    void show(const std::string& source, double softness, int frame);

    renderer::Renderer& renderer() const { return *renderer_; }
    /// Of the view as it is now, moved light and camera too.
    Softness softness() const;
    /// What show() set, for those who move light or camera and put them back.
    const PathView& path() const { return path_; }

  private:
    const renderer::GlInfo& info_;
    int widthPx_, heightPx_, frames_;
    std::string source_;
    double factor_ = 1;
    std::unique_ptr<renderer::Renderer> renderer_;
    renderer::Scene start_;
    PathView path_;
};

}  // namespace demo

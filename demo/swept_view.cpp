// SPDX-License-Identifier: MIT
#include "demo/swept_view.h"

#include "demo/tsv_journal.h"
#include "renderer/scene_file.h"

namespace demo {

PathView pathView(const renderer::Scene& scene, int frame, int frames) {
    const double place = static_cast<double>(frame) / frames;
    return {renderer::along(scene.cameraPath, scene.camera, place),
            renderer::along(scene.sunPath, scene.sun, place)};
}

std::string sweptScene(const std::string& source, double softness) {
    return softness == 1 ? source : source + " softness " + tsvNumber(softness);
}

void SweptView::show(const std::string& source, double softness, int frame) {
    if (!renderer_) {
        renderer_ = std::make_unique<renderer::Renderer>(info_, renderer::openScene(source),
                                                         widthPx_, heightPx_);
        // A window narrowed to the view holds its extent from the frames before, and shards and
        // resumed runs come from others.
        renderer_->setWindowFit(renderer::WindowFit::casters);
    } else if (source_ != source) {
        renderer_->setScene(renderer::openScene(source));
    }
    if (source_ != source) start_ = renderer_->scene();
    source_ = source;
    factor_ = softness;
    path_ = pathView(start_, frame, frames_);
    renderer_->setCamera(path_.camera);
    renderer_->setSun(path_.sun);
}

Softness SweptView::softness() const {
    return chooseSoftness(*renderer_, factor_ * start_.softnessM, std::nullopt);
}

}  // namespace demo

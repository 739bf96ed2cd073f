// SPDX-License-Identifier: MIT
#include "demo/model_error.h"

#include "demo/area_light_truth.h"
#include "demo/error_metrics.h"
#include "demo/shadow_run.h"
#include "demo/tsv_journal.h"
#include "program/progress.h"
#include "records/whole_file.h"
#include "renderer/renderer.h"
#include "renderer/scene_file.h"

namespace demo {
namespace {

double standardDistance() {
    const renderer::Technique& pcss = renderer::findTechnique("pcss");
    return static_cast<double>(pcss.parameters[pcss.parameterSlot("distance").value()].standard);
}

}  // namespace

void measureModelErrors(const renderer::GlInfo& info, const ModelErrorSettings& settings,
                        const records::RunContext& context) {
    TsvTable table("model_errors", kModelErrorColumns);
    table.setContext(records::contextText(context));
    program::Progress progress("model errors",
                               settings.scenes.size() * (settings.techniques.size() + 1));
    for (const std::string& scene : settings.scenes) {
        renderer::Renderer frame(info, renderer::openScene(scene), settings.widthPx,
                                 settings.heightPx);
        const Softness softness = chooseSoftness(frame, std::nullopt, std::nullopt);
        const AreaLight light{.angularRadiusDeg = angularRadiusDeg(
                                  softness.radiusM, standardDistance(), frame.window().depthRangeM),
                              .raysEdge = settings.raysEdge};
        AreaLightTruth truth;
        for (const SweptTechnique& technique : settings.techniques) {
            frame.render({.technique = technique.technique,
                          .parameters = technique.parameters,
                          .resolution = settings.resolution,
                          .radiusUv = static_cast<float>(softness.radiusUv),
                          .lit = false});
            if (truth.visibility.values.empty()) {
                truth = areaLightTruth(frame, light, settings.folder / "truth");
                progress.advance();
            }
            const VisibilityError error =
                compareVisibility(frame.readVisibility(), truth.visibility);
            table.add({scene, technique.name, std::to_string(settings.resolution),
                       tsvNumber(light.angularRadiusDeg),
                       std::to_string(2 * light.raysEdge * light.raysEdge),
                       tsvNumber(truth.standardError), std::to_string(error.penumbraPixels),
                       tsvNumber(error.rmse), tsvNumber(error.most), tsvNumber(error.p95),
                       tsvNumber(error.bias)});
            progress.advance();
        }
    }
    records::writeWholeFile(settings.folder / "model_errors.tsv", table.toText());
}

}  // namespace demo

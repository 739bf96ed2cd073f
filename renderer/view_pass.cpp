// SPDX-License-Identifier: MIT
#include "renderer/view_pass.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <stdexcept>

namespace renderer {
namespace {

ShaderOptions withViews(ShaderOptions options) {
    for (std::size_t row = 0; row < kAllViews.size(); ++row) {
        std::string name = "VIEW_" + std::string(toText(kAllViews[row]));
        for (char& letter : name)
            letter = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
        options.defines.push_back({name, std::to_string(row) + "u"});
    }
    return options;
}

}  // namespace

std::string_view toText(View view) {
    switch (view) {
        case View::picture:
            return "picture";
        case View::split:
            return "split";
        case View::difference:
            return "difference";
        case View::demand:
            return "demand";
        case View::penumbra:
            return "penumbra";
        case View::texels:
            return "texels";
    }
    return "unknown view";
}

bool compares(View view) {
    return view == View::split || view == View::difference;
}

ViewPass::ViewPass(const ShaderLibrary& shaders, const std::string& demandGlsl)
    : programs_(shaders, [library = withDemand(shaders, demandGlsl)](const ShaderOptions& options) {
          return makeProgram(library, "passes/fullscreen.vert", "passes/view.frag",
                             withViews(options));
      }) {
    GLuint name = 0;
    glCreateVertexArrays(1, &name);
    noGeometry_ = VertexArray(name);
}

void ViewPass::draw(const Renderer& frame, const Renderer* other, const ViewSettings& settings) {
    const std::size_t maps = std::min(frame.lightViews().size(),
                                      other != nullptr ? other->lightViews().size() : SIZE_MAX);
    if (settings.map >= maps)
        throw std::invalid_argument("view map is " + std::to_string(settings.map) +
                                    ", must be below " + std::to_string(maps));
    const auto own = frame.outputs(settings.map);
    const auto theirs = other != nullptr ? other->outputs(settings.map) : own;
    if (!own || !theirs || (compares(settings.view) && other == nullptr))
        throw std::invalid_argument("view " + std::string(toText(settings.view)) +
                                    ": a frame that it shows was not drawn");
    if (other != nullptr &&
        (other->widthPx() != frame.widthPx() || other->heightPx() != frame.heightPx()))
        throw std::invalid_argument("view " + std::string(toText(settings.view)) +
                                    ": the two frames differ in size");
    if (!(settings.gain > 0 && std::isfinite(settings.gain)))
        throw std::invalid_argument("view gain is " + std::to_string(settings.gain) +
                                    ", must be above 0");
    if (!(settings.splitAt >= 0 && settings.splitAt <= 1))
        throw std::invalid_argument("view split is " + std::to_string(settings.splitAt) +
                                    ", must be in [0, 1]");
    if (frame.widthPx() != widthPx_ || frame.heightPx() != heightPx_) {
        widthPx_ = frame.widthPx();
        heightPx_ = frame.heightPx();
        target_ = makeTexture(GL_RGBA8, widthPx_, heightPx_, "view");
        framebuffer_ = makeFramebuffer({target_.name()}, 0, "view");
    }
    frame.bindConstants(settings.map);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    glViewport(0, 0, widthPx_, heightPx_);
    programs_.use(*own, settings.rule);
    GLuint unit = PixelDemandPrograms::kTextures;
    for (const GLuint texture : {own->lit, theirs->visibility, theirs->lit})
        glBindTextureUnit(unit++, texture);
    glUniform1ui(2, static_cast<GLuint>(settings.view));
    glUniform2f(3, std::round(settings.splitAt * static_cast<float>(widthPx_)), settings.gain);
    glUniform2f(4, std::log2(kLeastDemand), std::log2(kMostDemand));
    glBindVertexArray(noGeometry_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

ByteImage ViewPass::read() const {
    return readColours(target_, widthPx_, heightPx_);
}

}  // namespace renderer

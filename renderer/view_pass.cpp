// SPDX-License-Identifier: MIT
#include "renderer/view_pass.h"

#include <cctype>
#include <cmath>
#include <stdexcept>

namespace renderer {
namespace {

ShaderOptions viewOptions() {
    ShaderOptions options{.defines = {}, .substitutions = {{"demand", kDemandInclude}}};
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
    : program_(makeProgram(withDemand(shaders, demandGlsl), "passes/fullscreen.vert",
                           "passes/view.frag", viewOptions())) {
    GLuint name = 0;
    glCreateVertexArrays(1, &name);
    noGeometry_ = VertexArray(name);
}

void ViewPass::draw(const Renderer& frame, const Renderer* other, const ViewSettings& settings) {
    const auto own = frame.outputs();
    const auto theirs = other != nullptr ? other->outputs() : own;
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
    frame.bindConstants();
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    glViewport(0, 0, widthPx_, heightPx_);
    GLuint unit = 0;
    for (const GLuint texture :
         {own->positions, own->planes, own->visibility, own->lit, theirs->visibility, theirs->lit})
        glBindTextureUnit(unit++, texture);
    glUseProgram(program_.name());
    glUniform1ui(0, static_cast<GLuint>(settings.view));
    glUniform2f(1, std::round(settings.splitAt * static_cast<float>(widthPx_)), settings.gain);
    const DemandRule& rule = settings.rule;
    glUniform4f(2, rule.c, rule.pixelBound, rule.contrastExponent, rule.texelsPerCaster);
    glUniform2f(3, std::log2(kLeastDemand), std::log2(kMostDemand));
    glBindVertexArray(noGeometry_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

ByteImage ViewPass::read() const {
    return readColours(target_, widthPx_, heightPx_);
}

}  // namespace renderer

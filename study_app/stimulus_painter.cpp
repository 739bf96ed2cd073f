// SPDX-License-Identifier: MIT
#include "study_app/stimulus_painter.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace study_app {
namespace {

// One triangle over the viewport, which is the image's rectangle.
constexpr const char* kVertexShader = R"(#version 330 core
void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(corner, 0.0, 1.0);
}
)";

// Rows of the image run down, those of the framebuffer up. origin = bottom left pixel.
constexpr const char* kFragmentShader = R"(#version 330 core
uniform sampler2D codes;
uniform ivec2 origin;
out vec4 color;
void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy) - origin;
    pixel.y = textureSize(codes, 0).y - 1 - pixel.y;
    color = vec4(vec3(texelFetch(codes, pixel, 0).r), 1.0);
}
)";

unsigned compiled(GLenum type, const char* source) {
    const unsigned shader = glCreateShader(type);
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    GLint ok = GL_FALSE;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    if (ok == GL_TRUE) return shader;
    std::string log(1024, '\0');
    GLsizei length = 0;
    glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), &length, log.data());
    log.resize(static_cast<std::size_t>(length));
    throw std::runtime_error("stimulus painter: the driver refuses the shader: " + log);
}

}  // namespace

StimulusPainter::StimulusPainter() {
    const unsigned vertex = compiled(GL_VERTEX_SHADER, kVertexShader);
    const unsigned fragment = compiled(GL_FRAGMENT_SHADER, kFragmentShader);
    program_ = glCreateProgram();
    glAttachShader(program_, vertex);
    glAttachShader(program_, fragment);
    glLinkProgram(program_);
    glDeleteShader(vertex);
    glDeleteShader(fragment);
    originLocation_ = glGetUniformLocation(program_, "origin");
    glGenVertexArrays(1, &vertexArray_);
    glGenTextures(1, &texture_);
    glBindTexture(GL_TEXTURE_2D, texture_);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

StimulusPainter::~StimulusPainter() {
    glDeleteTextures(1, &texture_);
    glDeleteVertexArrays(1, &vertexArray_);
    glDeleteProgram(program_);
}

void StimulusPainter::draw(const cv::Mat& codes, int x, int y, int framebufferHeightPx) {
    if (codes.empty()) return;
    const cv::Mat packed = codes.isContinuous() ? codes : codes.clone();
    const int bottom = framebufferHeightPx - y - packed.rows;
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, texture_);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_R8, packed.cols, packed.rows, 0, GL_RED, GL_UNSIGNED_BYTE,
                 packed.data);
    glDisable(GL_BLEND);
    glDisable(GL_SCISSOR_TEST);
    glViewport(x, bottom, packed.cols, packed.rows);
    glUseProgram(program_);
    glUniform2i(originLocation_, x, bottom);
    glBindVertexArray(vertexArray_);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

void requireShown(const cv::Mat& frame, const cv::Mat& codes, int x, int y) {
    for (int row = std::max(0, -y); row < std::min(codes.rows, frame.rows - y); ++row) {
        for (int column = std::max(0, -x); column < std::min(codes.cols, frame.cols - x);
             ++column) {
            const auto& shown = frame.at<cv::Vec3b>(y + row, x + column);
            const int code = codes.at<std::uint8_t>(row, column);
            if (shown[0] == code && shown[1] == code && shown[2] == code) continue;
            throw std::runtime_error(
                "stimulus: pixel (" + std::to_string(column) + ", " + std::to_string(row) +
                "): code " + std::to_string(shown[1]) + " came out of the framebuffer: must be " +
                std::to_string(code) + ": this driver or display mode changes what is shown");
        }
    }
}

}  // namespace study_app

// SPDX-License-Identifier: MIT
#include "renderer/map_filter.h"

#include <algorithm>
#include <cmath>

#include "renderer/prefilter.h"

namespace renderer {
namespace {

GLenum glFormat(MapFormat format) {
    switch (format) {
        case MapFormat::depth32f:
            return GL_DEPTH_COMPONENT32F;
        case MapFormat::r32f:
            return GL_R32F;
        case MapFormat::rg32f:
            return GL_RG32F;
        case MapFormat::rgba32f:
            return GL_RGBA32F;
        case MapFormat::r16f:
            return GL_R16F;
        case MapFormat::rg16f:
            return GL_RG16F;
        case MapFormat::rgba16f:
        case MapFormat::rg16fSplit:
            return GL_RGBA16F;
        case MapFormat::rgba16:
            return GL_RGBA16;
        case MapFormat::rg32ui:
            return GL_RG32UI;
    }
    return GL_NONE;
}

constexpr GLuint kGroup = 32;  // invocations in a group that does a row: GROUP in the passes

/// Texels that an invocation does of a line: STRIP in the pass. For a box, no more than the kernel
/// holds (map_line.comp).
constexpr GLuint kStrip = 8;
constexpr GLuint kShortStrip = 4;

ShaderOptions inRows() {
    return {.defines = {{"GROUP", std::to_string(kGroup)}}, .substitutions = {}};
}

ShaderOptions inTiles(ShaderOptions options, bool listed) {
    if (listed) options.defines.push_back({"LISTED", "1"});
    for (ShaderDefine& define : tileDefines()) options.defines.push_back(std::move(define));
    options.defines.push_back({"GROUP", std::to_string(kGroup)});
    return options;
}

bool isSeparable(Prefilter prefilter) {
    return prefilter == Prefilter::mean || prefilter == Prefilter::logMean ||
           prefilter == Prefilter::minMaxMean;
}

/// Several depths in a texel are a gap of their own.
bool marksGaps(const Technique& technique, bool sampled) {
    return isSeparable(technique.prefilter) && !sampled;
}

/// Rows go into the second one, columns back.
bool hasTwoTextures(Prefilter prefilter) {
    return isSeparable(prefilter) || prefilter == Prefilter::sums;
}

ShaderDefine prefilterDefine(Prefilter prefilter) {
    return {"PREFILTER", std::to_string(static_cast<int>(prefilter))};
}

GLuint parts(GLuint whole, GLuint size) {
    return (whole + size - 1) / size;
}

/// What was stored can be read from here on, and what is read before is not stored over.
void waitForTexels() {
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                    GL_TEXTURE_UPDATE_BARRIER_BIT);
}

std::size_t area(int edge) {
    return static_cast<std::size_t>(edge) * static_cast<std::size_t>(edge);
}

}  // namespace

MapFilter::MapFilter(const ShaderLibrary& shaders) : shaders_(shaders), tiles_(shaders) {}

void MapFilter::prepare(const Technique& technique) {
    if (technique.prefilter == Prefilter::none) return;
    convertProgram(technique, false, false);
    if (technique.prefilter == Prefilter::mips) {
        if (mipProgram_.name() == 0)
            mipProgram_ = makeComputeProgram(shaders_, "passes/map_mip.comp", inRows());
    } else if (technique.prefilter == Prefilter::sums) {
        if (sumsProgram_.name() == 0)
            sumsProgram_ = makeComputeProgram(shaders_, "passes/map_sums.comp", inRows());
    } else if (isSeparable(technique.prefilter)) {
        tiles_.prepare();
        convertProgram(technique, false, true);
        for (const GLuint strip : {kShortStrip, kStrip})
            for (const bool listed : {false, true}) lineProgram(technique, strip, listed);
    }
}

void MapFilter::prepareAs(const MapFilter& other) {
    for (const auto& [key, program] : other.convertPrograms_) {
        if (program.name() == 0) continue;  // did not compile
        const auto& [technique, sampled, listed] = key;
        prepare(*technique);
        convertProgram(*technique, sampled, listed);
    }
}

const Program& MapFilter::convertProgram(const Technique& technique, bool sampled, bool listed) {
    Program& convert = convertPrograms_[{&technique, sampled, listed}];
    if (convert.name() == 0) {
        ShaderOptions options = inTiles(techniqueOptions(technique), listed);
        if (marksGaps(technique, sampled)) options.defines.push_back({"MARKS_GAPS", "1"});
        if (sampled) {
            options.defines.push_back({"SAMPLED", "1"});
            options.defines.push_back(prefilterDefine(
                isSeparable(technique.prefilter) ? technique.prefilter : Prefilter::mean));
        }
        convert = makeComputeProgram(shaders_, "passes/map_texel.comp", options);
    }
    return convert;
}

const Program& MapFilter::lineProgram(const Technique& technique, GLuint strip, bool listed) {
    Program& line = linePrograms_[{technique.prefilter, technique.format == MapFormat::rg16fSplit,
                                   channelsOf(technique.format), strip, listed}];
    if (line.name() == 0) {
        ShaderOptions options =
            inTiles({.defines = formatDefines(technique), .substitutions = {}}, listed);
        options.defines.push_back({"STRIP", std::to_string(strip)});
        options.defines.push_back(prefilterDefine(technique.prefilter));
        line = makeComputeProgram(shaders_, "passes/map_line.comp", options);
    }
    return line;
}

void MapFilter::ensureTextures(const Technique& technique, int edge, int layers, bool keepLarger) {
    const bool fits = keepLarger ? textureEdge_ >= edge : textureEdge_ == edge;
    // The maps of a frame may differ in their layers.
    const bool fitsLayers =
        layers == layers_ || (!technique.termsParameter.empty() && layers < layers_);
    if (fits && fitsLayers && technique.format == format_ && technique.prefilter == prefilter_)
        return;
    // A wide map of few layers after a narrow one of many, in every frame, needs one that is both.
    if (keepLarger && textureEdge_ > 0 && technique.format == format_ &&
        technique.prefilter == prefilter_) {
        edge = std::max(edge, textureEdge_);
        if (!technique.termsParameter.empty()) layers = std::max(layers, layers_);
    }
    release();  // two sets at once may be more than there is room for
    const bool chain = technique.prefilter == Prefilter::mips;
    const int levels = chain ? 1 + static_cast<int>(std::log2(edge)) : 1;
    textures_[0] =
        makeTextureArray(glFormat(technique.format), edge, edge, layers, levels, "filtered map");
    if (hasTwoTextures(technique.prefilter))
        textures_[1] =
            makeTextureArray(glFormat(technique.format), edge, edge, layers, 1, "filtered rows");
    format_ = technique.format;
    prefilter_ = technique.prefilter;
    textureEdge_ = edge;
    layers_ = layers;
}

void MapFilter::release() {
    textures_ = {};
    textureEdge_ = 0;
    usedEdge_ = 0;
    tiles_.forget();
}

std::size_t MapFilter::bytes() const {
    std::size_t texels = 0;
    if (prefilter_ != Prefilter::mips)
        texels = (hasTwoTextures(prefilter_) ? 2 : 1) * area(textureEdge_);
    for (int edge = textureEdge_; prefilter_ == Prefilter::mips && edge > 0; edge /= 2)
        texels += area(edge);
    return texels * static_cast<std::size_t>(layers_) *
           static_cast<std::size_t>(bytesPerTexel(format_));
}

void MapFilter::bind(GLuint source, std::size_t target, int targetLevel) const {
    glBindTextureUnit(0, source);
    glBindImageTexture(0, textures_[target].name(), targetLevel, GL_TRUE, 0, GL_WRITE_ONLY,
                       glFormat(format_));
}

void MapFilter::dispatch(GLuint source, std::size_t target, int targetLevel, GLuint groupsX,
                         GLuint groupsY) const {
    bind(source, target, targetLevel);
    glDispatchCompute(groupsX, groupsY, static_cast<GLuint>(usedLayers_));
    waitForTexels();
}

void MapFilter::dispatchTiles(GLuint source, std::size_t target, FilterTiles::Pass pass) const {
    bind(source, target, 0);
    tiles_.dispatch(pass);
    waitForTexels();
}

void MapFilter::run(const Technique& technique, const ParameterValues& parameters,
                    const f32::ShadowConstants& shadow, const Texture& depths, int spareN,
                    LeftOut leave) {
    prepare(technique);
    usedEdge_ = 0;
    usedLevels_ = 1;
    const int edge = filteredEdge(shadow);
    const int spare = std::max(spareN - static_cast<int>(shadow.map.x), 0);
    const int layers = technique.mapLayers(parameters);
    ensureTextures(technique, edge + spare, layers, spareN > 0);
    usedEdge_ = edge;
    usedLayers_ = layers;
    const bool sampled = technique.mapSamples(parameters) > 1;
    leave.outsidePenumbrae = leave.outsidePenumbrae && marksGaps(technique, sampled);
    if (isSeparable(technique.prefilter))
        tiles_.start(shadow, layers, leave,
                     lookupSpreadTexels(technique, parameters, shadow.prefilter));
    else
        tiles_.forget();
    waitForTexels();  // another map's lookup may still read them
    glUseProgram(convertProgram(technique, sampled, tiles_.listsTexels()).name());
    if (marksGaps(technique, sampled)) tiles_.bindGaps();
    if (sampled) {
        GLint samples = 0;  // a driver may have more than it was asked for
        glGetTextureLevelParameteriv(depths.name(), 0, GL_TEXTURE_SAMPLES, &samples);
        glUniform1i(2, samples);
    }
    if (tiles_.listsTexels()) {
        dispatchTiles(depths.name(), 0, FilterTiles::Pass::texels);
    } else {
        const auto lines = static_cast<GLuint>(edge);
        dispatch(depths.name(), 0, 0, parts(lines, kGroup), parts(lines, kStrip));
    }
    switch (technique.prefilter) {
        case Prefilter::none:
        case Prefilter::converted:
            break;
        case Prefilter::mean:
        case Prefilter::logMean:
        case Prefilter::minMaxMean:
            filterLines(technique, shadow);
            break;
        case Prefilter::mips:
            addMips(mipLevels(shadow));
            break;
        case Prefilter::sums:
            sumUp();
            break;
    }
}

void MapFilter::filterLines(const Technique& technique, const f32::ShadowConstants& shadow) {
    const int taps = kernelTaps(shadow);
    if (taps == 0) return;
    const GLuint strip = 2 * taps < static_cast<int>(kStrip) ? kShortStrip : kStrip;
    const auto lines = static_cast<GLuint>(usedEdge_);
    const GLuint strips = parts(lines, strip);
    const std::array rows{parts(strips, kGroup), lines}, columns{parts(lines, kGroup), strips};
    if (tiles_.listsLines()) tiles_.listLines(rows, columns);
    filterLine(technique, strip, FilterTiles::Pass::rows, rows);
    filterLine(technique, strip, FilterTiles::Pass::columns, columns);
}

void MapFilter::filterLine(const Technique& technique, GLuint strip, FilterTiles::Pass pass,
                           std::array<GLuint, 2> groups) {
    const bool rows = pass == FilterTiles::Pass::rows;
    bind(textures_[rows ? 0 : 1].name(), rows ? 1 : 0, 0);
    const auto use = [&](bool listed) {
        glUseProgram(lineProgram(technique, strip, listed).name());
        glUniform2i(0, rows ? 1 : 0, rows ? 0 : 1);
    };
    use(false);
    if (tiles_.listsLines()) {
        tiles_.dispatchWhole(pass);
        use(true);
        tiles_.dispatch(pass);
    } else {
        glDispatchCompute(groups[0], groups[1], static_cast<GLuint>(usedLayers_));
    }
    waitForTexels();
}

void MapFilter::addMips(int levels) {
    glUseProgram(mipProgram_.name());
    for (int level = 1; level <= levels; ++level) {
        const auto edge = static_cast<GLuint>(usedEdge_ >> level);
        glUniform1i(0, level - 1);
        dispatch(textures_[0].name(), 0, level, parts(edge, kGroup), edge);
    }
    usedLevels_ = levels + 1;
}

void MapFilter::sumUp() {
    glUseProgram(sumsProgram_.name());
    const GLuint groups = parts(static_cast<GLuint>(usedEdge_), kGroup);
    glUniform2i(0, 1, 0);
    dispatch(textures_[0].name(), 1, 0, groups, 1);
    glUniform2i(0, 0, 1);
    dispatch(textures_[1].name(), 0, 0, groups, 1);
}

FilteredTexels MapFilter::read() const {
    FilteredTexels all{.edge = usedEdge_, .texels = {}, .sums = {}};
    const bool summed = prefilter_ == Prefilter::sums;
    // GL counts the bytes of one read-back in 31 bits, which a large map has more of.
    constexpr int kMostTexels = 1 << 26;
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    for (int level = 0; level < usedLevels_; ++level) {
        const int edge = usedEdge_ >> level;
        const std::size_t first = all.texels.size();
        const std::size_t texels = area(edge) * static_cast<std::size_t>(usedLayers_);
        if (summed)
            all.sums.resize(texels);
        else
            all.texels.resize(first + texels);
        const int rows = std::clamp(kMostTexels / edge, 1, edge);
        std::size_t done = 0;
        for (int layer = 0; layer < usedLayers_; ++layer)
            for (int row = 0; row < edge; row += rows) {
                const int height = std::min(rows, edge - row);
                const std::size_t count =
                    static_cast<std::size_t>(height) * static_cast<std::size_t>(edge);
                glGetTextureSubImage(textures_[0].name(), level, 0, row, layer, edge, height, 1,
                                     summed ? GL_RGBA_INTEGER : GL_RGBA,
                                     summed ? GL_UNSIGNED_INT : GL_FLOAT,
                                     static_cast<GLsizei>(count * sizeof(glm::vec4)),
                                     summed ? static_cast<void*>(&all.sums[done])
                                            : static_cast<void*>(&all.texels[first + done]));
                done += count;
            }
    }
    return all;
}

}  // namespace renderer

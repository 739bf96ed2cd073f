// SPDX-License-Identifier: MIT
#include "renderer/shader_library.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <initializer_list>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "renderer/scene.h"
#include "renderer/shader_math.h"

namespace renderer {
namespace {

std::string preamble(const ShaderOptions& options) {
    std::ostringstream text;
    text << "#version 450 core\n"
            "#define real float\n#define real2 vec2\n#define real3 vec3\n#define real4 "
            "vec4\n#define real4x4 mat4\n"
            "#define int2 ivec2\n#define int3 ivec3\n#define uint4 "
            "uvec4\n#define SHARED_FUNCTION\n"
         << "#define BINDING_VIEW " << kViewBinding << "\n#define BINDING_SHADOW " << kShadowBinding
         << "\n#define BINDING_LOOK " << kLookBinding << "\n#define PATTERN_TILES "
         << unsigned(Pattern::tiles) << "\n#define PATTERN_BANDS " << unsigned(Pattern::bands)
         << "\n";
    for (const ShaderDefine& define : options.defines)
        text << "#define " << define.name << " " << define.value << "\n";
    return text.str();
}

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// What follows `#include` on a line, or nothing where the line is no include.
std::optional<std::string> includedName(std::string_view line) {
    constexpr std::string_view kInclude = "include";
    std::string_view rest = trimmed(line);
    if (!rest.starts_with('#')) return std::nullopt;
    rest = trimmed(rest.substr(1));
    if (!rest.starts_with(kInclude)) return std::nullopt;
    rest = rest.substr(kInclude.size());
    if (!rest.empty() &&
        (std::isalnum(static_cast<unsigned char>(rest.front())) != 0 || rest.front() == '_'))
        return std::nullopt;
    return std::string(trimmed(rest));
}

/// Takes digits off the front of `text`; nothing where it does not begin with one.
std::optional<std::size_t> takeNumber(std::string_view& text) {
    std::size_t digits = 0;
    std::size_t value = 0;
    for (; digits < text.size() && digits < 9 &&
           std::isdigit(static_cast<unsigned char>(text[digits])) != 0;
         ++digits)
        value = 10 * value + static_cast<std::size_t>(text[digits] - '0');
    if (digits == 0) return std::nullopt;
    text.remove_prefix(digits);
    return value;
}

bool take(std::string_view& text, std::string_view prefix) {
    if (!text.starts_with(prefix)) return false;
    text.remove_prefix(prefix.size());
    return true;
}

/// Lines are numbered through all files, so that a driver that says 0 for every file (Mesa, of what
/// it finds out after the parser) names the right one nevertheless: so many to each.
constexpr std::size_t kLinesOfAFile = 10'000;

std::string lineDirective(std::size_t line, std::size_t file) {
    return "#line " + std::to_string(file * kLinesOfAFile + line) + " " + std::to_string(file) +
           "\n";
}

/// One line of a driver's log: Mesa "1:12(5): error: ...", NVIDIA "1(12) : error ...", others
/// "ERROR: 1:12: ...".
std::string locatedLine(std::string_view line, const std::vector<std::string>& files) {
    std::string_view rest = line;
    std::string_view severity;
    for (const std::string_view word : {"ERROR: ", "WARNING: "})
        if (take(rest, word)) severity = word;
    const auto named = takeNumber(rest);
    if (!named) return std::string(line);
    const bool inBrackets = take(rest, "(");
    if (!inBrackets && !take(rest, ":")) return std::string(line);
    const auto number = takeNumber(rest);
    if (!number || (inBrackets && !take(rest, ")"))) return std::string(line);
    const std::size_t file = *number / kLinesOfAFile;
    if (file >= files.size()) return std::string(line);
    if (!inBrackets && take(rest, "("))
        rest.remove_prefix(std::min(rest.find(')') + 1, rest.size()));  // column
    rest = trimmed(rest);
    take(rest, ":");
    std::ostringstream located;
    located << files[file] << ":" << *number % kLinesOfAFile << ": " << severity << trimmed(rest);
    return located.str();
}

class Expander {
  public:
    Expander(const ShaderLibrary& library, const ShaderOptions& options)
        : library_(library), options_(options) {}

    void expand(const std::string& path, const std::string& includedFrom, ExpandedShader& out) {
        if (std::find(open_.begin(), open_.end(), path) != open_.end())
            throw std::runtime_error(includedFrom + ": " + path + " includes itself");
        open_.push_back(path);
        const std::string& source = library_.text(path, includedFrom);
        const std::size_t number = out.files.size();
        out.files.push_back(library_.place() + path);
        out.text += lineDirective(1, number);

        std::istringstream lines(source);
        std::string line;
        for (std::size_t lineNumber = 1; std::getline(lines, line); ++lineNumber) {
            const std::optional<std::string> included = includedName(line);
            if (!included) {
                out.text += line + "\n";
                continue;
            }
            const std::string here = library_.place() + path + ":" + std::to_string(lineNumber);
            expand(resolve(*included, here), here, out);
            out.text += lineDirective(lineNumber + 1, number);
        }
        open_.pop_back();
    }

  private:
    std::string resolve(const std::string& quoted, const std::string& here) const {
        const bool isQuoted = quoted.size() > 2 && quoted.front() == '"' && quoted.back() == '"';
        if (!isQuoted || quoted.find('"', 1) != quoted.size() - 1)
            throw std::runtime_error(here +
                                     ": #include needs a name in double quotes, found: " + quoted);
        const std::string name = quoted.substr(1, quoted.size() - 2);
        const auto substitution = options_.substitutions.find(name);
        return substitution == options_.substitutions.end() ? name : substitution->second;
    }

    const ShaderLibrary& library_;
    const ShaderOptions& options_;
    std::vector<std::string> open_;
};

std::string definesInForce(const ShaderOptions& options) {
    std::string text;
    for (const ShaderDefine& define : options.defines)
        text += " " + define.name + "=" + define.value;
    return text.empty() ? "" : "\ndefines:" + text;
}

Shader compile(GLenum stage, const ShaderLibrary& library, const std::string& path,
               const ShaderOptions& options) {
    const ExpandedShader expanded = expandShader(library, path, options);
    Shader shader(glCreateShader(stage));
    const char* text = expanded.text.c_str();
    glShaderSource(shader.name(), 1, &text, nullptr);
    glCompileShader(shader.name());
    GLint compiled = GL_FALSE;
    GLint logLength = 0;
    glGetShaderiv(shader.name(), GL_COMPILE_STATUS, &compiled);
    glGetShaderiv(shader.name(), GL_INFO_LOG_LENGTH, &logLength);
    std::string log(static_cast<std::size_t>(std::max(logLength, 1)), '\0');
    glGetShaderInfoLog(shader.name(), logLength, nullptr, log.data());
    log.erase(std::find(log.begin(), log.end(), '\0'), log.end());
    const bool warned = log.find("warning") != std::string::npos;
    if (compiled != GL_TRUE || warned)
        throw std::runtime_error("shader " + library.place() + path + " does not compile" +
                                 (compiled == GL_TRUE ? " without warnings" : "") + ":\n" +
                                 locatedLog(log, expanded.files) + definesInForce(options));
    return shader;
}

// `label` shows in GL debuggers.
Program link(std::initializer_list<const Shader*> shaders, const std::string& names,
             const std::string& label, const ShaderOptions& options) {
    Program program(glCreateProgram());
    for (const Shader* shader : shaders) glAttachShader(program.name(), shader->name());
    glLinkProgram(program.name());
    GLint linked = GL_FALSE;
    glGetProgramiv(program.name(), GL_LINK_STATUS, &linked);
    if (linked != GL_TRUE) {
        std::array<GLchar, 4096> log{};
        glGetProgramInfoLog(program.name(), static_cast<GLsizei>(log.size()), nullptr, log.data());
        throw std::runtime_error("program of " + names + " does not link:\n" + log.data() +
                                 definesInForce(options));
    }
    glObjectLabel(GL_PROGRAM, program.name(), -1, label.c_str());
    return program;
}

}  // namespace

const ShaderLibrary& ShaderLibrary::embedded() {
    static const ShaderLibrary library(embeddedShaderFiles());
    return library;
}

ShaderLibrary ShaderLibrary::fromFolder(const std::filesystem::path& folder) {
    if (!std::filesystem::is_directory(folder))
        throw std::runtime_error("shader folder " + folder.string() + " does not exist");
    Files files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        const std::string extension = entry.path().extension().string();
        if (extension != ".glsl" && extension != ".vert" && extension != ".frag" &&
            extension != ".comp")
            continue;
        std::ifstream file(entry.path(), std::ios::binary);
        std::ostringstream text;
        text << file.rdbuf();
        if (!file)
            throw std::runtime_error("shader file " + entry.path().string() + " cannot be read");
        files[std::filesystem::relative(entry.path(), folder).generic_string()] = text.str();
    }
    return ShaderLibrary(std::move(files), (folder / "").string());
}

const std::string& ShaderLibrary::text(std::string_view path,
                                       const std::string& includedFrom) const {
    const auto found = files_.find(path);
    if (found == files_.end())
        throw std::runtime_error((includedFrom.empty() ? "" : includedFrom + ": ") +
                                 "shader file " + place_ + std::string(path) + " does not exist");
    return found->second;
}

std::vector<ShaderDefine> formatDefines(const Technique& technique) {
    return {{"MAP_IS_SPLIT", technique.format == MapFormat::rg16fSplit ? "true" : "false"},
            {"MAP_CHANNELS", std::to_string(channelsOf(technique.format))}};
}

ShaderOptions techniqueOptions(const Technique& technique) {
    const bool summed = technique.prefilter == Prefilter::sums;
    const std::string sampler = technique.prefilter == Prefilter::none ? "sampler2D"
                                : summed                               ? "usampler2DArray"
                                                                       : "sampler2DArray";
    ShaderOptions options{.defines = {{"TECHNIQUE", std::string(technique.name)},
                                      {"MAP_SAMPLER", sampler},
                                      {"MAP_IS_SUMMED", summed ? "1" : "0"}},
                          .substitutions = {{"technique", technique.shaderFile()}}};
    for (ShaderDefine& define : formatDefines(technique))
        options.defines.push_back(std::move(define));
    for (std::size_t i = 0; i < technique.parameters.size(); ++i)
        options.defines.push_back(
            {"PARAMETER_" + std::string(technique.parameters[i].name),
             "shadow.parameters[" + std::to_string(i / 4) + "][" + std::to_string(i % 4) + "]"});
    return options;
}

ExpandedShader expandShader(const ShaderLibrary& library, const std::string& path,
                            const ShaderOptions& options) {
    ExpandedShader expanded{.text = preamble(options), .files = {}};
    Expander(library, options).expand(path, "", expanded);
    return expanded;
}

std::string locatedLog(const std::string& log, const std::vector<std::string>& files) {
    std::istringstream lines(log);
    std::string located;
    for (std::string line; std::getline(lines, line);) located += locatedLine(line, files) + "\n";
    if (!located.empty()) located.pop_back();
    return located;
}

Program makeProgram(const ShaderLibrary& library, const std::string& vertexPath,
                    const std::string& fragmentPath, const ShaderOptions& options) {
    const Shader vertex = compile(GL_VERTEX_SHADER, library, vertexPath, options);
    const Shader fragment = compile(GL_FRAGMENT_SHADER, library, fragmentPath, options);
    return link({&vertex, &fragment}, vertexPath + " and " + fragmentPath, fragmentPath, options);
}

Program makeComputeProgram(const ShaderLibrary& library, const std::string& path,
                           const ShaderOptions& options) {
    const Shader shader = compile(GL_COMPUTE_SHADER, library, path, options);
    return link({&shader}, path, path, options);
}

}  // namespace renderer

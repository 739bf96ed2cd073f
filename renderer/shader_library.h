// SPDX-License-Identifier: MIT
// Shader files and their compilation. A shader may write `#include "path"`, the path counted from
// renderer/shaders; a name in `Substitutions` stands for a file (the lookup pass includes
// "technique"). What the driver reports is rewritten to our file and line through includes, with
// the defines that were in force.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/gl_object.h"
#include "renderer/technique.h"

namespace renderer {

class ShaderLibrary {
  public:
    using Files =
        std::map<std::string, std::string, std::less<>>;  ///< path below renderer/shaders -> text

    /// The shaders that were built into the program.
    static const ShaderLibrary& embedded();
    /// Every .vert, .frag, .comp and .glsl file below a folder, named with it in sentences. Throws
    /// std::runtime_error where it cannot be read.
    static ShaderLibrary fromFolder(const std::filesystem::path& folder);

    /// `place`: what stands before a path where a file is named in a sentence.
    explicit ShaderLibrary(Files files, std::string place = "renderer/shaders/")
        : files_(std::move(files)), place_(std::move(place)) {}

    /// Throws std::runtime_error: "shader file ... does not exist, included from file:line".
    const std::string& text(std::string_view path, const std::string& includedFrom = {}) const;
    const Files& files() const { return files_; }
    const std::string& place() const { return place_; }

  private:
    Files files_;
    std::string place_;
};

struct ShaderDefine {
    std::string name, value;
};

struct ShaderOptions {
    std::vector<ShaderDefine> defines;
    std::map<std::string, std::string> substitutions;  ///< include name -> path
};

/// Channels of the technique's map and whether its texels are split (shared/filtered_map.glsl): for
/// every pass that reads or writes them.
std::vector<ShaderDefine> formatDefines(const Technique& technique);

/// Of the passes that include "technique": its file, where each of its parameters lies, and the
/// sampler of the map that its lookup reads.
ShaderOptions techniqueOptions(const Technique& technique);

/// One source text with all includes in place, and the files that its #line directives number.
struct ExpandedShader {
    std::string text;
    std::vector<std::string> files;
};
/// Throws std::runtime_error with file and line: a missing file, an include that includes itself, a
/// bad #include.
ExpandedShader expandShader(const ShaderLibrary& library, const std::string& path,
                            const ShaderOptions& options);

/// Replaces the driver's source numbers ("0:12(5): error", "0(12) : error", "ERROR: 0:12:") by our
/// files' names.
std::string locatedLog(const std::string& log, const std::vector<std::string>& files);

/// Compiles and links a program. Throws std::runtime_error with the located log; warnings are
/// errors too.
Program makeProgram(const ShaderLibrary& library, const std::string& vertexPath,
                    const std::string& fragmentPath, const ShaderOptions& options);

/// The same of a compute shader.
Program makeComputeProgram(const ShaderLibrary& library, const std::string& path,
                           const ShaderOptions& options);

/// In generated code: the files that the build found.
const ShaderLibrary::Files& embeddedShaderFiles();

}  // namespace renderer

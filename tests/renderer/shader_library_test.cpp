// SPDX-License-Identifier: MIT
#include "renderer/shader_library.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <algorithm>
#include <fstream>

#include "renderer/gl_context.h"
#include "renderer/renderer.h"
#include "renderer/scene.h"
#include "tests/project_folders.h"
#include "tests/temporary_folder.h"

namespace {

using renderer::ShaderLibrary;
using testing::HasSubstr;

template <class Call>
std::string messageOf(const Call& call) {
    try {
        call();
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "nothing was thrown";
}

TEST(ShaderLibrary, PutsIncludesInPlaceAndNumbersTheFiles) {
    const ShaderLibrary library(
        ShaderLibrary::Files{{"a.frag", "one\n#include \"b.glsl\"\ntwo\n"}, {"b.glsl", "inner\n"}});
    const renderer::ExpandedShader expanded = expandShader(library, "a.frag", {});
    EXPECT_THAT(expanded.text, HasSubstr("#line 1 0\none\n#line 10001 1\ninner\n#line 3 0\ntwo\n"));
    EXPECT_EQ(expanded.files,
              (std::vector<std::string>{"renderer/shaders/a.frag", "renderer/shaders/b.glsl"}));
}

TEST(ShaderLibrary, NamesMissingCircularAndMalformedIncludesWithTheirPlace) {
    const ShaderLibrary library(ShaderLibrary::Files{{"missing.frag", "\n#include \"none.glsl\"\n"},
                                                     {"loop.frag", "#include \"loop.glsl\"\n"},
                                                     {"loop.glsl", "x\n#include \"loop.frag\"\n"},
                                                     {"odd.frag", "#include <odd>\n"}});
    EXPECT_EQ(
        messageOf([&] { expandShader(library, "missing.frag", {}); }),
        "renderer/shaders/missing.frag:2: shader file renderer/shaders/none.glsl does not exist");
    EXPECT_EQ(messageOf([&] { expandShader(library, "loop.frag", {}); }),
              "renderer/shaders/loop.glsl:2: loop.frag includes itself");
    EXPECT_EQ(messageOf([&] { expandShader(library, "odd.frag", {}); }),
              "renderer/shaders/odd.frag:1: #include needs a name in double quotes, found: <odd>");
    EXPECT_EQ(messageOf([&] { expandShader(library, "absent.frag", {}); }),
              "shader file renderer/shaders/absent.frag does not exist");
    EXPECT_THAT(messageOf([] { ShaderLibrary::fromFolder("/nowhere"); }), HasSubstr("/nowhere"));
}

TEST(ShaderLibrary, TranslatesWhatDriversReport) {
    const std::vector<std::string> files = {"a.frag", "b.glsl"};
    EXPECT_EQ(renderer::locatedLog("1:10012(5): error: bad\n", files),
              "b.glsl:12: error: bad");  // Mesa's parser
    EXPECT_EQ(renderer::locatedLog("0:10012(5): error: bad\n", files),
              "b.glsl:12: error: bad");  // and what comes after it
    EXPECT_EQ(renderer::locatedLog("0(7) : error C1503: bad\n", files),
              "a.frag:7: error C1503: bad");  // NVIDIA
    EXPECT_EQ(renderer::locatedLog("ERROR: 1:10003: bad\n", files),
              "b.glsl:3: ERROR: bad");  // others
    EXPECT_EQ(renderer::locatedLog("no place here\n", files), "no place here");
}

// A mistake in a technique's file, three includes deep in the lookup pass, is reported in that
// file.
TEST(ShaderLibrary, CompileErrorsNameOurFileAndLineThroughIncludes) {
    const renderer::HeadlessContext context;
    ShaderLibrary::Files files = ShaderLibrary::embedded().files();
    files["filters/pcf_disc.glsl"] =
        "// nothing\nfloat filterVisibility(sampler2D map, ShadowReceiver receiver, "
        "ShadowConstants shadow) {\n    return unknownName;\n}\n";
    renderer::Renderer renderer(context.info(), renderer::makeScene("planar_occluder"), 8, 8,
                                ShaderLibrary(files));
    const std::string message = messageOf([&] {
        renderer.render({.technique = &renderer::findTechnique("pcf_disc"), .resolution = 8});
    });
    EXPECT_THAT(message, HasSubstr("shader renderer/shaders/passes/lookup.frag does not compile"));
    EXPECT_THAT(message, HasSubstr("renderer/shaders/filters/pcf_disc.glsl:3: error"));
    EXPECT_THAT(message, HasSubstr("unknownName"));
    // What the driver finds out later: of a parameter that there is not, and of a type.
    files = ShaderLibrary::embedded().files();
    std::string& vsm = files["filters/vsm.glsl"];
    const std::string parameter = "PARAMETER_bleeding";
    const std::size_t at = vsm.rfind(parameter);
    ASSERT_NE(at, std::string::npos);
    vsm.replace(at, parameter.size(), "PARAMETER_leaking");
    const auto line =
        1 + std::count(vsm.begin(), vsm.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    renderer::Renderer other(context.info(), renderer::makeScene("planar_occluder"), 8, 8,
                             ShaderLibrary(files));
    EXPECT_THAT(messageOf([&] {
                    other.render({.technique = &renderer::findTechnique("vsm"), .resolution = 8});
                }),
                HasSubstr("renderer/shaders/filters/vsm.glsl:" + std::to_string(line) + ": error"));
    EXPECT_THAT(message, HasSubstr("PARAMETER_bias_texels=shadow.parameters[0][0]"));
}

/// The shaders of the program, but for one file.
ShaderLibrary withFile(const std::string& path, const std::string& text) {
    ShaderLibrary::Files files = ShaderLibrary::embedded().files();
    files[path] = text;
    return ShaderLibrary(std::move(files), "edited/");
}

// What a developer does all day: a mistake, and the picture stays; mended, and the picture follows.
TEST(ShaderLibrary, ReloadedShadersAreTakenWhereTheyCompileAndTheLastGoodOnesStayWhereNot) {
    const renderer::HeadlessContext context;
    renderer::Renderer frame(context.info(), renderer::makeScene("yard"), 32, 18);
    const renderer::Technique& vsm = renderer::findTechnique("vsm");
    const auto visibilityOf = [&] {
        frame.render({.technique = &vsm, .resolution = 32, .radiusUv = 0.05F});
        return frame.readVisibility().values;
    };
    const auto before = visibilityOf();

    const std::string path = "filters/vsm.glsl";
    std::string text = ShaderLibrary::embedded().text(path);
    text.replace(text.rfind("return "), 7, "return nothing + ");
    const std::string message = messageOf([&] { frame.reload(withFile(path, text)); });
    EXPECT_THAT(message, HasSubstr("edited/filters/vsm.glsl:"));
    EXPECT_THAT(message, HasSubstr("nothing"));
    EXPECT_EQ(visibilityOf(), before);

    // Of a technique that was not shown nobody asks; it is reported when it is.
    EXPECT_NO_THROW(frame.reload(withFile("filters/esm.glsl", "oops")));
    EXPECT_EQ(visibilityOf(), before);
    EXPECT_THAT(messageOf([&] { frame.prepare(renderer::findTechnique("esm")); }),
                HasSubstr("edited/filters/esm.glsl:1"));
    EXPECT_EQ(visibilityOf(), before);

    text = ShaderLibrary::embedded().text(path);
    text.replace(text.rfind("return "), 7, "return 0.5 * ");
    frame.reload(withFile(path, text));
    const auto after = visibilityOf();
    EXPECT_NE(after, before);
    for (std::size_t i = 0; i < after.size(); ++i)
        EXPECT_TRUE(after[i] == 1 || after[i] <= 0.5F) << "half, or sky";
}

// What only several depths in a texel need is compiled when it is asked for, and again.
TEST(ShaderLibrary, AReloadKeepsTheLastGoodPassesOfSampledMaps) {
    const renderer::HeadlessContext context;
    renderer::Renderer frame(context.info(), renderer::makeScene("yard"), 32, 18);
    const renderer::Technique& vsm = renderer::findTechnique("vsm");
    renderer::ParameterValues sampled = vsm.standardParameters();
    setParameter(vsm, sampled, "map_samples", 4);
    const auto visibilityOf = [&] {
        frame.render({.technique = &vsm, .parameters = sampled, .resolution = 32});
        return frame.readVisibility().values;
    };
    const std::string path = "passes/map_texel.comp";
    std::string text = ShaderLibrary::embedded().text(path);
    text.replace(text.find("float(samples)"), 14, "float(nothing)");
    EXPECT_NO_THROW(frame.reload(withFile(path, text))) << "nobody has asked for it";
    frame.reload(ShaderLibrary::embedded());
    const auto before = visibilityOf();
    EXPECT_THAT(messageOf([&] { frame.reload(withFile(path, text)); }),
                HasSubstr("edited/passes/map_texel.comp:"));
    EXPECT_EQ(visibilityOf(), before);
}

TEST(ShaderLibrary, AFolderIsNamedInWhatIsWrongWithItsFiles) {
    const tests::TemporaryFolder folder;
    std::filesystem::create_directory(folder.path() / "passes");
    std::ofstream(folder.path() / "passes/a.frag") << "\n#include \"none.glsl\"\n";
    const ShaderLibrary library = ShaderLibrary::fromFolder(folder.path());
    EXPECT_EQ(messageOf([&] { expandShader(library, "passes/a.frag", {}); }),
              (folder.path() / "passes/a.frag:2: shader file ").string() +
                  (folder.path() / "none.glsl").string() + " does not exist");
}

TEST(ShaderLibrary, EveryShaderOfTheTreeIsBuiltIn) {
    const ShaderLibrary tree =
        ShaderLibrary::fromFolder(tests::sourceFolder() / "renderer/shaders");
    EXPECT_EQ(tree.files(), ShaderLibrary::embedded().files());
}

}  // namespace

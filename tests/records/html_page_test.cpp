// SPDX-License-Identifier: MIT
#include "records/html_page.h"

#include <gmock/gmock.h>

#include <random>
#include <stdexcept>
#include <string>

#include "tests/records/scratch_folder.h"

namespace {

using namespace records;
using testing::HasSubstr;
using testing::Not;
using tests::errorOf;

const std::string kPng = std::string("\x89PNG\r\n\x1a\n", 8);

std::string unescaped(std::string text) {
    const std::pair<std::string, std::string> entities[] = {
        {"&lt;", "<"}, {"&gt;", ">"}, {"&quot;", "\""}, {"&#39;", "'"}, {"&amp;", "&"}};
    for (const auto& [entity, character] : entities)
        for (std::size_t at = 0; (at = text.find(entity, at)) != std::string::npos;
             at += character.size())
            text.replace(at, entity.size(), character);
    return text;
}

TEST(HtmlEscaped, LeavesNoMarkupAndLosesNothing) {
    std::mt19937_64 random(6);
    const std::string alphabet = "<>&\"'ab;#/ lt";
    for (int round = 0; round < 1000; ++round) {
        std::string text;
        for (int i = 0; i < 20; ++i) text += alphabet[random() % alphabet.size()];
        const std::string escaped = htmlEscaped(text);
        ASSERT_EQ(escaped.find_first_of("<>\"'"), std::string::npos);
        ASSERT_EQ(unescaped(escaped), text);
    }
}

TEST(HtmlPage, EscapesEveryTextItIsGiven) {
    const tests::ScratchFolder folder;
    tests::writeBytes(folder / "a.png", kPng);
    const std::string evil = "<script>\"'&";
    HtmlPage page(evil);
    page.heading(evil);
    page.subheading(evil);
    page.paragraph(evil);
    page.headline(evil, evil);
    page.note(evil);
    page.failure(evil);
    page.table({evil}, {{evil}}, evil);
    page.svg("<svg></svg>", evil);
    page.image(folder / "a.png", evil, evil);
    page.preformatted(evil);
    page.terms({{evil, evil}});
    EXPECT_THAT(page.text(), Not(HasSubstr("<script")));
}

TEST(HtmlPage, NeedsNoOtherFile) {
    const tests::ScratchFolder folder;
    tests::writeBytes(folder / "a.png", kPng + "M");
    HtmlPage page("t");
    page.image(folder / "a.png", "alt", "caption");
    EXPECT_THAT(page.text(), HasSubstr("src=\"data:image/png;base64,iVBORw0KGgpN\""));
    EXPECT_THAT(page.text(), Not(HasSubstr("http")));
    EXPECT_THAT(page.text(), Not(HasSubstr("<link")));
    page.write(folder / "out/page.html");
    EXPECT_EQ(tests::readBytes(folder / "out/page.html"), page.text());
}

TEST(HtmlPage, PadsBase64) {
    const tests::ScratchFolder folder;
    for (const auto& [bytes, text] : {std::pair{"", "iVBORw0KGgo=\""},
                                      {"M", "KGgpN\""},
                                      {"Ma", "KGgpNYQ==\""},
                                      {"Man", "KGgpNYW4=\""}}) {
        tests::writeBytes(folder / "a.png", kPng + bytes);
        HtmlPage page("t");
        page.image(folder / "a.png", "", "");
        EXPECT_THAT(page.text(), HasSubstr(text));
    }
}

TEST(HtmlPage, ListsTermsWithTheirTexts) {
    HtmlPage page("t");
    page.terms({{"law", "holds"}, {"light", "does not matter"}});
    EXPECT_THAT(page.text(), HasSubstr("<dl>\n<dt>law</dt><dd>holds</dd>\n<dt>light</dt>"));
}

TEST(SvgForBothSchemes, AddsAStyleThatThePageTakesOutAgain) {
    const std::string svg = "<?xml version=\"1.0\"?>\n<svg width=\"3\"><path d=\"M0,0\"/></svg>\n";
    const std::string both = svgForBothSchemes(svg);
    EXPECT_THAT(both, HasSubstr("prefers-color-scheme: dark"));
    EXPECT_THAT(both, HasSubstr("<svg width=\"3\">\n<style>"));
    HtmlPage page("t"), plain("t");
    page.svg(both, "");
    plain.svg(svg, "");
    // The page's own style says it once for all figures.
    const auto count = [](const std::string& text) {
        std::size_t n = 0;
        for (std::size_t at = 0; (at = text.find("invert(", at)) != std::string::npos; ++at) ++n;
        return n;
    };
    EXPECT_EQ(count(page.text()), count(plain.text()));
    EXPECT_THAT(errorOf<std::invalid_argument>([] { svgForBothSchemes("no figure"); }),
                HasSubstr("no <svg>"));
}

TEST(HtmlPage, AlignsColumnsOfNumbersToTheRight) {
    HtmlPage page("t");
    page.table({"group", "c", "trials"},
               {{"stair", "3.4 [3.2, 3.6]", "n/a"}, {"step", "<.001", ""}}, "Table 1");
    EXPECT_THAT(page.text(), HasSubstr("<th>group</th><th class=\"number\">c</th>"));
    EXPECT_THAT(page.text(), HasSubstr("<td>step</td><td class=\"number\">&lt;.001</td>"));
}

TEST(HtmlPage, KeepsWordsToTheLeft) {
    for (const char* word : {"2afc", "stair", "e", "(none)", "3afc task", "1st"}) {
        HtmlPage page("t");
        page.table({"x"}, {{word}}, "");
        EXPECT_THAT(page.text(), HasSubstr("<td>" + std::string(word) + "</td>"));
    }
    for (const char* number : {"12", "-0.4", "1,600", "1.5 ms", "82 %", ".646", "1e-05",
                               "512 x 512", "[2.3, 2.7]", "< .001", "3.4 [3.2, 3.6]"}) {
        HtmlPage page("t");
        page.table({"x"}, {{number}}, "");
        EXPECT_THAT(page.text(), HasSubstr("<td class=\"number\">")) << number;
    }
}

TEST(HtmlPage, KeepsTheIdsOfItsFiguresApart) {
    const std::string figure =
        "<?xml version=\"1.0\"?><!DOCTYPE svg><svg id='a'><title>Gnuplot</title>"
        "<path id=\"gpPt0\"/><use xlink:href='#gpPt0'/><rect fill=\"url(#p)\"/></svg>\n";
    HtmlPage page("t");
    page.svg(figure, "one");
    page.svg(figure, "two");
    EXPECT_THAT(page.text(),
                HasSubstr("<path id=\"figure1-gpPt0\"/><use xlink:href='#figure1-gpPt0'/>"
                          "<rect fill=\"url(#figure1-p)\"/>"));
    EXPECT_THAT(page.text(), HasSubstr("<path id=\"figure2-gpPt0\"/>"));
    EXPECT_THAT(page.text(), Not(HasSubstr("<?xml")));
    EXPECT_THAT(page.text(), Not(HasSubstr("<!DOCTYPE svg")));
    EXPECT_THAT(page.text(), Not(HasSubstr("Gnuplot")));
}

TEST(HtmlPage, RefusesWhatItCannotShow) {
    const tests::ScratchFolder folder;
    tests::writeBytes(folder / "a.png", "GIF89a");
    HtmlPage page("t");
    EXPECT_THAT(errorOf<std::runtime_error>([&] { page.image(folder / "a.png", "", ""); }),
                HasSubstr("a.png: is no PNG image"));
    EXPECT_THAT(errorOf<std::runtime_error>([&] { page.image(folder / "b.png", "", ""); }),
                HasSubstr("b.png: cannot be read"));
    EXPECT_THAT(errorOf<std::invalid_argument>([&] { page.svg("no figure", ""); }),
                HasSubstr("\"no figure\": holds no <svg> element"));
    EXPECT_THAT(errorOf<std::invalid_argument>([&] {
                    page.table({"a", "b"}, {{"1"}}, "T");
                }),
                HasSubstr("table \"T\": a row has 1 cells: must have 2"));
}

}  // namespace

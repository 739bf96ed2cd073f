// SPDX-License-Identifier: MIT
#include "records/html_page.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "records/html_style.h"
#include "records/quoted_text.h"
#include "records/whole_file.h"

namespace records {

namespace {

constexpr std::string_view kPngSignature = "\x89PNG\r\n\x1a\n";

// The page's style says the same of all its figures.
constexpr std::string_view kBothSchemes =
    "<style>@media screen and (prefers-color-scheme: dark) "
    "{ svg { filter: invert(0.9) hue-rotate(180deg) } }</style>\n";

std::string base64(std::string_view bytes) {
    static constexpr char kDigits[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        unsigned group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group = group << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            text += k <= count ? kDigits[group >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

std::string embeddedPng(const std::filesystem::path& png, const std::string& alt) {
    const std::string bytes = readWholeFile(png);
    if (!bytes.starts_with(kPngSignature))
        throw std::runtime_error(png.string() + ": is no PNG image");
    return "<img alt=\"" + htmlEscaped(alt) + "\" src=\"data:image/png;base64," + base64(bytes) +
           "\">";
}

std::string captionOf(const std::string& text) {
    return text.empty() ? "" : "<figcaption>" + htmlEscaped(text) + "</figcaption>";
}

// What belongs into a column of numbers: "12", "-0.4", "3.4 [3.2, 3.6]", "1.5 ms", "82 %", ".646",
// "n/a", "". Not "2afc": a word is text.
bool isNumeric(const std::string& cell) {
    if (cell.empty() || cell == "n/a" || cell == "-") return true;
    const std::string_view digits = "0123456789";
    const std::size_t start = cell.find_first_not_of("+-<>=~[( ");
    if (start == std::string::npos) return false;
    const std::size_t end =
        std::min(cell.find_first_not_of("0123456789.,eE+-", start), cell.size());
    const std::string number = cell.substr(start, end - start);
    if (number.find_first_of(digits) > 1) return false;  // ".646" has one character before
    return end == cell.size() ||
           std::string_view(" %[]()x/").find(cell[end]) != std::string_view::npos;
}

std::string tableRow(const std::string& tag, const std::vector<std::string>& cells,
                     const std::vector<bool>& numeric) {
    std::string row = "<tr>";
    for (std::size_t i = 0; i < cells.size(); ++i)
        row += "<" + tag + (numeric[i] ? " class=\"number\">" : ">") + htmlEscaped(cells[i]) +
               "</" + tag + ">";
    return row + "</tr>\n";
}

void insertAfterEach(std::string& text, std::string_view mark, const std::string& insertion) {
    for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at)) {
        at += mark.size();
        text.insert(at, insertion);
    }
}

// Several figures share one page, and gnuplot names the parts of each alike: without a prefix, the
// second figure would show the first one's symbols.
std::string svgElement(const std::string& svgText, const std::string& idPrefix) {
    const std::size_t start = svgText.find("<svg");
    const std::size_t end = svgText.rfind("</svg>");
    if (start == std::string::npos || end == std::string::npos || end < start)
        throw std::invalid_argument("figure: " + quotedText(svgText) + ": holds no <svg> element");
    std::string svg = svgText.substr(start, end + 6 - start);
    for (const std::string_view mark :
         {" id=\"", " id='", "href=\"#", "href='#", "url(#", "url('#"})
        insertAfterEach(svg, mark, idPrefix);
    if (const std::size_t at = svg.find(kBothSchemes); at != std::string::npos)
        svg.erase(at, kBothSchemes.size());
    // gnuplot titles its figures "Gnuplot", which a browser would show under the mouse.
    for (std::size_t at; (at = svg.find("<title>Gnuplot</title>")) != std::string::npos;)
        svg.erase(at, std::string_view("<title>Gnuplot</title>").size());
    return svg;
}

}  // namespace

std::string htmlEscaped(const std::string& text) {
    std::string out;
    out.reserve(text.size());
    for (const char character : text) {
        switch (character) {
            case '&':
                out += "&amp;";
                break;
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '"':
                out += "&quot;";
                break;
            case '\'':
                out += "&#39;";
                break;
            case '\0':
                out += "\xef\xbf\xbd";
                break;  // U+FFFD: HTML forbids NUL
            default:
                out += character;
        }
    }
    return out;
}

std::string svgForBothSchemes(const std::string& svgText) {
    const std::size_t start = svgText.find("<svg");
    const std::size_t end = start == std::string::npos ? start : svgText.find('>', start);
    if (end == std::string::npos)
        throw std::invalid_argument("figure: " + quotedText(svgText) + ": holds no <svg> element");
    std::string svg = svgText;
    return svg.insert(end + 1, "\n" + std::string(kBothSchemes));
}

HtmlPage::HtmlPage(std::string title) : title_(std::move(title)) {}

void HtmlPage::element(const std::string& tag, const std::string& text) {
    body_ += "<" + tag + ">" + htmlEscaped(text) + "</" + tag + ">\n";
}

void HtmlPage::heading(const std::string& text) {
    element("h2", text);
}
void HtmlPage::subheading(const std::string& text) {
    element("h3", text);
}
void HtmlPage::paragraph(const std::string& text) {
    element("p", text);
}
void HtmlPage::preformatted(const std::string& text) {
    element("pre", text);
}

void HtmlPage::terms(const std::vector<std::pair<std::string, std::string>>& list) {
    body_ += "<dl>\n";
    for (const auto& [term, text] : list)
        body_ += "<dt>" + htmlEscaped(term) + "</dt><dd>" + htmlEscaped(text) + "</dd>\n";
    body_ += "</dl>\n";
}

void HtmlPage::headline(const std::string& number, const std::string& meaning) {
    body_ += "<div class=\"headline\"><p class=\"value\">" + htmlEscaped(number) +
             "</p><p class=\"meaning\">" + htmlEscaped(meaning) + "</p></div>\n";
}

void HtmlPage::note(const std::string& text) {
    body_ += "<p class=\"note\" role=\"note\">" + htmlEscaped(text) + "</p>\n";
}

void HtmlPage::failure(const std::string& text) {
    body_ += "<p class=\"failure\" role=\"alert\">" + htmlEscaped(text) + "</p>\n";
}

void HtmlPage::table(const std::vector<std::string>& head,
                     const std::vector<std::vector<std::string>>& rows,
                     const std::string& caption) {
    std::vector<bool> numeric(head.size(), !rows.empty());
    for (const std::vector<std::string>& row : rows) {
        if (row.size() != head.size())
            throw std::invalid_argument("table " + quotedText(caption) + ": a row has " +
                                        std::to_string(row.size()) + " cells: must have " +
                                        std::to_string(head.size()));
        for (std::size_t i = 0; i < row.size(); ++i) numeric[i] = numeric[i] && isNumeric(row[i]);
    }
    // Focusable, so that the keyboard can scroll it.
    body_ += "<figure class=\"table\">" + captionOf(caption) +
             "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"" +
             htmlEscaped(caption.empty() ? "table" : caption) + "\"><table>\n<thead>" +
             tableRow("th", head, numeric) + "</thead>\n<tbody>";
    for (const std::vector<std::string>& row : rows) body_ += tableRow("td", row, numeric);
    body_ += "</tbody></table></div></figure>\n";
}

void HtmlPage::svg(const std::string& svgText, const std::string& caption) {
    const std::string prefix = "figure" + std::to_string(++figures_) + "-";
    body_ += "<figure><div class=\"paper\" role=\"img\" aria-label=\"" + htmlEscaped(caption) +
             "\">" + svgElement(svgText, prefix) + "</div>" + captionOf(caption) + "</figure>\n";
}

void HtmlPage::image(const std::filesystem::path& png, const std::string& alt,
                     const std::string& caption) {
    body_ += "<figure>" + embeddedPng(png, alt) + captionOf(caption) + "</figure>\n";
}

void HtmlPage::gallery(const std::vector<Picture>& pictures) {
    body_ += "<div class=\"gallery\">\n";
    for (const Picture& picture : pictures) image(picture.png, picture.alt, picture.caption);
    body_ += "</div>\n";
}

std::string HtmlPage::text() const {
    return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
           "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
           htmlEscaped(title_) + "</title>\n<style>" + std::string(kHtmlStyle) +
           "</style>\n</head>\n<body>\n<main>\n<h1>" + htmlEscaped(title_) + "</h1>\n" + body_ +
           "</main>\n</body>\n</html>\n";
}

void HtmlPage::write(const std::filesystem::path& file) const {
    writeWholeFile(file, text());
}

}  // namespace records

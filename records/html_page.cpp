// SPDX-License-Identifier: MIT
#include "records/html_page.h"

#include <utility>

#include "records/whole_file.h"

namespace records {

namespace {

constexpr std::string_view kStyle = R"css(
:root { color-scheme: light dark; }
body { max-width: 60rem; margin: 2rem auto; padding: 0 1rem; font: 16px/1.55 system-ui, sans-serif; }
)css";

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

}  // namespace

std::string htmlEscaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '&')
            out += "&amp;";
        else if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '"')
            out += "&quot;";
        else
            out += c;
    }
    return out;
}

HtmlPage::HtmlPage(std::string title) : title_(std::move(title)) {}
void HtmlPage::heading(const std::string& text) {
    body_ += "<h2>" + htmlEscaped(text) + "</h2>\n";
}
void HtmlPage::subheading(const std::string& text) {
    body_ += "<h3>" + htmlEscaped(text) + "</h3>\n";
}
void HtmlPage::paragraph(const std::string& text) {
    body_ += "<p>" + htmlEscaped(text) + "</p>\n";
}
void HtmlPage::headline(const std::string& number, const std::string& meaning) {
    body_ += "<p class=\"headline\"><strong>" + htmlEscaped(number) + "</strong> " +
             htmlEscaped(meaning) + "</p>\n";
}
void HtmlPage::table(const std::vector<std::string>& head,
                     const std::vector<std::vector<std::string>>& rows,
                     const std::string& caption) {
    body_ += "<table><caption>" + htmlEscaped(caption) + "</caption><tr>";
    for (const auto& cell : head) body_ += "<th>" + htmlEscaped(cell) + "</th>";
    body_ += "</tr>\n";
    for (const auto& row : rows) {
        body_ += "<tr>";
        for (const auto& cell : row) body_ += "<td>" + htmlEscaped(cell) + "</td>";
        body_ += "</tr>\n";
    }
    body_ += "</table>\n";
}
void HtmlPage::svg(const std::string& svgText, const std::string& caption) {
    body_ +=
        "<figure>" + svgText + "<figcaption>" + htmlEscaped(caption) + "</figcaption></figure>\n";
}
void HtmlPage::image(const std::filesystem::path& png, const std::string& alt,
                     const std::string& caption) {
    body_ += "<figure><img alt=\"" + htmlEscaped(alt) + "\" src=\"data:image/png;base64," +
             base64(readWholeFile(png)) + "\"><figcaption>" + htmlEscaped(caption) +
             "</figcaption></figure>\n";
}
void HtmlPage::preformatted(const std::string& text) {
    body_ += "<pre>" + htmlEscaped(text) + "</pre>\n";
}
std::string HtmlPage::text() const {
    return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>" +
           htmlEscaped(title_) + "</title><style>" + std::string(kStyle) +
           "</style></head><body><h1>" + htmlEscaped(title_) + "</h1>\n" + body_ +
           "</body></html>\n";
}
void HtmlPage::write(const std::filesystem::path& file) const {
    writeWholeFile(file, text());
}

}  // namespace records

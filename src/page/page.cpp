#include "page/page.h"

#include "error.h"
#include "image/atomic_file.h"
#include "page/page_text.h"

#include <charconv>
#include <cmath>

namespace wavepath {

namespace {

std::string escaped(std::string_view text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '"':
                result += "&quot;";
                break;
            default:
                result += c;
        }
    }
    return result;
}

// Begins as a number does: "12", "-1.5e-3", ".98 to 1.02", "7 %"; "infinite" does not.
bool is_number(const std::string& text) {
    double value = 0;
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && std::isfinite(value);
}

std::string row_of(
    const char* tag, const std::vector<std::string>& cells, const std::vector<bool>& numbers) {
    std::string html = "<tr>";
    for (std::size_t i = 0; i < cells.size(); ++i)
        html += fmt::format(
            "<{}{}>{}</{}>", tag, i < numbers.size() && numbers[i] ? " class=\"number\"" : "",
            escaped(cells[i]), tag);
    return html + "</tr>\n";
}

// The names of a chart's parts, which have to be others than those of the page's other charts.
std::string with_own_names(std::string svg, std::size_t place) {
    for (const std::string_view name : {"gpDot", "gpPt", "textbox", "greybox", "gnuplot_"}) {
        const std::string own = fmt::format("c{}{}", place, name);
        for (std::size_t at = 0; (at = svg.find(name, at)) != std::string::npos; at += own.size())
            svg.replace(at, name.size(), own);
    }
    return svg;
}

}  // namespace

Page::Page(const std::string& title) : title_(escaped(title)) {}

void Page::heading(const std::string& text) {
    body_ += fmt::format("<h2>{}</h2>\n", escaped(text));
}

void Page::paragraph(const std::string& text) {
    body_ += fmt::format("<p>{}</p>\n", escaped(text));
}

void Page::command(const std::string& line) {
    body_ += fmt::format("<pre><code>{}</code></pre>\n", escaped(line));
}

void Page::table(const Table& table) {
    std::vector<bool> numbers(table.columns.size(), !table.rows.empty());
    for (const auto& row : table.rows)
        for (std::size_t i = 0; i < row.size() && i < numbers.size(); ++i)
            numbers[i] = numbers[i] && (row[i].empty() || row[i] == "-" || is_number(row[i]));
    body_ += "<div class=\"wide\"><table>\n<thead>" + row_of("th", table.columns, numbers) +
             "</thead>\n<tbody>\n";
    for (const auto& row : table.rows) body_ += row_of("td", row, numbers);
    body_ += "</tbody></table></div>\n";
}

void Page::chart(const Chart& chart) {
    body_ += fmt::format(
        "<figure role=\"img\" aria-label=\"{}\">{}</figure>\n", escaped(chart.title),
        with_own_names(draw_svg(chart), body_.size()));
}

void Page::pictures(const std::vector<Picture>& pictures) {
    body_ += "<div class=\"pictures\">\n";
    for (const Picture& picture : pictures) {
        body_ += fmt::format(
            "<figure><div class=\"view\"><img src=\"{}\" alt=\"{}\"></div><figcaption>{}",
            escaped(picture.file.string()), escaped(picture.title), escaped(picture.title));
        if (!picture.command.empty())
            body_ += fmt::format(
                "<details><summary>command</summary><pre><code>{}</code></pre></details>",
                escaped(picture.command));
        body_ += "</figcaption></figure>\n";
    }
    body_ += "</div>\n";
}

void Page::write(const std::filesystem::path& path) const {
    AtomicFile(path).commit(fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width\">\n<title>{}</title>\n"
        "<style>{}</style></head>\n<body><h1>{}</h1>\n{}<script>{}</script></body></html>\n",
        title_, page_style, title_, body_, page_script));
}

}  // namespace wavepath

#include "report_page.h"

namespace bough {
namespace {

constexpr const char* style = R"css(
:root { color-scheme: light dark; --paper: #ffffff; --ink: #1c2024; --soft: #5c6670; --line: #d9dee3; --frame: #1b1b1b; --band: #f4f6f8;
  --held: #8fd1b9; --outside: #f2c14e; --failed: #e0704a; --not-run: #c9c9c9; }
@media (prefers-color-scheme: dark) { :root { --paper: #15181b; --ink: #e6e9ec; --soft: #9aa5af; --line: #343b42; --frame: #ffffff;
  --band: #1d2125; } }
body { margin: 0 auto; padding: 2rem 1.5rem 4rem; max-width: 1320px; background: var(--paper); color: var(--ink);
  font: 15px/1.5 system-ui, -apple-system, "Segoe UI", Helvetica, Arial, sans-serif; }
h1 { font-size: 1.55rem; margin: 0 0 1rem; } h2 { font-size: 1.1rem; margin: 2.2rem 0 .6rem; }
dl { display: grid; grid-template-columns: repeat(auto-fill, minmax(165px, 1fr)); gap: .8rem 1.2rem; margin: 0 0 1.5rem; }
dl div { border-left: 3px solid var(--line); padding-left: .7rem; }
dt { color: var(--soft); font-size: .8rem; } dd { margin: 0; font-variant-numeric: tabular-nums; font-weight: 600; }
figure { margin: 0; border: 1px solid var(--line); border-radius: 6px; padding: .5rem; overflow-x: auto; }
figure svg { display: block; max-width: 100%; height: auto; }
figure svg rect[fill="#ffffff"] { fill: var(--paper); }
figure svg g[color="black"] { color: var(--ink); }
figure svg g[fill="black"], figure svg g[fill="rgb(0,0,0)"] { fill: var(--ink); }
figure svg path[stroke="rgb( 27,  27,  27)"] { stroke: var(--frame); }
p { margin: .5rem 0; color: var(--soft); }
.scroll { overflow-x: auto; border: 1px solid var(--line); border-radius: 6px; }
table { border-collapse: collapse; width: 100%; font-size: .79rem; font-variant-numeric: tabular-nums; }
th, td { padding: .28rem .45rem; text-align: right; white-space: nowrap; border-bottom: 1px solid var(--line); }
thead th { background: var(--band); font-weight: 600; } th.text, td.text { text-align: left; }
td.note { text-align: left; white-space: normal; min-width: 16rem; }
th.head { text-align: left; background: var(--band); }
td.held, td.outside, td.failed, td.not-run { text-align: left; color: #1b1b1b; }
td.held { background: var(--held); } td.outside { background: var(--outside); }
td.failed { background: var(--failed); } td.not-run { background: var(--not-run); }
pre { background: var(--band); border: 1px solid var(--line); border-radius: 6px; padding: .7rem .9rem; overflow-x: auto;
  font-size: .82rem; margin: .5rem 0; }
@media print { body { max-width: none; padding: 0; } }
)css";

std::string table_text(const PageTable& table) {
    std::string text = "<div class=\"scroll\"><table>\n<thead><tr>";
    const auto marked = [](const char* element, const char* mark) {
        return std::string("<") + element + (*mark ? std::string(" class=\"") + mark + "\"" : std::string()) + ">";
    };
    // A column stands left where its first row's cell does.
    std::vector<const char*> marks(table.names.size(), "");
    for (const auto& row : table.rows)
        if (row.size() == table.names.size()) {
            for (std::size_t k = 0; k < row.size(); ++k) marks[k] = *row[k].mark ? "text" : "";
            break;
        }
    for (std::size_t k = 0; k < table.names.size(); ++k)
        text += marked("th", marks[k]) + escaped_markup(table.names[k]) + "</th>";
    text += "</tr></thead>\n<tbody>\n";
    for (const std::vector<PageCell>& row : table.rows) {
        text += "<tr>";
        if (row.size() == 1 && std::string_view(row[0].mark) == "head")
            text += "<th class=\"head\" colspan=\"" + std::to_string(table.names.size()) + "\">" +
                    escaped_markup(row[0].text) + "</th>";
        else
            for (const PageCell& cell : row) text += marked("td", cell.mark) + escaped_markup(cell.text) + "</td>";
        text += "</tr>\n";
    }
    return text + "</tbody></table></div>\n";
}

} // namespace

void write_page(Output& output, const Page& page, const ReportMeta& meta) {
    const std::string title = escaped_markup(page.title);
    output.write("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                 "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
                 title + "</title>\n<style>" + style + "</style>\n</head>\n<body>\n<h1>" + title + "</h1>\n<dl>\n");
    for (const auto& [name, value] : page.summary)
        output.write("<div><dt>" + escaped_markup(name) + "</dt><dd>" + escaped_markup(value) + "</dd></div>\n");
    output.write("</dl>\n<figure>\n" + page.svg + "\n</figure>\n");
    for (const std::string& note : page.notes) output.write("<p>" + escaped_markup(note) + "</p>\n");
    output.write("<h2>Figures</h2>\n" + table_text(page.table));
    for (const auto& [name, table] : page.more)
        output.write("<h2>" + escaped_markup(name) + "</h2>\n" + table_text(table));
    output.write("<h2>Made by</h2>\n");
    if (!meta.source.empty()) output.write("<pre>" + escaped_markup(meta.source) + "</pre>\n");
    output.write("<p>" +
                 escaped_markup(meta.tool + " " + meta.version + " (bough), " + meta.compiler + ", " +
                                std::to_string(meta.threads) + (meta.threads == 1 ? " thread" : " threads") +
                                ", flags " + meta.flags) +
                 "</p>\n</body>\n</html>\n");
}

} // namespace bough

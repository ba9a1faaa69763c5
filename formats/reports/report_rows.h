// report_rows.h: what the reports of treeprofile's subcommands share: who made one, its rows as
// named values for JSON and CSV, and figures for people.
#pragma once
#include "formats/open.h"
#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace bough {

// What a report was made with.
struct ReportMeta {
    std::string tool, version, compiler, flags;
    int threads = 1;
    std::string source; // command lines, one a line; empty with --no-source
};

// One value under its name, the same in JSON and in CSV. A number that is not finite is null, in CSV an empty cell.
using ReportValue = std::variant<std::string, double, std::int64_t, bool>;
using ReportRow = std::vector<std::pair<std::string, ReportValue>>;

// {"format": format, "version": 1, tool, tool_version, compiler, flags, threads, then `head`, "rows_name": [a row a
// line], "source"}. Texts that are no UTF-8 are made so.
void write_rows_json(Output&, const char* format, const ReportMeta&, const ReportRow& head, const char* rows_name,
                     const std::vector<ReportRow>& rows);
// The same with several lists, each under its name.
using ReportList = std::pair<const char*, std::vector<ReportRow>>;
void write_lists_json(Output&, const char* format, const ReportMeta&, const ReportRow& head,
                      const std::vector<ReportList>& lists);
// A line of names, then a line a row; cells are quoted (RFC 4180) where they must be. Without rows, `names` alone.
void write_rows_csv(Output&, const ReportRow& names, const std::vector<ReportRow>& rows);

// ---- figures for people, independent of the locale ----
std::string percent(double share);                 // "12.3%", "0.0012%", "non-finite"
std::string known(std::string text, double value); // the text, "-" for a value that is not finite
std::string figure(double value);                  // 3 digits: "0.0123", "1.2e-07", "non-finite"
std::string padded(std::string, int width);        // > 0: at the right of so many columns, < 0: at the left
std::string steps_text(double steps_per_frame);    // "1/4", "16"
std::string escaped_markup(std::string_view);      // for the text of HTML and XML, and for quoted attributes

} // namespace bough

// report_page.h: what the pages of reports share: HTML of one file that opens from disk and loads nothing, readable in
// light and dark.
#pragma once
#include "report_rows.h"

namespace bough {

struct PageCell {
    std::string text;      // not yet escaped
    const char* mark = ""; // class: "held", "outside", "failed", "not-run"; "text" stands left; "head" spans the table
};
struct PageTable {
    std::vector<std::string> names;
    std::vector<std::vector<PageCell>> rows; // one cell marked "head": a heading over the rows that follow
};

// summary: names and figures on top; notes: plain sentences under the picture.
struct Page {
    std::string title;
    std::vector<std::pair<std::string, std::string>> summary;
    std::string svg;
    std::vector<std::string> notes;
    PageTable table;
    std::vector<std::pair<std::string, PageTable>> more; // further tables under their titles
};
void write_page(Output&, const Page&, const ReportMeta&);

} // namespace bough

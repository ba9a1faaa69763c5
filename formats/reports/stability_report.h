// stability_report.h: what `treeprofile stability` writes: the document "bough-stability-report" (formats/reports/README.md), CSV,
// and a table; and how a cell is judged, for these and for the tool's exit code.
#pragma once
#include "lib/study/stability.h"
#include "report_rows.h"

namespace bough {

// not_run: no frames. failed: non-finite, unbounded or not moving as the truth does, and promised or within the method's assumption. outside: outside
// the assumption and not promised, whatever it did.
enum class CellState { held, outside, failed, not_run };
CellState cell_state(const StabilityCell&);
// One word or two: "held", "outside", "outside, unbounded", "outside, non-finite", "unbounded", "non-finite", "moves
// wrongly", "outside, moves wrongly", "not run".
std::string cell_verdict(const StabilityCell&);

// A promised cell holds if it ran, stayed finite and bounded and, where it is compared, moved as the truth does.
struct PromiseCount {
    std::int64_t promised = 0, held = 0;
};
PromiseCount promise_count(const StabilityReport&);
std::string promise_text(const StabilityReport&); // "promised 40 of 40 hold"

void write_stability_json(Output&, const StabilityReport&, const ReportMeta&);
void write_stability_csv(Output&, const StabilityReport&); // one row a cell

// For people, at most 120 columns but for long notes: a summary, a row a cell under its group's name, the count of the
// promised cells.
std::string stability_table(const StabilityReport&);

// The groups in the order of their first cell.
std::vector<std::string> stability_groups(const StabilityReport&);

} // namespace bough

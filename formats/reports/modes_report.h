// modes_report.h: what `treeprofile modes` writes: a table, the document "bough-modes-report" (formats/reports/README.md), CSV, and a picture of
// shapes.
#pragma once
#include "lib/study/modes.h"
#include "report_rows.h"

namespace bough {

struct ModesReport {
    std::string name;  // of the tree
    std::string wind;  // as asked for; empty: still air
    double mass = 0;   // [kg]
    double height = 0; // [m] of its highest end over its lowest joint
    std::int64_t bodies = 0;
    std::vector<NaturalMode> modes;
    std::vector<std::int32_t> branch; // of each mode's farthest end
    std::vector<std::int32_t> level;
    std::int64_t branches = 0;                    // of the tree
    std::vector<std::vector<BranchMotion>> moves; // of each mode, as many as were asked for or there are
};

std::string modes_table(const ModesReport&);
void write_modes_json(Output&, const ModesReport&, const ReportMeta&);
void write_modes_csv(Output&, const ModesReport&);

// One mode as the picture shows it: bodies as lines, the tree standing, and what of it moves swung to one side, seen across the widest way.
struct DrawnShape {
    std::string title;
    struct Line {
        double x0, y0, x1, y1; // [m]
    };
    std::vector<Line> standing, swung;
};
// name: the file it is for. Throws OutputError where gnuplot cannot be run.
std::string modes_svg(const std::vector<DrawnShape>&, const std::string& name);

} // namespace bough

// report.h: what a run cost, stage by stage: the document that `treeprofile --report` writes and `treeprofile compare`
// reads (formats/reports/README.md). JSON or, for spreadsheets, CSV with one row a stage.
#pragma once
#include "formats/open.h"
#include <cstdint>
#include <string>
#include <vector>

namespace bough {

struct ReportStage {
    std::string name; // "composite" ...; "other" is the time of a step outside all stages
    std::int64_t calls = 0;
    double seconds = 0;           // [s] of all calls
    double ns_per_body_frame = 0; // [ns]
    double share = 0;             // [1] of the total; all stages together give 1
};

struct Report {
    std::string tool, version, compiler, flags, simd, solver, precision, hash;
    std::string scheme; // of the coupled solver; empty with all others
    std::int64_t bodies = 0;
    std::int64_t frames = 0; // measured: the first one, a warm-up, is left out
    int threads = 1, substeps = 1;
    double total_ns_per_body_frame = 0;
    std::vector<ReportStage> stages;
    std::string source; // command line, empty with --no-source
};

void write_report_json(Output&, const Report&);
void write_report_csv(Output&, const Report&);
// Reads the JSON form. Throws InputError that names the field.
Report read_report(std::string_view content, const std::string& name);

} // namespace bough

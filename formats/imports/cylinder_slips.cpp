#include "cylinder_slips.h"
#include "formats/error.h"
#include "formats/plain_text.h"
#include "lib/base/counted.h"
#include "on_polyline.h"
#include "placed_import.h"
#include <algorithm>

namespace bough {
namespace {

double gap(const Cylinders& c, std::size_t child, std::size_t parent) {
    const Vec3 &a = c.start[parent], &b = c.end[parent], &p = c.start[child];
    return (p - (a + projected(a, b, p) * (b - a))).norm();
}

// Whether the rows from a root to the next, one at least, are better joined if their parents count from the root.
bool starts_again(const Cylinders& c, std::size_t root, std::size_t end) {
    double as_written = 0, from_root = 0; // [file unit] sums of gaps
    for (std::size_t i = root + 1; i < end; ++i) {
        const auto p = std::size_t(c.parent[i]);
        if (root + p >= c.size()) return false;
        as_written += gap(c, i, p);
        from_root += gap(c, i, root + p);
    }
    return end > root + 1 && from_root <= as_written; // one scan twice in a file is as close either way
}

} // namespace

void refuse_second_scan(const Cylinders& c, const std::string& name) {
    std::size_t root = 0;
    for (std::size_t i = 1; i <= c.size(); ++i) {
        if (i < c.size() && c.parent[i] >= 0) continue;
        if (root > 0 && starts_again(c, root, i))
            throw InputError(file_line(name, c.line[root]),
                             "begins a second scan, whose parents count from its own first row; expected parents that "
                             "count all rows of the file, or one scan in a file");
        root = i;
    }
}

void note_cut(const Cylinders& c, const std::vector<std::int32_t>& extension, ImportNotes& notes) {
    const auto size = std::int32_t(c.size());
    std::size_t lost = 0, first = 0;
    for (std::size_t i = 0; i < extension.size(); ++i) {
        const std::int32_t e = extension[i];
        const bool is_anothers = i + 1 == c.size() && e >= 0 && e < size && c.parent[std::size_t(e)] != std::int32_t(i);
        if (e != size && !is_anothers) continue;
        if (lost++ == 0) first = i;
    }
    if (lost == 0) return;
    notes.lines.push_back("line " + std::to_string(c.line[first]) + ": its extension is " +
                          (extension[first] == size ? "not in the file" : "another cylinder's child") +
                          (lost > 1 ? ", nor are those of " + counted(lost - 1, "other row", "other rows") : "") +
                          "; was the file cut off?");
}

void find_odd_radius(const Cylinders& c, const std::string& name, ImportNotes& notes) {
    const Box a = box_of(c.start), b = box_of(c.end);
    const double extent = (a.high.cwiseMax(b.high) - a.low.cwiseMin(b.low)).maxCoeff();
    const auto odd = odd_radius(c.radius, extent, "units");
    if (!odd) return;
    const std::string found = "radius is " + odd->text;
    if (odd->is_refused)
        throw InputError(file_line(name, c.line[odd->at]), found + "; expected less than the tree is large");
    notes.lines.push_back("line " + std::to_string(c.line[odd->at]) + ": " + found + ": is it a slip?");
    notes.odd_radius_told = true;
}

} // namespace bough

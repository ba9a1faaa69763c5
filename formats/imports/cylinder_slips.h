// cylinder_slips.h: what went wrong with a table of cylinders before it came here: two scans pasted together, rows cut off.
#pragma once
#include "cylinders.h"

namespace bough {

// Throws InputError with FILE:LINE where a second scan begins whose parents count from its own first row, not the file's: a cylinder without a
// parent follows others, and the rows after it lie as close or closer to their parents if these count from it. Such rows
// would be knitted to the scan above. For parents that are numbers of rows. O(cylinders).
void refuse_second_scan(const Cylinders&, const std::string& name);

// A note with the first row whose `extension`, the cylinder that goes on it (an index, -1: none, size(): not there), is not in the table, or, of the
// last row, is another's child: the number itself was cut. O(cylinders).
void note_cut(const Cylinders&, const std::vector<std::int32_t>& extension, ImportNotes&);

// Throws InputError with FILE:LINE for a radius as no tree has it (odd_radius), or notes it. O(cylinders).
void find_odd_radius(const Cylinders&, const std::string& name, ImportNotes&);

} // namespace bough

// skeleton_writer.h: splines as the skeleton formats of other programs, read back by swc.cpp and treetools.cpp.
//
// Both in metres and Z up (x, -z, y of ours), one line of notes for each thing that is lost (spline_nodes.h); numbers are
// the shortest decimals that give the same double. Nodes stand before what they bear.
//   SWC        comments, among them "# bough: metres, Z up" by which our reader need not guess; then
//              id type x y z radius parent, ids from 1, type 0 (undefined), parent -1 at a root.
//   treetools  comments, the line x,y,z,radius,parent_id, then a line a trunk: its foot (parent_id -1; the format uses no
//              radius there), then each segment's tip, with the radius there, and the number of the one it grows on.
// O(points + branches log branches). Throws OutputError.
#pragma once
#include "formats/open.h"
#include "lib/model/splines.h"

namespace bough {

void write_swc(Output&, const Splines&, std::vector<std::string>& notes);
void write_treetools(Output&, const Splines&, std::vector<std::string>& notes);

// What the SWC writer says of unit and axis, a comment's whole text.
constexpr const char* swc_frame = "bough: metres, Z up";

} // namespace bough

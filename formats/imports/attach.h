// attach.h: pieces of trees that do not touch (curves without parents, components of a graph) joined by proximity into
// trees that stand on the ground.
#pragma once
#include "nearest_segment.h"
#include <memory>

namespace bough {

struct Pieces {
    std::vector<Vec3> point;          // [file unit]
    std::vector<double> radius;       // [file unit] one a point, <= 0: unknown
    std::vector<LineSegment> segment; // of every piece at least one
    std::vector<std::int32_t> end;    // points by which pieces may be joined to others, piece by piece
    std::vector<std::size_t> first;   // pieces + 1 entries into `end`; of every piece at least one
    std::vector<std::int32_t> base;   // of each piece: the one end it begins with, or -1: any of its ends
    bool curves = false;              // each piece has two ends, and the segments from a point to the next between them
    std::size_t size() const { return base.size(); }
};

struct JoinedPiece {
    std::int32_t end = -1;       // the point that the piece begins with
    std::int32_t parent = -1;    // piece, -1: it stands on the ground
    std::int32_t a = -1, b = -1; // segment of the parent where it is joined
    double t = 0, gap = 0;       // fraction of the way from a to b; [file unit] distance
};

// For each piece where it begins and on what. On the ground stands the piece with the thickest or, without radii, the
// longest wood that reaches down to it (lowest twentieth of the height); so do others a quarter as long whose end is
// down there too and that touch none above it, and those which are far from all others (half their own length). A
// piece on the ground begins at its thickest end in the lower half, or, without radii, its lowest.
// All others are joined by the end, and to the place, that cost least (nearest_segment.h); circles are opened where that
// adds least (Edmonds' rule). `up` is 'y' or 'z'. O((segments + ends) log segments), times log pieces for circles.
// Takes the segments out of `pieces`, which a large file has no memory to hold twice. Searches run on several threads
// (lib/base/parallel.h); how many changes nothing.
std::vector<JoinedPiece> attach_pieces(Pieces& pieces, char up);

// The same in two steps, for who wants to search before it is known which end each piece begins with. `pieces` must
// outlive it; `base` may be changed until join(), which is called once.
class PieceJoiner {
public:
    PieceJoiner(Pieces& pieces, char up);
    ~PieceJoiner();
    const SegmentSearch& search() const; // every piece a group of its own; there are pieces
    std::vector<JoinedPiece> join();

private:
    class Work;
    std::unique_ptr<Work> work_;
};

} // namespace bough

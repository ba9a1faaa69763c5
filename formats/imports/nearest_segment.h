// nearest_segment.h: the nearest of many segments to a point, over pieces of wood (curves, parts of a graph) that have
// radii where those are known. Segments are sorted by size and along a Morton curve, and boxed in a tree of bounds, four to
// a node so that one look at it tells of all four. Making it O(segments log segments); a search O(log segments) in the usual case.
#pragma once
#include "lib/base/math.h"
#include "line_segment.h"
#include <limits>
#include <span>
#include <vector>

namespace bough {

// A place on a segment and what it costs to join there: the distance d, and inside the wood (d < radius r) d^3 / r^2,
// so that of several stems around a joint the one counts that holds it deepest. Ten times what the place is thinner than
// the end that is to begin there comes on top, as wood does not begin on thinner wood.
struct SegmentPlace {
    LineSegment segment; // a: -1 for none
    double t = 0;        // fraction of the way from a to b
    double distance = 0, cost = std::numeric_limits<double>::infinity();
};

class SegmentSearch {
public:
    // `point`, `radius` (one a point; <= 0: unknown) and `base` must outlive the search. `base`: of each piece the point
    // that it begins with, -1 where that is unknown. No place is given at a base, nor within the asking end's radius (or,
    // if smaller, the base's own) of it: what begins at one place has the same parent. (Where more
    // than 256 begin, one of them is the parent: looking further would take a time that grows with their square.)
    SegmentSearch(const std::vector<Vec3>& point, const std::vector<double>& radius,
                  const std::vector<std::int32_t>& base, std::vector<LineSegment> segments, std::size_t pieces);

    // Pieces of one group are no places for one another. At first each piece is a group of its own. O(segments).
    void regroup(const std::vector<std::int32_t>& group);

    // The cheapest place for this point that is not in `group` and costs less than `bound`; of equally cheap ones that on
    // the segment whose points come first. `likely`: segments that may well be near; they change nothing but the time
    // taken. May be called by several threads at once.
    SegmentPlace nearest(std::int32_t point, std::int32_t group, double bound = std::numeric_limits<double>::infinity(),
                         std::span<const LineSegment> likely = {}) const;

    // False only where nearest() finds nothing for any of these points. What many points that lie close together ask is
    // answered in one search, if they lie far from all others.
    bool may_find(std::span<const std::int32_t> points, std::int32_t group, double bound) const;

private:
    static constexpr std::size_t wide = 4; // boxes of a node, segments of a block
    // Boxes side by side, rounded outward to floats. On the lowest level each holds a block of segments.
    using Floats = Eigen::Array<float, wide, 1>;
    struct Node {
        Floats low[3], high[3];
        Floats thickest;          // largest radius of a segment's ends
        std::int32_t first[wide]; // the first point of its segments; the largest number there is: no such box
        std::int32_t group[wide]; // of all in it, or -1: several
    };
    struct Asked; // a search that is going on
    void set_box(Node&, std::size_t at, std::size_t block) const;
    void set_group(Node&, std::size_t at, std::size_t block) const;
    static void join_boxes(const Node& parts, Node&, std::size_t at);
    static std::int32_t common_group(const Node&);
    void try_segment(const LineSegment&, Asked&) const;
    void try_block(std::size_t block, Asked&) const;

    const std::vector<Vec3>& point_;
    const std::vector<double>& radius_;
    const std::vector<std::int32_t>& base_;
    std::vector<LineSegment> segments_;
    std::vector<std::vector<Node>> levels_; // from blocks of segments up to one node
    std::vector<std::int32_t> group_;       // of each piece
};

} // namespace bough

// sapling_family.h: one stem by the rules of Sapling (rules.h) with all that splits off it, in Sapling's axes: z up.
//
// Private to growth. A family depends on its stem's key and length, not on what was drawn before.
#pragma once
#include "stem.h"
#include <vector>

namespace bough {

struct SaplingStem {
    RandomKey key = 0;
    int level = 0;
    std::int32_t parent = -1; // branch of the splines
    double parent_at = 0;
    Vec3 position = Vec3::Zero(), direction = Vec3::UnitZ();
    double segment_length = 0;               // [m] before its variation
    double radius_start = 0, radius_end = 0; // [m]
    double children = 0;                     // or leaves
    double scale = 0;                        // [m] of the tree
};

// A line of points; the first is the stem itself, the others split off one before them.
struct SaplingPiece {
    RandomKey key = 0;
    int parent = -1;      // piece
    std::size_t from = 0; // point of it where this one starts
    std::vector<Vec3> point;
    std::vector<double> radius;
    Vec3 heading = Vec3::UnitZ(); // of the last segment, or before the first
    double segment_length = 0, radius_start = 0, radius_end = 0;
    double offset = 0; // [m] of its start along the stem
    double curve = 0;  // [rad] a segment
    int made = 0;      // segments, those of the stem before its start too
    int split_last = -1;
    double turned = 0; // [rad] of the last split
    double sign = 1;
};

// The frame whose z is a direction and whose x is level, y as far up as can be.
Quat level_frame(const Vec3& direction);

// Throws std::invalid_argument where a stem splits into more than kMostPieces.
std::vector<SaplingPiece> sapling_family(const GrowthParameters&, const SaplingStem&);

constexpr double kMostPieces = 1e6;

// The number of pieces that a stem of this level is expected to split into; more than kMostPieces is infinite. As for
// splits by length, the stem is as long as its level's stems get.
double sapling_pieces(const GrowthParameters&, int level);

} // namespace bough

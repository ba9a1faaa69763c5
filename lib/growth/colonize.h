// colonize.h: a tree that fills a volume, by space colonization (Runions, Lane, Prusinkiewicz, "Modeling Trees with a
// Space Colonization Algorithm", 2007).
//
// Attraction points are drawn uniformly from an envelope. A trunk rises to it. Then, round by round: each attraction
// point within the influence radius of the tree pulls at the node nearest to it; each node that is pulled grows a child
// one step away, in the direction of the sum of the unit vectors to its points plus the tropism; points that a node has
// come nearer to than the kill distance are removed. It ends when no node is pulled.
//
// Readings taken where the paper is open:
//   Stalling. A node pulled equally from two sides would grow the same child for ever (the paper's method then never
//     ends). Here a child counts only if it comes nearer, by a quarter of a step, to one of the points that pulled; else
//     the node steps straight toward the nearest of them alone. So every round brings a point nearer by step / 4, and
//     growth ends after at most points * (4 influence / step + 1) nodes.
//   Inside. A child outside the envelope, or one whose way there has its middle outside, is not grown; the node tries the straight step likewise.
//     Where that too leaves the envelope (across the notch of a concave one), the point waits until another node is the nearest to it; points
//     that still wait at the end are counted as blocked, those never within the influence radius as out of reach.
//   Trunk. It stands below the middle of the attraction points (where that line misses the envelope, below the point
//     nearest to it), rises straight from the ground (or the envelope's lowest level where that is deeper) and through
//     `leader` of the crown's height, on until a point is within the influence radius, never out of the envelope, and
//     half a step at least unless the envelope ends before. Only its nodes inside the envelope bear branches.
//   Branches. At a fork the child goes on that bears most, weighted by how straight it goes: tips (1 + cos) / 2. The
//     others begin branches one level deeper. Kinks between steps are smoothed (twice 1/4, 1/2, 1/4; a node
//     that this would move out of the envelope stays), and points that the curve does without, within step / 20, are
//     left out. So the branches' points lie inside; between two of them a branch may cross a corner that juts in.
//   Radii. By the pipe model with exponent 2 (pipe.h) from `tip_radius`; leaves and fruit grow on the last
//     stretch, `leafy` long, of each branch.
#pragma once
#include "../model/splines.h"
#include "envelope.h"
#include <cstdint>

namespace bough {

// A length of 0 means its default, which scales with the envelope: s below is the mean spacing of attraction points,
// (volume / points)^(1/3), h the height from the foot of the trunk to the envelope's top.
struct ColonizeParameters {
    Envelope envelope;
    std::int64_t points = 8000;  // attraction points, 1..2e7
    double influence = 0;        // [m] > kill; default 6 s
    double kill = 0;             // [m] >= step; default 0.8 s
    double step = 0;             // [m] between nodes, >= h / 1e7; default half the kill distance
    Vec3 tropism = {0, 0.1, 0};  // added to the unit direction; 0 none, y > 0 upward
    double leader = -1;          // 0..1, of the envelope's height; negative: 0.8 in a cone, else 0.25
    double tip_radius = 0;       // [m]; default such that the trunk's is h / 60 at its foot, but at least 0.5 mm
    double leaves = 10;          // of each tip; where not whole, rounded up as often as the fraction says
    double leaf_length = 0;      // [m]; default 0.4 s, but 0.03 to 0.3 m
    double leaf_width = 0;       // [m]; default 0.55 of the length
    double leaf_angle = 50;      // [deg] between leaf and twig
    double leafy = 0;            // [m] of a branch's end that bears leaves and fruit; default 1.5 s
    double fruits = 0.3;         // of each tip
    double fruit_radius = 0.008; // [m]
    std::string name = "colonized";
};

// The same with every default put in. Throws std::invalid_argument that names the parameter, its value and what was
// expected.
ColonizeParameters with_defaults(const ColonizeParameters&);

// What grew, before it is made into branches. Nodes stand parents first.
struct Colony {
    std::vector<Vec3> node;            // [m]
    std::vector<std::int32_t> parent;  // -1: the foot of the trunk, node 0
    std::int32_t crown = 0;            // the first node that may bear branches; those before it are the trunk below
    std::vector<Vec3> point;           // [m] the attraction points
    std::vector<std::uint8_t> reached; // of each point: a node came within the kill distance
    std::int64_t blocked = 0, out_of_reach = 0; // points not reached
};

// Parameters as with_defaults() gives them. Throws std::invalid_argument where the trunk comes within the influence of no
// point. Each round goes
// over the points left, and there are about as many rounds as the longest branch has steps: O(points * rounds + nodes
// (influence / s)^3).
Colony colonize_nodes(const ColonizeParameters&, std::uint64_t seed);

// The colony as branches with radii, and leaves and fruit where wanted. O(nodes log nodes).
Splines colony_splines(const Colony&, const ColonizeParameters&, std::uint64_t seed, bool with_leaves, bool with_fruit);

struct ColonizeReport {
    std::int64_t points = 0, blocked = 0, out_of_reach = 0;
};

// All of it. Same parameters and seed, same bytes.
Splines colonize(const ColonizeParameters&, std::uint64_t seed, bool with_leaves, bool with_fruit,
                 ColonizeReport* report = nullptr);

} // namespace bough

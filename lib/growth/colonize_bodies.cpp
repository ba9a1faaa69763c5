#include "colonize.h"
#include "segment.h"
#include <algorithm>
#include <stdexcept>

namespace bough {
namespace {

constexpr double kNear = 0.05, kWithin = 0.1; // share of the bodies wanted: the search ends; the contract allows
constexpr std::int64_t kMostBodies = 20'000'000, kMostPoints = 20'000'000;
constexpr double kPilot = 30'000;  // points of the first tree tried, and of those tried many times, at most
constexpr int kGrowths = 12;       // with different numbers of points
constexpr double kFull = 0.1;      // of the bodies that more points should have given: the volume holds no more nodes
constexpr double kFewPoints = 100; // below, a tree's count says little about that of a larger one

struct Search {
    ColonizeParameters parameters;
    std::uint64_t seed;
    bool with_leaves, with_fruit;
    double bodies;
    Splines best;
    ColonizeReport report;
    double best_count = -1;
    std::int64_t best_points = 0;

    // Lengths given stay as they are while points come closer, so that their number may cease to matter.
    bool lengths_given() const { return parameters.kill > 0 || parameters.step > 0; }
    bool small() const { return static_cast<double>(best_points) <= kPilot; }
    bool near(double share) const { return best_count >= 0 && std::abs(best_count - bodies) <= share * bodies; }

    // Bodies that so many points give; remembers the nearest.
    double count(std::int64_t points) {
        ColonizeParameters p = parameters;
        p.points = points;
        ColonizeReport now;
        Splines tree = colonize(p, seed, with_leaves, with_fruit, &now);
        const auto found = static_cast<double>(count_bodies(tree, SegmentOptions()));
        if (best_count < 0 || std::abs(found - bodies) < std::abs(best_count - bodies)) {
            best = std::move(tree);
            report = now;
            best_count = found;
            best_points = points;
        }
        return found;
    }
};

// A count is nearly proportional to the number of points: goes on by the factor missed, between the bounds known. A large
// tree's first number is that of a small one scaled up, so that few large ones are grown. Returns whether more points
// would help no more.
bool search_points(Search& s) {
    std::int64_t low = 0, high = kMostPoints + 1;
    double low_found = 0;
    auto points = static_cast<std::int64_t>(std::clamp(s.bodies / 4, 1.0, kPilot));
    for (int i = 0; i < kGrowths; ++i) {
        const double found = s.count(points);
        if (s.near(kNear)) return false;
        const double ratio = static_cast<double>(points) / static_cast<double>(std::max<std::int64_t>(low, 1));
        if (found < s.bodies && static_cast<double>(low) >= kFewPoints && ratio >= 1.5 &&
            found - low_found < kFull * std::min(s.bodies - low_found, low_found * (ratio - 1)))
            return true;
        if (found < s.bodies) low_found = found;
        (found < s.bodies ? low : high) = points;
        if (high - low <= 1) return false;
        const double most = s.lengths_given() ? 4 : 1e4;
        const double factor = std::clamp(s.bodies / std::max(found, 1.0), 0.01, most);
        points = std::clamp(static_cast<std::int64_t>(std::llround(static_cast<double>(points) * factor)), low + 1,
                            high - 1);
    }
    return false;
}

// The count is not monotonic: a neighbouring number may do.
void search_nearby(Search& s) {
    const std::int64_t middle = s.best_points;
    for (std::int64_t i = 1; i <= 12 && !s.near(kNear); ++i) {
        if (middle - i >= 1) s.count(middle - i);
        if (middle + i <= kMostPoints && !s.near(kNear)) s.count(middle + i);
    }
}

void search_leaves(Search& s) {
    const double leaves = s.parameters.leaves;
    double low = 0, high = 4 * leaves;
    for (int i = 0; i < 24 && !s.near(kNear); ++i) {
        s.parameters.leaves = (low + high) / 2;
        (s.count(s.best_points) < s.bodies ? low : high) = s.parameters.leaves;
    }
}

std::string given_lengths(const ColonizeParameters& p) {
    std::string names;
    for (const auto& [name, value] :
         {std::pair{"kill", p.kill}, std::pair{"step", p.step}, std::pair{"influence", p.influence}})
        if (value > 0) names += (names.empty() ? " with this " : " and ") + std::string(name);
    return names;
}

} // namespace

Splines colonize_bodies(const ColonizeParameters& parameters, std::uint64_t seed, bool with_leaves, bool with_fruit,
                        std::int64_t bodies, ColonizeReport* report) {
    if (bodies < 1 || bodies > kMostBodies)
        throw std::invalid_argument("bodies: is " + std::to_string(bodies) + ", expected 1 to " +
                                    std::to_string(kMostBodies));
    Search s{parameters, seed, with_leaves, with_fruit, static_cast<double>(bodies), {}, {}, -1, 0};
    s.parameters.envelope.space = volume(parameters.envelope); // once, not for each tree tried
    const bool full = search_points(s);
    if (!s.near(kWithin) && !full && s.small()) search_nearby(s);
    if (!s.near(kWithin) && s.small() && with_leaves && parameters.leaves > 0) search_leaves(s);
    if (!s.near(kWithin))
        throw std::invalid_argument("bodies: is " + std::to_string(bodies) +
                                    ", but the nearest that the envelope's tree grows to" + given_lengths(parameters) +
                                    " is " + std::to_string(static_cast<std::int64_t>(s.best_count)));
    if (report) *report = s.report;
    return std::move(s.best);
}

} // namespace bough

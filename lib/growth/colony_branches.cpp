#include "colony.h"
#include "pipe.h"
#include <algorithm>

namespace bough {
namespace {

constexpr double kThin = 0.05; // of a step: how far a point left out may lie off the curve
constexpr double kTip = 0.4;   // radius of a branch's last point over that of its tip

struct ColonyChain {
    std::int32_t fork;              // node of the parent's chain that it leaves, -1: none
    std::int32_t parent;            // chain
    std::vector<std::int32_t> node; // base to tip
};

// For each node the child that its branch goes on with, -1 at a tip.
std::vector<std::int32_t> continuing(const Colony& c) {
    const std::size_t n = c.node.size();
    std::vector<std::int64_t> tips(n, 0);
    for (std::size_t i = n; i-- > 0;) {
        tips[i] = std::max<std::int64_t>(tips[i], 1);
        if (c.parent[i] >= 0) tips[static_cast<std::size_t>(c.parent[i])] += tips[i];
    }
    std::vector<std::int32_t> next(n, -1);
    std::vector<double> best(n, -1);
    for (std::size_t i = 1; i < n; ++i) {
        const auto parent = static_cast<std::size_t>(c.parent[i]);
        const Vec3 before = c.parent[parent] < 0
                                ? Vec3(Vec3::UnitY())
                                : Vec3(c.node[parent] - c.node[static_cast<std::size_t>(c.parent[parent])]);
        const Vec3 after = c.node[i] - c.node[parent];
        const double straight = 1 + before.normalized().dot(after.normalized());
        const double score = static_cast<double>(tips[i]) * straight;
        if (score > best[parent]) best[parent] = score, next[parent] = static_cast<std::int32_t>(i);
    }
    return next;
}

std::vector<ColonyChain> chains(const Colony& c) {
    const std::vector<std::int32_t> next = continuing(c);
    std::vector<std::int32_t> chain_of(c.node.size());
    std::vector<ColonyChain> result;
    for (std::size_t i = 0; i < c.node.size(); ++i) {
        const std::int32_t parent = c.parent[i];
        if (parent >= 0 && next[static_cast<std::size_t>(parent)] == static_cast<std::int32_t>(i))
            chain_of[i] = chain_of[static_cast<std::size_t>(parent)];
        else {
            chain_of[i] = static_cast<std::int32_t>(result.size());
            result.push_back({parent, parent < 0 ? -1 : chain_of[static_cast<std::size_t>(parent)], {}});
        }
        result[static_cast<std::size_t>(chain_of[i])].node.push_back(static_cast<std::int32_t>(i));
    }
    return result;
}

void smooth(std::vector<Vec3>& line) {
    for (int pass = 0; pass < 2; ++pass) {
        Vec3 before = line[0];
        for (std::size_t k = 1; k + 1 < line.size(); ++k) {
            const Vec3 here = line[k];
            line[k] = before / 4 + here / 2 + line[k + 1] / 4;
            before = here;
        }
    }
}

double off_line(const Vec3& p, const Vec3& a, const Vec3& b) {
    const Vec3 way = b - a;
    const double square = way.squaredNorm();
    const double t = square > 0 ? std::clamp((p - a).dot(way) / square, 0.0, 1.0) : 0;
    return (p - a - t * way).norm();
}

// Marks the points between first and last that a line within `tolerance` needs (Douglas and Peucker).
void thin(const std::vector<Vec3>& line, std::size_t first, std::size_t last, double tolerance,
          std::vector<std::uint8_t>& keep) {
    std::vector<std::pair<std::size_t, std::size_t>> stretches{{first, last}};
    while (!stretches.empty()) {
        const auto [from, to] = stretches.back();
        stretches.pop_back();
        std::size_t farthest = from;
        double most = tolerance;
        for (std::size_t k = from + 1; k < to; ++k)
            if (const double d = off_line(line[k], line[from], line[to]); d > most) most = d, farthest = k;
        if (farthest == from) continue;
        keep[farthest] = 1;
        stretches.push_back({from, farthest});
        stretches.push_back({farthest, to});
    }
}

class ColonyTracer {
public:
    ColonyTracer(const Colony& c, const ColonizeParameters& p)
        : p_(p), crown_(c.crown), place_(c.node), arc_(c.node.size()), fork_(c.node.size(), 0) {}

    Splines run(const std::vector<ColonyChain>& all) {
        for (const ColonyChain& chain : all)
            if (chain.fork >= 0) fork_[static_cast<std::size_t>(chain.fork)] = 1;
        out_.first_point.push_back(0);
        for (const ColonyChain& chain : all) trace(chain);
        return std::move(out_);
    }

private:
    void trace(const ColonyChain&);

    const ColonizeParameters& p_;
    std::int32_t crown_;
    std::vector<Vec3> place_;        // of each node, after smoothing
    std::vector<double> arc_;        // [m] of each fork along its chain
    std::vector<std::uint8_t> fork_; // bears another chain
    std::vector<double> length_;     // of each branch
    Splines out_;
};

void ColonyTracer::trace(const ColonyChain& chain) {
    std::vector<Vec3> line;
    std::vector<std::uint8_t> keep;
    const std::size_t lead = chain.fork >= 0 ? 1 : 0;
    if (lead) line.push_back(place_[static_cast<std::size_t>(chain.fork)]), keep.push_back(1);
    for (const std::int32_t n : chain.node) {
        line.push_back(place_[static_cast<std::size_t>(n)]);
        keep.push_back(fork_[static_cast<std::size_t>(n)]);
    }
    smooth(line);
    keep.front() = keep.back() = 1;
    for (std::size_t k = 0; k < chain.node.size(); ++k) {
        Vec3& place = place_[static_cast<std::size_t>(chain.node[k])];
        if (chain.node[k] >= crown_ && !contains(p_.envelope, line[k + lead])) line[k + lead] = place;
        place = line[k + lead];
    }
    for (std::size_t k = 0; k + 1 < line.size();) {
        std::size_t end = k + 1;
        while (!keep[end]) ++end;
        thin(line, k, end, kThin * p_.step, keep);
        k = end;
    }
    double arc = 0;
    for (std::size_t k = 0, last = 0; k < line.size(); ++k) {
        if (!keep[k]) continue;
        if (k > 0) arc += (line[k] - line[last]).norm();
        last = k;
        if (k >= lead) arc_[static_cast<std::size_t>(chain.node[k - lead])] = arc;
        out_.point.push_back(line[k]);
    }
    const auto parent = static_cast<std::size_t>(chain.parent);
    out_.parent.push_back(chain.parent);
    out_.parent_at.push_back(lead ? std::min(1.0, arc_[static_cast<std::size_t>(chain.fork)] / length_[parent]) : 0);
    out_.level.push_back(lead ? out_.level[parent] + 1 : 0);
    out_.first_point.push_back(static_cast<std::int32_t>(out_.points()));
    length_.push_back(arc);
}

} // namespace

Splines trace_branches(const Colony& c, const ColonizeParameters& p) {
    return ColonyTracer(c, p).run(chains(c));
}

Splines colony_splines(const Colony& c, const ColonizeParameters& p, std::uint64_t seed, bool with_leaves,
                       bool with_fruit) {
    Splines s = trace_branches(c, p);
    s.name = p.name;
    const double height = upper_corner(p.envelope).y() - c.node[0].y();
    const double tips = static_cast<double>(s.branches());
    const double tip = p.tip_radius > 0 ? p.tip_radius : std::max(5e-4, height / 60 / std::sqrt(tips));
    s.radius.assign(s.points(), tip);
    thicken_by_pipe_model(s, 2);
    // A twig ends thinner than it bears its first leaves.
    for (std::size_t b = 0; b < s.branches(); ++b) s.radius[static_cast<std::size_t>(s.first_point[b + 1]) - 1] *= kTip;
    add_colony_foliage(p, seed, with_leaves, with_fruit, s);
    return s;
}

} // namespace bough

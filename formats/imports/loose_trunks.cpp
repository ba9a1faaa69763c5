#include "loose_trunks.h"
#include "attach.h"
#include "formats/plain_text.h"
#include "lib/model/polyline.h"
#include <algorithm>
#include <limits>

namespace bough {
namespace {

using Branches = std::vector<ImportedBranch>;

// The trunks with a length, and of each branch the one that carries it.
struct Trunks {
    std::vector<std::int32_t> branch; // of each trunk
    std::vector<std::int32_t> carrier;
};

bool has_length(const ImportedBranch& b) {
    return std::any_of(b.point.begin(), b.point.end(), [&b](const Vec3& p) { return p != b.point.front(); });
}

Trunks trunks_of(const Branches& branches) {
    Trunks t;
    std::vector<std::int32_t> parent;
    for (const ImportedBranch& b : branches) parent.push_back(b.parent);
    t.carrier.assign(branches.size(), -1);
    for (const std::int32_t b : parents_first(parent).order) {
        if (parent[b] >= 0) {
            t.carrier[b] = t.carrier[parent[b]];
        } else if (has_length(branches[b])) {
            t.carrier[b] = std::int32_t(t.branch.size());
            t.branch.push_back(b);
        }
    }
    return t;
}

// All wood as pieces, one a trunk, which begin with the trunk's first point and nowhere else.
Pieces pieces_of(const Branches& branches, const Trunks& trunks, std::vector<std::int32_t>& first) {
    Pieces pieces;
    for (std::size_t b = 0; b < branches.size(); ++b) {
        first.push_back(std::int32_t(pieces.point.size()));
        for (std::size_t k = 0; k < branches[b].point.size(); ++k) {
            const auto at = std::int32_t(pieces.point.size());
            if (k > 0 && trunks.carrier[b] >= 0) pieces.segment.push_back({at - 1, at, trunks.carrier[b]});
            pieces.point.push_back(branches[b].point[k]);
            pieces.radius.push_back(branches[b].radius[k]);
        }
    }
    for (const std::int32_t b : trunks.branch) {
        pieces.first.push_back(std::int32_t(pieces.end.size()));
        pieces.end.push_back(first[b]);
        pieces.base.push_back(first[b]);
    }
    pieces.first.push_back(std::int32_t(pieces.end.size()));
    return pieces;
}

struct Measured {
    double wood = 0;                                                   // [file unit] length of all
    double low = std::numeric_limits<double>::infinity(), high = -low; // [file unit] along the up axis
    double height() const { return high - low; }
};

std::vector<Measured> measured(const Pieces& pieces, int axis) {
    std::vector<Measured> all(pieces.size());
    for (const LineSegment& s : pieces.segment) {
        Measured& m = all[s.piece];
        m.wood += (pieces.point[s.b] - pieces.point[s.a]).norm();
        for (const std::int32_t p : {s.a, s.b}) {
            m.low = std::min(m.low, pieces.point[p][axis]);
            m.high = std::max(m.high, pieces.point[p][axis]);
        }
    }
    return all;
}

// Which pieces stay trunks.
class Standing {
public:
    Standing(const Pieces& pieces, const std::vector<Measured>& size, int axis)
        : pieces_(pieces), size_(size), axis_(axis) {
        for (const Measured& m : size) all_.low = std::min(all_.low, m.low), all_.high = std::max(all_.high, m.high);
    }

    std::vector<char> of(const std::vector<JoinedPiece>& joined) const {
        std::vector<std::int32_t> parent;
        for (const JoinedPiece& on : joined) parent.push_back(on.parent);
        std::vector<std::int32_t> tree(joined.size()); // the trunk that carries each piece
        std::vector<char> stands(joined.size());
        for (const std::int32_t k : parents_first(parent).order) {
            const JoinedPiece& on = joined[k];
            stands[k] = on.parent < 0 || in_lowest_twentieth(k, all_) || on.gap > 0.5 * size_[k].wood ||
                        is_tree_beside(k, tree[on.parent], on.gap);
            tree[k] = stands[k] ? k : tree[on.parent];
        }
        return stands;
    }

private:
    const Vec3& base(std::int32_t k) const { return pieces_.point[pieces_.base[k]]; }
    double radius(std::int32_t k) const { return pieces_.radius[pieces_.base[k]]; }
    bool in_lowest_twentieth(std::int32_t k, const Measured& of) const {
        return base(k)[axis_] <= of.low + 0.05 * of.height();
    }
    bool is_tree_beside(std::int32_t k, std::int32_t tree, double gap) const {
        Vec3 way = base(k) - base(tree);
        const double rise = way[axis_];
        way[axis_] = 0;
        if (!in_lowest_twentieth(k, size_[k]) || rise > way.norm() || gap < 5 * radius(k)) return false;
        const bool alike = radius(k) > 0.25 * radius(tree) && size_[k].height() > 0.25 * size_[tree].height();
        return alike || gap > size_[k].height();
    }

    const Pieces& pieces_;
    const std::vector<Measured>& size_;
    const int axis_;
    Measured all_;
};

double fraction_at(const ImportedBranch& b, std::size_t piece, double t) {
    const std::vector<double> arc = arc_lengths(b.point);
    return arc.back() > 0 ? std::min(1.0, (arc[piece] + t * (arc[piece + 1] - arc[piece])) / arc.back()) : 0;
}

} // namespace

void join_loose_trunks(Branches& branches, char up, ImportNotes& notes) {
    const Trunks trunks = trunks_of(branches);
    if (trunks.branch.size() < 2) return;
    std::vector<std::int32_t> first; // point of each branch in the pieces
    Pieces pieces = pieces_of(branches, trunks, first);
    const int axis = up == 'z' ? 2 : 1;
    const std::vector<Measured> size = measured(pieces, axis); // before its segments are taken out
    const std::vector<JoinedPiece> joined = attach_pieces(pieces, up);
    const std::vector<char> stands = Standing(pieces, size, axis).of(joined);
    std::vector<double> bridge(branches.size(), 0); // [file unit] of each branch, to its parent's axis
    std::vector<double> length(branches.size(), 0); // of those before
    std::vector<Vec3> from(joined.size());
    std::size_t count = 0;
    double widest = 0;
    for (std::size_t k = 0; k < joined.size(); ++k) {
        const JoinedPiece& on = joined[k];
        if (stands[k]) continue;
        const auto host = std::upper_bound(first.begin(), first.end(), on.a) - first.begin() - 1;
        ImportedBranch& b = branches[trunks.branch[k]];
        b.parent = std::int32_t(host);
        b.parent_at = fraction_at(branches[host], std::size_t(on.a - first[host]), on.t);
        from[k] = pieces.point[on.a] + on.t * (pieces.point[on.b] - pieces.point[on.a]);
        const double radius = (1 - on.t) * pieces.radius[on.a] + on.t * pieces.radius[on.b];
        if (on.gap > radius + b.radius.front()) {
            bridge[trunks.branch[k]] = on.gap;
            length[trunks.branch[k]] = arc_lengths(b.point).back();
        }
        widest = std::max(widest, on.gap);
        ++count;
    }
    // What grows on a trunk keeps its place when a piece is put before it.
    for (ImportedBranch& b : branches) {
        if (b.parent < 0 || !(bridge[b.parent] > 0)) continue;
        const double gap = bridge[b.parent];
        b.parent_at = (gap + b.parent_at * length[b.parent]) / (gap + length[b.parent]);
    }
    for (std::size_t k = 0; k < joined.size(); ++k) {
        ImportedBranch& b = branches[trunks.branch[k]];
        if (!(bridge[trunks.branch[k]] > 0)) continue;
        b.point.insert(b.point.begin(), from[k]);
        b.radius.insert(b.radius.begin(), b.radius.front());
    }
    if (count > 0)
        notes.lines.push_back(std::to_string(count) + " of " + std::to_string(joined.size()) +
                              " trunks begin in the air: joined to the nearest wood, the farthest over " +
                              shown(widest) + " units");
}

} // namespace bough

#include "attach.h"
#include <algorithm>
#include <optional>

namespace bough {
namespace {

constexpr double ground_band = 0.05;  // of the height of all: what begins in it may stand on the ground
constexpr double tree_length = 0.25;  // of the longest piece there: shorter ones are loose wood
constexpr double own_tree_gap = 0.5;  // of its length: what is as far away from all others is no part of them
constexpr double touching_gap = 1e-3; // of the height: nearer than that is a joint

struct Choice {
    std::int32_t end = -1;
    SegmentPlace place;
};

class Joiner {
public:
    Joiner(Pieces& pieces, char up)
        : pieces_(pieces), axis_(up == 'z' ? 2 : 1), length_(pieces.size(), 0), low_(pieces.size()),
          high_(pieces.size()), choice_(pieces.size()), root_(pieces.size(), false) {
        measure();
        if (pieces.size() == 1) pieces.segment.clear(); // nothing to look for
        search_.emplace(pieces.point, pieces.radius, pieces.base, std::move(pieces.segment), pieces.size());
        // What stands together in a file often grows on one branch.
        for (std::size_t p = 0; p < pieces.size(); ++p)
            choice_[p] = best_of(p, std::int32_t(p), p > 0 ? choice_[p - 1].place.segment : Segment());
        choose_roots();
        while (open_circles()) {
        }
    }

    std::vector<Attachment> result() const {
        std::vector<Attachment> joined(pieces_.size());
        for (std::size_t p = 0; p < pieces_.size(); ++p) {
            const SegmentPlace& place = choice_[p].place;
            if (root_[p])
                joined[p].end = ground_end(p);
            else
                joined[p] = {choice_[p].end, place.segment.piece, place.segment.a, place.segment.b,
                             place.t,        place.distance};
        }
        return joined;
    }

private:
    double up(std::int32_t point) const { return pieces_.point[point][axis_]; }
    const std::int32_t* begin(std::size_t p) const { return pieces_.end.data() + pieces_.first[p]; }
    const std::int32_t* end(std::size_t p) const { return pieces_.end.data() + pieces_.first[p + 1]; }

    void measure() {
        std::fill(low_.begin(), low_.end(), std::numeric_limits<double>::infinity());
        std::fill(high_.begin(), high_.end(), -std::numeric_limits<double>::infinity());
        for (const Segment& s : pieces_.segment) {
            length_[s.piece] += (pieces_.point[s.b] - pieces_.point[s.a]).norm();
            low_[s.piece] = std::min({low_[s.piece], up(s.a), up(s.b)});
            high_[s.piece] = std::max({high_[s.piece], up(s.a), up(s.b)});
        }
        ground_ = *std::min_element(low_.begin(), low_.end());
        height_ = *std::max_element(high_.begin(), high_.end()) - ground_;
    }

    Choice best_of(std::size_t p, std::int32_t group, const Segment& hint = {}) const {
        Choice best;
        for (const std::int32_t* e = begin(p); e != end(p); ++e) {
            if (pieces_.base[p] >= 0 && *e != pieces_.base[p]) continue;
            const SegmentPlace place = search_->nearest(*e, group, best.place.cost, hint);
            if (best.end < 0 || place.segment.a >= 0) best = {*e, place};
        }
        return best;
    }

    // Where a piece would begin if it stood on the ground.
    std::int32_t ground_end(std::size_t p) const {
        if (pieces_.base[p] >= 0) return pieces_.base[p];
        const double middle = 0.5 * (low_[p] + high_[p]);
        std::int32_t best = *begin(p);
        const auto better = [&](std::int32_t e) {
            const double r = up(e) <= middle ? std::max(0.0, pieces_.radius[e]) : -1;
            const double r_best = up(best) <= middle ? std::max(0.0, pieces_.radius[best]) : -1;
            if (r > 1.01 * r_best && r > r_best) return true;
            return !(r_best > 1.01 * r && r_best > r) && up(e) < up(best);
        };
        for (const std::int32_t* e = begin(p); e != end(p); ++e)
            if (better(*e)) best = *e;
        return best;
    }

    bool on_ground(std::int32_t point) const { return up(point) <= ground_ + ground_band * height_; }

    // Whether a piece begins on the ground and touches no other above it, or is far from all others.
    bool own_tree(std::size_t p) const {
        const SegmentPlace& place = choice_[p].place;
        if (place.distance > own_tree_gap * length_[p]) return true;
        if (!on_ground(ground_end(p))) return false;
        const auto radius = [&](std::int32_t q) { return std::max(0.0, pieces_.radius[q]); };
        const double wood = radius(choice_[p].end) + std::max(radius(place.segment.a), radius(place.segment.b));
        if (place.distance <= std::max(wood, touching_gap * height_)) return false;
        const double joint = (1 - place.t) * up(place.segment.a) + place.t * up(place.segment.b);
        return joint <= ground_ + ground_band * height_ || place.distance > 0.1 * length_[p];
    }

    // Which of two stands on the ground rather: the thicker, of equally thick ones the longer, else the lower.
    bool likelier_trunk(std::size_t p, std::size_t q) const {
        constexpr double clearly = 1.01;
        const std::int32_t e = ground_end(p), f = ground_end(q);
        if (on_ground(e) != on_ground(f)) return on_ground(e);
        const double r = std::max(0.0, pieces_.radius[e]), s = std::max(0.0, pieces_.radius[f]);
        if (r > clearly * s || s > clearly * r) return r > s;
        if (length_[p] > clearly * length_[q] || length_[q] > clearly * length_[p]) return length_[p] > length_[q];
        return up(e) < up(f);
    }

    void choose_roots() {
        std::size_t main = 0;
        for (std::size_t p = 1; p < pieces_.size(); ++p)
            if (likelier_trunk(p, main)) main = p;
        for (std::size_t p = 0; p < pieces_.size(); ++p)
            root_[p] = p == main || choice_[p].place.segment.a < 0 ||
                       (length_[p] >= tree_length * length_[main] && own_tree(p));
    }

    // One round of Edmonds' rule. False when every piece hangs together with one on the ground.
    bool open_circles() {
        const std::size_t n = pieces_.size();
        constexpr std::int32_t unseen = -1;
        std::vector<std::int32_t> group(n, unseen), on_path(n, unseen), path;
        std::vector<std::vector<std::int32_t>> circles;
        for (std::size_t start = 0; start < n; ++start) {
            path.clear();
            std::int32_t p = std::int32_t(start);
            while (group[p] == unseen && on_path[p] != std::int32_t(start)) {
                on_path[p] = std::int32_t(start);
                path.push_back(p);
                if (root_[p]) break;
                p = choice_[p].place.segment.piece;
            }
            std::int32_t label = group[p] != unseen ? group[p] : p;
            if (group[p] == unseen && !root_[p])
                circles.emplace_back(std::find(path.begin(), path.end(), p), path.end());
            for (const std::int32_t q : path) group[q] = label;
        }
        if (circles.empty()) return false;
        search_->regroup(group);
        for (const std::vector<std::int32_t>& circle : circles) {
            double least = std::numeric_limits<double>::infinity();
            std::int32_t moved = -1;
            Choice to;
            for (const std::int32_t p : circle) {
                const Choice other = best_of(std::size_t(p), group[p]);
                const double added = other.place.cost - choice_[p].place.cost;
                if (other.place.segment.a < 0 || (moved >= 0 && added >= least)) continue;
                least = added;
                moved = p;
                to = other;
            }
            if (moved < 0) // nothing else is a place for any of them
                root_[circle.front()] = true;
            else
                choice_[moved] = to;
        }
        return true;
    }

    const Pieces& pieces_;
    const int axis_;
    std::vector<double> length_, low_, high_; // of each piece
    double ground_ = 0, height_ = 0;
    std::optional<SegmentSearch> search_;
    std::vector<Choice> choice_;
    std::vector<char> root_;
};

} // namespace

std::vector<Attachment> attach_pieces(Pieces& pieces, char up) {
    if (pieces.size() == 0) return {};
    return Joiner(pieces, up).result();
}

} // namespace bough

#include "attach.h"
#include "formats/release.h"
#include "lib/base/parallel.h"
#include <algorithm>
#include <array>
#include <optional>

namespace bough {
namespace {

constexpr double ground_band = 0.05;  // of the height of all: what begins in it may stand on the ground
constexpr double tree_length = 0.25;  // of the longest piece there: shorter ones are loose wood
constexpr double own_tree_gap = 0.5;  // of its length: what is as far away from all others is no part of them
constexpr double touching_gap = 1e-3; // of the height: nearer than that is a joint
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t run = 64;    // pieces that one thread asks for in a row
constexpr double search_ns = 2000; // of one of them

struct Choice {
    std::int32_t end = -1;
    SegmentPlace place;
};

} // namespace

class PieceJoiner::Work {
public:
    Work(Pieces& pieces, char up)
        : pieces_(pieces), axis_(up == 'z' ? 2 : 1), length_(pieces.size(), 0), low_(pieces.size()),
          high_(pieces.size()) {
        if (pieces.size() == 0) return;
        measure();
        if (pieces.size() == 1) release(pieces.segment); // nothing to look for
        search_.emplace(pieces.point, pieces.radius, pieces.base, std::move(pieces.segment), pieces.size());
    }

    void join() {
        choice_.resize(pieces_.size());
        root_.assign(pieces_.size(), false);
        if (pieces_.size() == 0) return;
        choose_places();
        choose_roots();
        while (open_circles()) {
        }
        search_.reset();
    }

    const SegmentSearch& search() const { return *search_; }

    std::vector<JoinedPiece> result() const {
        std::vector<JoinedPiece> joined(pieces_.size());
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
        for (const LineSegment& s : pieces_.segment) {
            length_[s.piece] += (pieces_.point[s.b] - pieces_.point[s.a]).norm();
            low_[s.piece] = std::min({low_[s.piece], up(s.a), up(s.b)});
            high_[s.piece] = std::max({high_[s.piece], up(s.a), up(s.b)});
        }
        ground_ = *std::min_element(low_.begin(), low_.end());
        height_ = *std::max_element(high_.begin(), high_.end()) - ground_;
    }

    // What stands together in a file often grows on one branch, or on the next, so that within a run each piece looks there
    // first. Runs are the same for any number of threads.
    void choose_places() {
        const std::size_t pieces = pieces_.size();
        parallel_blocks((pieces + run - 1) / run, search_ns * double(run), [&](std::size_t k, int) {
            Likely likely;
            for (std::size_t p = k * run; p < std::min((k + 1) * run, pieces); ++p) {
                const Choice& choice = choice_[p] = best_of(p, std::int32_t(p), likely.all());
                set_likely(choice.place.segment, likely);
            }
        });
    }

    static constexpr std::int32_t window = 8; // segments to either side
    struct Likely {                           // no container: what memory it lacked, a thread could tell nobody
        std::array<LineSegment, 2 + 2 * window + window> segment;
        std::size_t count = 0;
        std::span<const LineSegment> all() const { return {segment.data(), count}; }
    };

    // Segments near to where a piece was joined, and those of the next piece.
    void set_likely(const LineSegment& found, Likely& likely) const {
        likely.count = 0;
        if (found.a < 0) return;
        likely.segment[likely.count++] = found;
        if (!pieces_.curves) return;
        const auto add = [&](std::int32_t piece, std::int32_t from, std::int32_t to) {
            from = std::max(from, begin(std::size_t(piece))[0]);
            to = std::min(to, begin(std::size_t(piece))[1]);
            for (std::int32_t k = from; k < to; ++k) likely.segment[likely.count++] = {k, k + 1, piece};
        };
        add(found.piece, found.a - window, found.b + window);
        if (std::size_t(found.piece) + 1 < pieces_.size()) {
            const std::int32_t next = begin(std::size_t(found.piece) + 1)[0];
            add(found.piece + 1, next, next + window);
        }
    }

    Choice best_of(std::size_t p, std::int32_t group, std::span<const LineSegment> likely = {}) const {
        const std::int32_t* const all = pieces_.base[p] >= 0 ? &pieces_.base[p] : begin(p);
        const std::span<const std::int32_t> ends(all, pieces_.base[p] >= 0 ? all + 1 : end(p));
        Choice best{ends.front(), search_->nearest(ends.front(), group, infinity, likely)};
        // As many of the next ones at once as are likely to find nothing better.
        std::size_t many = 1;
        for (std::size_t at = 1; at < ends.size();) {
            many = std::min(many, ends.size() - at);
            if (many > 1 && search_->may_find(ends.subspan(at, many), group, best.place.cost)) {
                many /= 2;
                continue;
            }
            if (many == 1) {
                const SegmentPlace place = search_->nearest(ends[at], group, best.place.cost, likely);
                if (place.segment.a >= 0) best = {ends[at], place};
            }
            at += many;
            many *= 2;
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
        parallel_for(circles.size(), 2 * search_ns, [&](std::size_t c) { open_circle(circles[c], group); });
        return true;
    }

    // Changes the circle's own pieces alone.
    void open_circle(const std::vector<std::int32_t>& circle, const std::vector<std::int32_t>& group) {
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

    const Pieces& pieces_;
    const int axis_;
    std::vector<double> length_, low_, high_; // of each piece
    double ground_ = 0, height_ = 0;
    std::optional<SegmentSearch> search_;
    std::vector<Choice> choice_;
    std::vector<char> root_;
};

PieceJoiner::PieceJoiner(Pieces& pieces, char up) : work_(std::make_unique<Work>(pieces, up)) {}
PieceJoiner::~PieceJoiner() = default;

const SegmentSearch& PieceJoiner::search() const {
    return work_->search();
}

std::vector<JoinedPiece> PieceJoiner::join() {
    work_->join();
    return work_->result();
}

std::vector<JoinedPiece> attach_pieces(Pieces& pieces, char up) {
    return PieceJoiner(pieces, up).join();
}

} // namespace bough

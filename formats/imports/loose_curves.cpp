#include "loose_curves.h"
#include "attach.h"
#include "formats/plain_text.h"
#include "lib/base/counted.h"
#include "lib/model/polyline.h"
#include "up_axis.h"
#include <algorithm>

namespace bough {
namespace {

void leave_out_points(LooseCurves& c, const std::string& name, ImportNotes& notes) {
    std::size_t kept = 0, count = 0;
    std::int32_t points = 0, next = 0; // `next` is kept apart from first[], whose entries move to the front
    for (std::size_t i = 0; i < c.size(); ++i) {
        const std::int32_t first = next, end = c.first[i + 1];
        next = end;
        const auto same = [&](const Vec3& p) { return p == c.point[first]; };
        if (std::all_of(c.point.begin() + first, c.point.begin() + end, same)) {
            ++count;
            continue;
        }
        if (points != first) {
            std::move(c.point.begin() + first, c.point.begin() + end, c.point.begin() + points);
            std::move(c.radius.begin() + first, c.radius.begin() + end, c.radius.begin() + points);
        }
        points += end - first;
        c.first[++kept] = points;
    }
    c.first.resize(kept + 1);
    c.point.resize(std::size_t(points));
    c.radius.resize(std::size_t(points));
    if (count > 0) notes.lines.push_back(counted(count, "curve", "curves") + " without length left out");
    if (kept == 0) throw InputError(name, "holds no curve with a length, expected at least one");
}

Pieces pieces_of(LooseCurves&& c) {
    Pieces pieces;
    pieces.curves = true;
    pieces.segment.reserve(c.point.size() - c.size());
    pieces.end.reserve(2 * c.size());
    pieces.first.reserve(c.size() + 1);
    for (std::size_t i = 0; i < c.size(); ++i) {
        const std::int32_t first = c.first[i], last = c.first[i + 1] - 1;
        for (std::int32_t k = first; k < last; ++k) pieces.segment.push_back({k, k + 1, std::int32_t(i)});
        pieces.first.push_back(pieces.end.size());
        pieces.end.insert(pieces.end.end(), {first, last});
    }
    pieces.first.push_back(pieces.end.size());
    pieces.base.assign(c.size(), -1);
    pieces.point = std::move(c.point);
    pieces.radius = std::move(c.radius);
    return pieces;
}

// How many curves begin at their first point, and at their last.
struct Votes {
    std::size_t first = 0, last = 0;
    bool clear() const { return 4 * std::max(first, last) >= 3 * (first + last) && first != last; }
    CurveBase majority() const {
        return !clear() ? CurveBase::unknown : first > last ? CurveBase::first : CurveBase::last;
    }
    std::string counted() const {
        return std::to_string(std::max(first, last)) + " of " + std::to_string(first + last) + " curves";
    }
};

Votes votes_by_radius(const Pieces& pieces) {
    constexpr double clearly = 1.01;
    Votes votes;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const double first = std::max(0.0, pieces.radius[pieces.end[2 * i]]);
        const double last = std::max(0.0, pieces.radius[pieces.end[2 * i + 1]]);
        votes.first += first > clearly * last;
        votes.last += last > clearly * first;
    }
    return votes;
}

// Of at most a thousand curves, evenly chosen.
Votes votes_by_place(const Pieces& pieces, const SegmentSearch& search) {
    constexpr std::size_t asked = 1000;
    Votes votes;
    for (std::size_t i = 0; i < pieces.size(); i += std::max<std::size_t>(1, pieces.size() / asked)) {
        const double first = search.nearest(pieces.end[2 * i], std::int32_t(i)).cost;
        const double last = search.nearest(pieces.end[2 * i + 1], std::int32_t(i)).cost;
        votes.first += first < last;
        votes.last += last < first;
    }
    return votes;
}

void set_base(Pieces& pieces, CurveBase base) {
    for (std::size_t i = 0; i < pieces.base.size(); ++i)
        pieces.base[i] = pieces.end[2 * i + (base == CurveBase::last ? 1 : 0)];
}

std::string direction_note(CurveBase base, const std::string& why) {
    return std::string("curves taken as running from ") + (base == CurveBase::first ? "base to tip" : "tip to base") +
           ", because " + why;
}

std::vector<JoinedPiece> joined_pieces(Pieces& pieces, char up, CurveBase base, ImportNotes& notes) {
    if (base == CurveBase::unknown && pieces.size() > 1) {
        const Votes votes = votes_by_radius(pieces);
        base = votes.majority();
        if (base != CurveBase::unknown)
            notes.lines.push_back(direction_note(base, votes.counted() + " are thicker at that end"));
    }
    PieceJoiner joiner(pieces, up);
    if (base == CurveBase::unknown && pieces.size() > 1) {
        const Votes votes = votes_by_place(pieces, joiner.search());
        base = votes.majority();
        notes.lines.push_back(
            base == CurveBase::unknown
                ? "curves taken as beginning at the end that is nearer to another, as neither their order nor "
                  "radii tell the base"
                : direction_note(base, votes.counted() + " are nearer to another curve at that end"));
    }
    if (base != CurveBase::unknown) set_base(pieces, base);
    return joiner.join();
}

// Arc lengths up to each point, so that many joints on one curve cost no more than one.
std::vector<double> arcs_of(const Pieces& pieces) {
    std::vector<double> arc(pieces.point.size(), 0);
    for (std::size_t i = 0; i < pieces.size(); ++i)
        for (std::int32_t k = pieces.end[2 * i] + 1; k <= pieces.end[2 * i + 1]; ++k)
            arc[k] = arc[k - 1] + (pieces.point[k] - pieces.point[k - 1]).norm();
    return arc;
}

// From base to tip.
ImportedBranch branch_of(const Pieces& pieces, std::size_t i, bool turned) {
    const std::int32_t first = pieces.end[2 * i], end = pieces.end[2 * i + 1] + 1;
    ImportedBranch b;
    b.point.assign(pieces.point.begin() + first, pieces.point.begin() + end);
    b.radius.assign(pieces.radius.begin() + first, pieces.radius.begin() + end);
    if (!turned) return b;
    std::reverse(b.point.begin(), b.point.end());
    std::reverse(b.radius.begin(), b.radius.end());
    return b;
}

} // namespace

JoinedCurves join_curves(LooseCurves&& curves, char up, CurveBase base, const std::string& name, ImportNotes& notes) {
    leave_out_points(curves, name, notes);
    Pieces pieces = pieces_of(std::move(curves));
    if (up == 0) {
        up = likely_up(pieces.point, pieces.radius, pieces.segment);
        note_guessed_up(up, notes);
    }
    const std::vector<JoinedPiece> joined = joined_pieces(pieces, up, base, notes);
    const std::vector<double> arc = arcs_of(pieces);
    const auto turned = [&](std::size_t i) { return joined[i].end != pieces.end[2 * i]; };
    JoinedCurves result;
    result.up = up;
    result.branches.reserve(pieces.size());
    std::size_t attached = 0;
    double gap = 0;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        ImportedBranch& branch = result.branches.emplace_back(branch_of(pieces, i, turned(i)));
        const JoinedPiece& to = joined[i];
        branch.parent = to.parent;
        if (to.parent < 0) continue;
        ++attached;
        gap = std::max(gap, to.gap);
        const double at = arc[to.a] + to.t * (arc[to.b] - arc[to.a]);
        const double fraction = at / arc[pieces.end[2 * std::size_t(to.parent) + 1]];
        branch.parent_at = std::clamp(turned(std::size_t(to.parent)) ? 1 - fraction : fraction, 0.0, 1.0);
    }
    if (attached > 0)
        notes.lines.push_back(counted(attached, "curve", "curves") +
                              " attached to the nearest branch, as the file names no " +
                              "parents, over a gap of up to " + shown(gap));
    return result;
}

} // namespace bough

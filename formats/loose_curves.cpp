#include "loose_curves.h"
#include "attach.h"
#include "lib/model/counted.h"
#include "lib/model/polyline.h"
#include "plain_text.h"
#include "up_axis.h"
#include <algorithm>

namespace bough {
namespace {

using Curves = std::vector<ImportedBranch>;

void leave_out_points(Curves& curves, const std::string& name, ImportNotes& notes) {
    const auto is_point = [](const ImportedBranch& c) {
        return std::all_of(c.point.begin(), c.point.end(), [&](const Vec3& p) { return p == c.point.front(); });
    };
    if (const std::size_t count = std::erase_if(curves, is_point))
        notes.lines.push_back(counted(count, "curve", "curves") + " without length left out");
    if (curves.empty()) throw InputError(name, "holds no curve with a length, expected at least one");
}

Pieces pieces_of(const Curves& curves) {
    Pieces pieces;
    std::size_t points = 0;
    for (const ImportedBranch& c : curves) points += c.point.size();
    pieces.point.reserve(points);
    pieces.radius.reserve(points);
    pieces.segment.reserve(points);
    for (std::size_t i = 0; i < curves.size(); ++i) {
        const std::int32_t first = std::int32_t(pieces.point.size());
        pieces.point.insert(pieces.point.end(), curves[i].point.begin(), curves[i].point.end());
        pieces.radius.insert(pieces.radius.end(), curves[i].radius.begin(), curves[i].radius.end());
        const std::int32_t last = std::int32_t(pieces.point.size()) - 1;
        for (std::int32_t k = first; k < last; ++k) pieces.segment.push_back({k, k + 1, std::int32_t(i)});
        pieces.first.push_back(pieces.end.size());
        pieces.end.insert(pieces.end.end(), {first, last});
    }
    pieces.first.push_back(pieces.end.size());
    pieces.base.assign(curves.size(), -1);
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

Votes votes_by_radius(const Curves& curves) {
    constexpr double clearly = 1.01;
    Votes votes;
    for (const ImportedBranch& c : curves) {
        const double first = std::max(0.0, c.radius.front()), last = std::max(0.0, c.radius.back());
        votes.first += first > clearly * last;
        votes.last += last > clearly * first;
    }
    return votes;
}

// Of at most a thousand curves, evenly chosen.
Votes votes_by_place(const Pieces& pieces) {
    constexpr std::size_t asked = 1000;
    const SegmentSearch search(pieces.point, pieces.radius, pieces.base, pieces.segment, pieces.size());
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

std::vector<Attachment> joined_pieces(Pieces& pieces, const Curves& curves, char up, CurveBase base,
                                      ImportNotes& notes) {
    if (base == CurveBase::unknown && curves.size() > 1) {
        const Votes votes = votes_by_radius(curves);
        base = votes.majority();
        if (base != CurveBase::unknown)
            notes.lines.push_back(direction_note(base, votes.counted() + " are thicker at that end"));
    }
    if (base != CurveBase::unknown) {
        set_base(pieces, base);
        return attach_pieces(pieces, up);
    }
    if (curves.size() == 1) return attach_pieces(pieces, up);
    const Votes votes = votes_by_place(pieces);
    base = votes.majority();
    if (base == CurveBase::unknown) {
        notes.lines.push_back(
            "curves taken as beginning at the end that is nearer to another, as neither their order nor "
            "radii tell the base");
        return attach_pieces(pieces, up);
    }
    notes.lines.push_back(direction_note(base, votes.counted() + " are nearer to another curve at that end"));
    set_base(pieces, base);
    return attach_pieces(pieces, up);
}

// Arc lengths up to each point, so that many joints on one curve cost no more than one.
// Of all points, one curve after another.
std::vector<double> arcs_of(const Curves& curves) {
    std::vector<double> all;
    for (const ImportedBranch& c : curves) {
        const std::vector<double> arc = arc_lengths(c.point);
        all.insert(all.end(), arc.begin(), arc.end());
    }
    return all;
}

} // namespace

char join_curves(Curves& curves, char up, CurveBase base, const std::string& name, ImportNotes& notes) {
    leave_out_points(curves, name, notes);
    Pieces pieces = pieces_of(curves);
    if (up == 0) {
        up = likely_up(pieces.point, pieces.radius, pieces.segment);
        note_guessed_up(up, notes);
    }
    const std::vector<Attachment> joined = joined_pieces(pieces, curves, up, base, notes);
    const std::vector<double> arc = arcs_of(curves);
    std::size_t attached = 0;
    double gap = 0;
    for (std::size_t i = 0; i < curves.size(); ++i) {
        const Attachment& to = joined[i];
        curves[i].parent = to.parent;
        if (to.parent < 0) continue;
        ++attached;
        gap = std::max(gap, to.gap);
        const double at = arc[to.a] + to.t * (arc[to.b] - arc[to.a]);
        const double fraction = at / arc[pieces.end[2 * std::size_t(to.parent) + 1]];
        const bool turned = joined[to.parent].end != pieces.end[2 * std::size_t(to.parent)];
        curves[i].parent_at = std::clamp(turned ? 1 - fraction : fraction, 0.0, 1.0);
    }
    for (std::size_t i = 0; i < curves.size(); ++i) {
        if (joined[i].end == pieces.end[2 * i]) continue;
        std::reverse(curves[i].point.begin(), curves[i].point.end());
        std::reverse(curves[i].radius.begin(), curves[i].radius.end());
    }
    if (attached > 0)
        notes.lines.push_back(counted(attached, "curve", "curves") +
                              " attached to the nearest branch, as the file names no " +
                              "parents, over a gap of up to " + shown(gap));
    return up;
}

} // namespace bough

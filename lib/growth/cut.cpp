#include "cut.h"
#include <algorithm>
#include <cmath>
#include <numbers>

namespace bough {

using std::numbers::pi;

namespace {

constexpr double pieces_of_height = 11; // of a curve as long as the tree is high
constexpr double rounding = 1e-9;       // relative: a length that is a whole number of pieces gives that number
constexpr double closed = 1e-3;         // chord over arc below which a piece has no direction worth the name

struct Wanted {
    double pieces; // of the whole curve
    double length; // [m] longest piece
};

Wanted wanted_pieces(const Curves& curves, std::size_t c, const CutRule& rule) {
    const double length = curves.length(c);
    if (rule.segment_length > 0) {
        const double longest = rule.segment_length * rule.grow;
        return {std::max(1.0, std::ceil(length / longest - rounding)), longest};
    }
    const double thick = std::max(1.0, std::floor(length / (2 * curves.radius[std::size_t(curves.first[c])])));
    const double count = std::min(pieces_of_height * std::sqrt(length / curves.extent[c]), thick);
    const double pieces = std::max(1.0, std::round(count / rule.grow));
    return {pieces, length / pieces};
}

Vec3 tangent(const Curves& curves, std::size_t i) {
    return (curves.point[i + 1] - curves.point[i]).normalized();
}

// Cosine of the turning allowed; -2 where every turning is.
double least_cosine(const CutRule& rule) {
    const double bend = rule.max_bend * std::max(rule.grow, 1.0);
    return bend < pi ? std::cos(bend) - 1e-12 : -2.0;
}

// Whether `pieces` even pieces keep the tangent near the first one of each.
bool even_pieces_turn_little(const Curves& curves, std::size_t c, double pieces, double cosine) {
    const double piece = curves.length(c) / pieces;
    const std::size_t begin = curves.first[c], end = curves.first[c + 1] - 1;
    double current = -1;
    Vec3 first = Vec3::Zero();
    for (std::size_t i = begin; i < end; ++i) {
        const Vec3 t = tangent(curves, i);
        const double starts_in = std::floor(curves.arc[i] / piece + rounding);
        if (starts_in > current) {
            current = starts_in;
            first = t;
        }
        if (first.dot(t) < cosine) return false;
        const double ends_in = std::ceil(curves.arc[i + 1] / piece - rounding) - 1;
        if (ends_in > current) {
            current = ends_in;
            first = t;
        }
    }
    return true;
}

// Arc lengths where a cut is forced, the curve's two ends included.
std::vector<double> forced_cuts(const Curves& curves, std::size_t c, double cosine) {
    const std::size_t begin = curves.first[c], end = curves.first[c + 1] - 1;
    const double length = curves.length(c);
    std::vector<double> forced{0};
    Vec3 first = tangent(curves, begin);
    for (std::size_t i = begin + 1; i < end; ++i) {
        const Vec3 t = tangent(curves, i);
        if (!(first.dot(t) < cosine)) continue;
        const double shortest = curves.radius[i];
        if (curves.arc[i] - forced.back() < shortest || length - curves.arc[i] < shortest) continue;
        forced.push_back(curves.arc[i]);
        first = t;
    }
    forced.push_back(length);
    return forced;
}

void append_even(std::vector<double>& cuts, double from, double to, std::int64_t pieces) {
    for (std::int64_t k = 1; k < pieces; ++k) cuts.push_back(from + (to - from) * double(k) / double(pieces));
    cuts.push_back(to);
}

// Point of the curve strictly between two cuts that is farthest from the first; -1 if there is none.
std::ptrdiff_t farthest_between(const Curves& curves, std::size_t c, double from, double to) {
    const auto base = curves.arc.begin();
    const auto begin = std::upper_bound(base + curves.first[c], base + curves.first[c + 1], from);
    const auto end = std::lower_bound(begin, base + curves.first[c + 1], to);
    const Vec3 start = curves.position_at(c, from);
    std::ptrdiff_t farthest = -1;
    double distance = 0;
    for (auto i = begin - base; i < end - base; ++i) {
        const double d = (curves.point[i] - start).norm();
        if (d > distance) {
            distance = d;
            farthest = i;
        }
    }
    return farthest;
}

void open_loops(const Curves& curves, std::size_t c, std::vector<double>& cuts) {
    Vec3 to = curves.position_at(c, cuts.front());
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
        const Vec3 from = to;
        to = curves.position_at(c, cuts[k + 1]);
        const double x = to.x() - from.x(), y = to.y() - from.y(), z = to.z() - from.z();
        const double chord =
            std::sqrt(x * x + y * y + z * z); // by number: packed, it waited for what position_at had just stored
        if (!(chord < closed * (cuts[k + 1] - cuts[k]))) continue;
        const std::ptrdiff_t i = farthest_between(curves, c, cuts[k], cuts[k + 1]);
        if (i < 0) continue;
        cuts.insert(cuts.begin() + std::ptrdiff_t(k) + 1, curves.arc[i]);
        ++k;
    }
}

} // namespace

std::int64_t cut_curve(const Curves& curves, std::size_t c, const CutRule& rule, std::int64_t limit,
                       std::vector<double>& cuts) {
    const Wanted wanted = wanted_pieces(curves, c, rule);
    if (wanted.pieces > double(limit)) return limit + 1;
    const double length = curves.length(c), cosine = least_cosine(rule);
    const std::vector<double> forced = forced_cuts(curves, c, cosine);
    cuts.assign(1, 0.0);
    const double least = std::max(wanted.pieces, double(forced.size() - 1));
    const double tries[] = {least, least + 1, least + 2, std::ceil(1.25 * least), std::ceil(1.5 * least)};
    const auto even = std::find_if(std::begin(tries), std::end(tries),
                                   [&](double n) { return even_pieces_turn_little(curves, c, n, cosine); });
    if (even != std::end(tries)) {
        append_even(cuts, 0, length, std::int64_t(*even));
    } else {
        for (std::size_t k = 0; k + 1 < forced.size(); ++k) {
            const double pieces = std::ceil((forced[k + 1] - forced[k]) / wanted.length - rounding);
            append_even(cuts, forced[k], forced[k + 1], std::int64_t(std::max(1.0, pieces)));
        }
    }
    open_loops(curves, c, cuts);
    return std::min(std::int64_t(cuts.size()) - 1, limit + 1);
}

std::int64_t count_pieces(const Curves& curves, const CutRule& rule, std::int64_t limit) {
    double least = 0; // so many come to be whatever turns
    for (std::size_t c = 0; c < curves.size(); ++c) least += 0.99 * (wanted_pieces(curves, c, rule).pieces - 1);
    if (least > double(limit)) return limit + 1;
    std::vector<double> cuts;
    std::int64_t pieces = 0;
    for (std::size_t c = 0; c < curves.size() && pieces <= limit; ++c)
        pieces += cut_curve(curves, c, rule, limit - pieces, cuts);
    return std::min(pieces, limit + 1);
}

} // namespace bough

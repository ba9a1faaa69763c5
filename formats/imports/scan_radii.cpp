#include "scan_radii.h"
#include "formats/plain_text.h"
#include "lib/model/polyline.h"
#include "pipe_rule.h"
#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace bough {
namespace {

double volume(const Splines& s) {
    double sum = 0;
    for (std::size_t b = 0; b < s.branches(); ++b)
        for (auto k = std::size_t(s.first_point[b]); k + 1 < std::size_t(s.first_point[b + 1]); ++k) {
            const double x = s.radius[k], y = s.radius[k + 1];
            sum += (s.point[k + 1] - s.point[k]).norm() * (x * x + x * y + y * y);
        }
    return std::numbers::pi / 3 * sum;
}

// Of each branch those that it bears, from its tip to its base.
struct Bearers {
    std::vector<std::size_t> borne, first;
};

Bearers bearers_of(const Splines& s) {
    Bearers of;
    for (std::size_t b = 0; b < s.branches(); ++b)
        if (s.parent[b] >= 0) of.borne.push_back(b);
    std::sort(of.borne.begin(), of.borne.end(), [&](std::size_t a, std::size_t b) {
        return std::tuple(s.parent[a], -s.parent_at[a], a) < std::tuple(s.parent[b], -s.parent_at[b], b);
    });
    of.first.assign(s.branches() + 1, 0);
    for (const std::size_t b : of.borne) ++of.first[std::size_t(s.parent[b]) + 1];
    for (std::size_t b = 0; b < s.branches(); ++b) of.first[b + 1] += of.first[b];
    return of;
}

// [m] of wood beyond each point.
std::vector<double> wood_beyond(const Splines& s, const Bearers& of) {
    std::vector<double> beyond(s.points(), 0);
    for (std::size_t b = s.branches(); b-- > 0;) {
        const auto from = std::size_t(s.first_point[b]);
        const std::vector<double> arc = arc_lengths(points_of(s, b));
        double borne = 0;
        std::size_t next = of.first[b];
        for (std::size_t k = arc.size(); k-- > 0;) {
            for (; next < of.first[b + 1] && s.parent_at[of.borne[next]] * arc.back() >= arc[k]; ++next)
                borne += beyond[std::size_t(s.first_point[of.borne[next]])];
            beyond[from + k] = arc.back() - arc[k] + borne;
        }
    }
    return beyond;
}

// On the way from the ground.
struct LastSeenPlace {
    double radius = 0, beyond = 0;
    bool ends = false; // what comes after is not
};

double bound_beyond(const LastSeenPlace& last, double beyond) {
    const double share = last.beyond > 0 ? std::min(1.0, beyond / last.beyond) : 0;
    return std::max(last.radius * std::pow(share, 1 / pipe_exponent), shoot_radius);
}

} // namespace

void bound_scan_radii(Splines& s, ImportNotes& notes) {
    const Bearers of = bearers_of(s);
    const std::vector<double> beyond = wood_beyond(s, of);
    const double before = volume(s);
    std::vector<LastSeenPlace> at_foot(s.branches()), along;
    std::size_t thinner = 0;
    for (std::size_t b = 0; b < s.branches(); ++b) { // parents first
        const auto from = std::size_t(s.first_point[b]);
        const std::vector<double> arc = arc_lengths(points_of(s, b));
        LastSeenPlace last = s.parent[b] < 0 ? LastSeenPlace{s.radius[from], beyond[from], false} : at_foot[b];
        along.clear();
        for (std::size_t k = from; k < from + arc.size(); ++k) {
            double& r = s.radius[k];
            if (!last.ends && r >= seen_radius) {
                last = {r, beyond[k], false};
            } else {
                last.ends = true;
                if (const double most = bound_beyond(last, beyond[k]); r > most) r = most, ++thinner;
            }
            along.push_back(last);
        }
        std::size_t k = arc.size() - 1;
        for (std::size_t c = of.first[b]; c < of.first[b + 1]; ++c) { // from the tip to the base
            while (k > 0 && arc[k] > s.parent_at[of.borne[c]] * arc.back()) --k;
            at_foot[of.borne[c]] = along[k];
        }
    }
    notes.lines.push_back("--scan-radii: " + std::to_string(thinner) + " of " + std::to_string(s.points()) +
                          " radii made thinner by the pipe rule (r^" + shown(pipe_exponent) +
                          " goes with the length of wood beyond, from where a branch is last more than " +
                          shown(2000 * seen_radius) + " mm thick): of " + shown(1000 * before) + " dm3 of wood " +
                          shown(1000 * volume(s)) + " are left");
}

} // namespace bough

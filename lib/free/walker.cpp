#include "walker.h"
#include "../base/angles.h"
#include "../base/shortest_text.h"
#include "../model/drawn_pose.h"
#include <algorithm>
#include <numbers>
#include <stdexcept>

namespace bough {
namespace {

struct Drawn : DrawnPose {
    const Tree& tree;
    explicit Drawn(const Tree& drawn) : DrawnPose(drawn_pose(drawn)), tree(drawn) {}
    Vec3 at(const Selected& place) const { return x_w[place.body] + R_wb[place.body] * place.point_b; }
};

void add_piece(const Drawn& drawn, WalkLeg& leg, std::size_t body, const Vec3& from_b, const Vec3& to_b) {
    const double length = (to_b - from_b).norm();
    if (length == 0 && !leg.pieces.empty()) return;
    const Vec3 along = length > 0 ? Vec3(drawn.R_wb[body] * (to_b - from_b) / length) : Vec3(Vec3::Zero());
    leg.pieces.push_back({body, from_b, to_b, along, leg.length});
    leg.length += length;
}

// Through the body that carries both; false where there is none.
bool walk_along(const Drawn& drawn, const Selected& from, const Selected& to, WalkLeg& leg) {
    const Tree& tree = drawn.tree;
    std::vector<std::size_t> up{from.body}, down{to.body}; // parents have smaller numbers
    while (up.back() != down.back()) {
        std::vector<std::size_t>& later = up.back() > down.back() ? up : down;
        if (tree.parent[later.back()] < 0) return false;
        later.push_back(std::size_t(tree.parent[later.back()]));
    }
    Vec3 point = from.point_b;
    for (std::size_t k = 0; k + 1 < up.size(); ++k) {
        add_piece(drawn, leg, up[k], point, Vec3::Zero());
        point = tree.joint_position[up[k]];
    }
    for (std::size_t k = down.size(); k-- > 1;) {
        add_piece(drawn, leg, down[k], point, tree.joint_position[down[k - 1]]);
        point = Vec3::Zero();
    }
    add_piece(drawn, leg, to.body, point, to.point_b);
    return true;
}

void leap(const Drawn& drawn, const Selected& from, const Selected& to, const Walker& walker, const Vec3& gravity,
          const std::string& at, WalkLeg& leg) {
    leg.leap = true;
    leg.pieces = {{from.body, from.point_b, from.point_b, Vec3::Zero(), 0},
                  {to.body, to.point_b, to.point_b, Vec3::Zero(), 0}};
    const double flight = leg.end - leg.start - 2 * walker.push;
    if (!(flight > 0))
        throw std::out_of_range(at + "/time: leaves " + std::to_string(leg.end - leg.start) +
                                " s for a leap, expected more than the " + shortest_text(2 * walker.push) +
                                " s of its push and its landing");
    leg.leave = (drawn.at(to) - drawn.at(from)) / flight - gravity * (flight / 2);
    leg.land = leg.leave + gravity * flight;
}

Selected stop_of(const Tree& tree, const std::vector<TreeRange>& ranges, const Walker::Stop& stop,
                 const std::string& at) {
    std::vector<Selected> found;
    try {
        found = select(tree, ranges, stop.on);
    } catch (const std::out_of_range& error) {
        throw std::out_of_range(at + "/on: " + error.what());
    }
    if (found.size() != 1)
        throw std::out_of_range(at + "/on: names " + std::to_string(found.size()) + " bodies, expected one");
    return found.front();
}

// Of a velocity, the part that is there after the part x of a push.
double pushed(double x) {
    if (x <= 0) return 0;
    return x >= 1 ? 1 : x - std::sin(two_pi * x) / two_pi;
}

const WalkLeg& leg_at(const Walk& walk, double t) {
    const auto next = std::find_if(walk.legs.begin(), walk.legs.end(), [t](const WalkLeg& leg) { return t < leg.end; });
    return next == walk.legs.end() ? walk.legs.back() : *next;
}

// [1] of a leg's time that is behind at t.
double part_of(const WalkLeg& leg, double t) {
    return std::clamp((t - leg.start) / (leg.end - leg.start), 0.0, 1.0);
}

// The piece that the way's part x leads to; where it ends at x, that one.
const WalkPiece& piece_at(const WalkLeg& leg, double way) {
    const auto after = std::upper_bound(leg.pieces.begin() + 1, leg.pieces.end(), way,
                                        [](double w, const WalkPiece& piece) { return w < piece.at; });
    return *(after - 1);
}

double way_of(const WalkLeg& leg, double t) {
    const double x = part_of(leg, t);
    return leg.length * x * x * x * (10 - 15 * x + 6 * x * x);
}

} // namespace

Walk make_walk(const Tree& tree, const std::vector<TreeRange>& ranges, const Walker& walker, const Vec3& gravity,
               const std::string& at) {
    const Drawn drawn(tree);
    Walk walk{walker.mass, walker.radius, walker.push, gravity, {}};
    Selected last{};
    for (std::size_t k = 0; k < walker.stops.size(); ++k) {
        const Walker::Stop& stop = walker.stops[k];
        const std::string stop_at = at + "/stops/" + std::to_string(k);
        const Selected here = stop_of(tree, ranges, stop, stop_at);
        if (k > 0) {
            WalkLeg leg{walker.stops[k - 1].time, stop.time, false, {}};
            if (stop.leap || !walk_along(drawn, last, here, leg))
                leap(drawn, last, here, walker, gravity, stop_at, leg);
            walk.legs.push_back(std::move(leg));
        }
        last = here;
    }
    return walk;
}

Vec3 walker_velocity(const Walk& walk, double t) {
    const WalkLeg& leg = leg_at(walk, t);
    if (t <= leg.start || t >= leg.end) return Vec3::Zero();
    if (!leg.leap) {
        const double x = part_of(leg, t);
        return leg.length * 30 * x * x * (1 - x) * (1 - x) / (leg.end - leg.start) *
               piece_at(leg, way_of(leg, t)).along;
    }
    const double off = leg.start + walk.push, on = leg.end - walk.push;
    if (t < off) return pushed((t - leg.start) / walk.push) * leg.leave;
    if (t < on) return leg.leave + walk.gravity * (t - off);
    return pushed((leg.end - t) / walk.push) * leg.land;
}

WalkerPlace walker_place(const Walk& walk, double t) {
    const WalkLeg& leg = leg_at(walk, t);
    if (leg.leap) {
        const WalkPiece &from = leg.pieces.front(), &to = leg.pieces.back();
        const double off = leg.start + walk.push, flight = leg.end - walk.push - off, after = t - off;
        if (after <= 0) return {from.body, from.body, from.from_b, from.from_b};
        if (after >= flight) return {to.body, to.body, to.from_b, to.from_b};
        return {from.body, to.body,        from.from_b,
                to.from_b, after / flight, walk.gravity * (after * (after - flight) / 2)};
    }
    const double way = way_of(leg, t);
    const WalkPiece& piece = piece_at(leg, way);
    const double length = (piece.to_b - piece.from_b).norm();
    const double part = length > 0 ? std::clamp((way - piece.at) / length, 0.0, 1.0) : 0;
    const Vec3 point = piece.from_b + part * (piece.to_b - piece.from_b);
    return {piece.body, piece.body, point, point};
}

std::optional<WalkerLoad> walker_load(const Walk& walk, double t, double h) {
    const double first = walk.legs.front().start;
    if (t + h <= first) return std::nullopt;
    const WalkerPlace place = walker_place(walk, t + h / 2);
    const WalkLeg& leg = leg_at(walk, t + h / 2);
    if (leg.leap && t >= leg.start + walk.push && t + h <= leg.end - walk.push) return std::nullopt;
    const double weight = walk.push > 0 && t < first + walk.push ? pushed((t + h - first) / walk.push) : 1;
    const Vec3 turned = (walker_velocity(walk, t + h) - walker_velocity(walk, t)) / h;
    const Vec3 force = walk.mass * (weight * walk.gravity - turned);
    const bool left = place.part < 0.5;
    return WalkerLoad{left ? place.body : place.next, left ? place.point_b : place.next_b, force};
}

} // namespace bough

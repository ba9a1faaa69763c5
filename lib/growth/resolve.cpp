#include "resolve.h"
#include "../model/body_shape.h"
#include "../model/tree_arrays.h"
#include "carry.h"
#include "resolve_sums.h"
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace bough {
namespace {

constexpr double most_stiffness = 1e12; // [N m/rad]
constexpr double most_lever = 2;        // of a clump's joint, over its radius of gyration
constexpr double least_narrowed = 0.2;  // of a clump's spread: no body is without inertia about any axis
constexpr double most_droop = 0.8;      // [rad]
constexpr double most_apart = 0.8;      // of the second moments of a clump's held wood, taken by its way from the clump
constexpr double most_matched = 7;      // by how much a joint is stiffened or softened, as a power of e

// [m^2] of leaves that face all ways.
double area_in_air(const Sums& s, Kind many) {
    return s.met + s.wood * wood_in_leaf(many);
}

// The middle of what the air takes hold of.
Vec3 middle_in_air(const Sums& s, Kind many) {
    const double area = area_in_air(s, many);
    return area > 0 ? Vec3(s.air / area) : s.com;
}

// Tree::leaf_facing of what the air takes hold of. Where it is below 0, more leaves' edges than faces point up.
double leaf_facing(const Sums& s) {
    const double all = s.faces.trace(), square = all > 0 ? s.faces(1, 1) / all : 0;
    return std::clamp((3 * square - 1) / 2, 0.0, 1.0);
}

class Lumper {
public:
    Lumper(const Tree& whole, const Flexibility& give, const Resolution& chosen)
        : whole_(whole), give_(give), chosen_(chosen), many_(kind_of_many_leaves(whole)),
          sum_(sum_up(whole, give, chosen)) {}
    Tree run();

private:
    void set_joint_and_mass(std::size_t b);
    void shape_wood(std::size_t b, std::size_t i);
    void shape_clump(std::size_t b);
    struct Swinging {
        double mass, over_lever2, droop; // [kg]; r^2 / L^2; [m] least L
    };
    Swinging swinging(const Sums&, const Vec3& z, double facing) const;
    Vec3 place_of_kept_mass(const Sums&, double kept) const;
    void give_rest_to_wood(std::size_t on, std::size_t clump, double kept, double share, const Vec3& at);
    void match_give();

    const Tree& whole_;
    const Flexibility& give_;
    const Resolution& chosen_;
    const Kind many_;
    std::vector<Sums> sum_;
    Tree tree_;
    DrawnPose pose_;
};

// What the first of its bodies brings along.
void Lumper::set_joint_and_mass(std::size_t b) {
    const Sums& s = sum_[b];
    const Mat3& R = pose_.R_wb[b];
    const bool root = chosen_.on[b] < 0;
    const auto p = std::size_t(root ? 0 : chosen_.on[b]);
    const Mat3 near = root ? Mat3(Mat3::Identity()) : Mat3(pose_.R_wb[p].transpose());
    tree_.joint_position[b] = near * (pose_.x_w[b] - (root ? Vec3(Vec3::Zero()) : pose_.x_w[p]));
    tree_.joint_rotation[b] = Quat(Mat3(near * R)).normalized();
    tree_.mass[b] = s.mass;
    tree_.com[b] = R.transpose() * (s.com - pose_.x_w[b]);
    const Mat3 I = R.transpose() * s.inertia * R;
    tree_.inertia[b] = 0.5 * (I + I.transpose());
}

// Pieces of a branch, and what is one with them.
void Lumper::shape_wood(std::size_t b, std::size_t i) {
    const Sums& s = sum_[b];
    const auto last = std::size_t(s.last);
    const Vec3 from = give_.pose.x_w[i], to = give_.pose.at(last, Vec3(0, 0, whole_.size[last][0]));
    const double length = (to - from).norm();
    pose_.x_w[b] = from;
    pose_.R_wb[b] = give_.pose.R_wb[i];
    if (last != i && length > 0.1 * whole_.size[i][0]) {
        pose_.R_wb[b] = least_turn(Quat(give_.pose.R_wb[i]), to - from).toRotationMatrix();
        tree_.size[b] = {length, whole_.size[i][1], whole_.size[last][2]};
    }
    const double own = frustum_section(tree_.size[b][0], tree_.size[b][1], tree_.size[b][2]) *
                       met_by_wind_across(pose_.R_wb[b].col(2));
    if (s.parts > 1 && own > 0) tree_.drag[b] = s.wood / own;
    if (last != i)
        tree_.stiffness[b] = (pose_.R_wb[b].transpose() * s.yields * pose_.R_wb[b]).diagonal().cwiseInverse();
}

// How much of a clump's wood is taken for held by what bears it, the rest with the leaves on a joint, so that a slow push bends the clump
// by as much, at as much kinetic energy and as much of it taken by the air, as it does its parts: with c its centre's way, m what moves,
// r^2 = I / m across, L the joint's lever,
//   give S = 2 m c,   swing Q = 2 m c^2 (1 + r^2 / L^2),   braked D = A c^2 (T + 4 r^2 / L^2)
// A the area of leaves, T how the air damps their motion across the axis (resolve_sums.h), 4 from how it takes a clump's turning (air.h). c and L
// left out,
//   D / A m^2 - 2 Q m + (4 - T) S^2 / 4 = 0
// of which m is the larger root, between S^2 / 2 Q, where the mass is a point, and all of it. Where the parts brake more than any m does, D / Q is
// that of a point: m = A T Q / 2 D.
Lumper::Swinging Lumper::swinging(const Sums& s, const Vec3& z, double facing) const {
    Swinging w;
    const double A = area_in_air(s, many_) / met_by_wind(Vec3::UnitY(), facing), S = s.give, Q = s.swing;
    if (!(S > 0 && Q > 0)) return {s.mass, 0, 0};
    const Mat3 damped = bough::damped(many_, Vec3::UnitY(), facing);
    const double T = damped.trace() - z.dot(damped * z);
    const double square = Q * Q - (4 - T) * S * S / 4 * s.braked / A;
    w.mass =
        square > 0 ? std::max((Q + std::sqrt(square)) * A / s.braked, S * S / (2 * Q)) : A * T * Q / (2 * s.braked);
    w.mass = std::min(w.mass, s.mass);
    w.over_lever2 = std::max(2 * w.mass * Q / (S * S) - 1, 0.0);
    w.droop = growing_gravity * S / (2 * w.mass * most_droop);
    return w;
}

void Lumper::shape_clump(std::size_t b) {
    Sums& s = sum_[b];
    const auto host_body = std::size_t(tree_.parent[b]);
    const double gyration = std::sqrt(s.inertia.trace() / 2 / s.mass);
    const Vec3 foot = s.joints / s.joined - gyration * pose_.R_wb[host_body].col(2);
    const Vec3 way = s.com - foot;
    const Vec3 z = way.norm() > 1e-9 * gyration ? Vec3(way.normalized()) : Vec3(pose_.R_wb[host_body].col(2));
    const Vec3 side = Vec3::UnitY().cross(z);
    const Vec3 x = side.norm() > 1e-6 ? Vec3(side.normalized()) : Vec3(Vec3::UnitX()), y = z.cross(x);
    const double facing = leaf_facing(s);
    pose_.R_wb[b].col(0) = x;
    pose_.R_wb[b].col(1) = y;
    pose_.R_wb[b].col(2) = z;
    const Mat3 spread = pose_.R_wb[b].transpose() * s.inertia * pose_.R_wb[b] / s.mass;
    const double across = 0.5 * (spread(0, 0) + spread(1, 1));
    const Swinging swinging = this->swinging(s, z, facing);
    const Vec3 at = place_of_kept_mass(s, swinging.mass);
    // Held out level it droops no more than branches do (carry.h).
    const double wanted = swinging.over_lever2 > 0 ? std::sqrt(across / swinging.over_lever2) : most_lever * gyration;
    const double lever = std::max(std::min(wanted, most_lever * gyration), swinging.droop);
    const double narrowed =
        across > 0 ? std::clamp(swinging.over_lever2 * lever * lever / across, least_narrowed, 1.0) : 1;
    pose_.x_w[b] = at - lever * z;
    // An ellipsoid (clump.h) of as wide a spread.
    const double along = std::max(across - 0.5 * spread(2, 2), 0.0);
    tree_.size[b] = {lever + std::sqrt(5 * along), 2 * std::sqrt(5 * spread(2, 2) / (1 + clump_depth * clump_depth)),
                     s.thickness / s.leaves};
    give_rest_to_wood(host_body, b, swinging.mass, narrowed, at);
    const double first = s.mass * lever;
    const double swing = first * lever + s.mass * narrowed * across; // about the joint
    const double bend = s.give > 0 ? 2 * first * first / s.give + give_.omega2 * swing : most_stiffness;
    tree_.stiffness[b] = {bend, bend, bend * spread(2, 2) / (lever * lever + across)};
    tree_.leaf_count[b] = std::int32_t(std::min<std::int64_t>(s.count, std::numeric_limits<std::int32_t>::max()));
    const double one = s.leaves / double(tree_.leaf_count[b]), slim = s.proportion / s.leaves;
    tree_.leaf_length[b] = std::sqrt(2 * one / slim);
    tree_.leaf_width[b] = std::sqrt(2 * one * slim);
    tree_.leaf_facing[b] = facing;
    tree_.drag[b] =
        area_in_air(s, many_) / met_by_wind(Vec3::UnitY(), facing) / leaf_area(tree_.size[b][0], tree_.size[b][1]);
}

// Where the mass that a clump keeps is: in the middle of what the air takes hold of, as leaves are further out than the wood under them. What is
// held is as much nearer, so that all together has its centre of mass and inertia still. d being the way from the parts' centre of mass, M their
// mass, C its second moments about it, m what is kept, that takes the part
//   m M^2 / (M - m)^2 d^T C^-1 d
// of the second moments of what is held. Where that is more than most_apart, d is as much shorter.
Vec3 Lumper::place_of_kept_mass(const Sums& s, double kept) const {
    const double held = s.mass - kept;
    if (!(held > 1e-9 * s.mass)) return s.com;
    const Vec3 way = middle_in_air(s, many_) - s.com;
    const Mat3 C = (0.5 + 1e-9) * s.inertia.trace() * Mat3::Identity() - s.inertia;
    const double part = s.mass * s.mass * kept / (held * held) * way.dot(C.inverse() * way);
    return s.com + (part > most_apart ? std::sqrt(most_apart / part) : 1) * way;
}

// Gives the wood `on` all of a clump's mass but `kept`, which goes to `at`, and of that one's inertia all but a share.
void Lumper::give_rest_to_wood(std::size_t on, std::size_t clump, double kept, double share, const Vec3& at) {
    Sums &s = sum_[clump], &host = sum_[on];
    const Mat3 inertia = kept / s.mass * share * s.inertia;
    const double mass = host.mass + s.mass - kept;
    const Vec3 before = host.com;
    host.com = (host.mass * before + s.mass * s.com - kept * at) / mass;
    const auto moved = [&](double m, const Vec3& from) {
        const Mat3 d = cross_matrix<double>(from - host.com);
        return Mat3(-m * d * d);
    };
    host.inertia += moved(host.mass, before) + s.inertia + moved(s.mass, s.com) - inertia - moved(kept, at);
    host.mass = mass;
    s.mass = kept;
    s.com = at;
    s.inertia = inertia;
}

// From the tips inward: joints as soft as makes each body give what its parts gave together. That is so of a single part too, where it bears
// what is of several: those give what theirs gave, but are not borne alike. What does not stand, and what bears it, is left as soft as its parts
// one after another: there is no give to meet.
void Lumper::match_give() {
    const std::size_t n = chosen_.size();
    std::vector<Borne> on(n);
    std::vector<double> mass = tree_.mass;
    std::vector<std::uint8_t> upright(n, 1);  // all that it carries stands, as resolved
    std::vector<std::uint8_t> together(n, 0); // it is of several parts, or carries what is
    std::vector<Vec3> first(n);
    for (std::size_t b = 0; b < n; ++b) {
        first[b] = pose_.R_wb[b] * (tree_.mass[b] * tree_.com[b]);
        on[b] = own_part(tree_, b, pose_.R_wb[b], give_.omega2);
    }
    for (std::size_t b = n; b-- > 0;) {
        const Sums& s = sum_[b];
        const Vec3 drawn = tree_.stiffness[b];
        const bool root = tree_.parent[b] < 0;
        const auto p = std::size_t(root ? 0 : tree_.parent[b]);
        const Vec3 arm = root ? Vec3(Vec3::Zero()) : Vec3(pose_.x_w[b] - pose_.x_w[p]);
        // A clump's twist, in which its weight has no part, stays.
        const auto K_at = [&](double factor) {
            tree_.stiffness[b] = factor * drawn;
            if (chosen_.clump[b]) tree_.stiffness[b].z() = drawn.z();
            return stiffness_w(tree_, b, pose_.R_wb[b]);
        };
        const auto gives_more = [&](double log_factor) {
            const Yielding y = yielding(K_at(std::exp(log_factor)), first[b], on[b], arm);
            return !y.stands || y.give > s.give;
        };
        together[b] |= std::uint8_t(s.parts > 1);
        double factor = 1;
        double low = -most_matched, high = most_matched;
        if (together[b] && s.give > 0 && s.upright && upright[b] && gives_more(low) && !gives_more(high)) {
            while (high - low > 1e-6) {
                const double middle = (low + high) / 2;
                (gives_more(middle) ? low : high) = middle;
            }
            factor = std::exp(high);
        }
        const Mat3 K = K_at(factor);
        const Yielding y = yielding(K, first[b], on[b], arm);
        const double strain = y.turn.cwiseProduct(K * y.turn).sum();
        if (s.parts > 1 && strain > 0) tree_.damping[b] = std::min(s.loss / strain, s.damping);
        if (root) continue;
        together[p] |= together[b];
        upright[p] &= std::uint8_t(upright[b] && y.stands);
        mass[p] += mass[b];
        first[p] += first[b] + mass[b] * arm;
        on[p] += y.passed;
    }
}

Tree Lumper::run() {
    copy_labels(tree_, whole_);
    tree_.resize(chosen_.size());
    tree_.drag.assign(chosen_.size(), 1);
    tree_.leaf_count.assign(chosen_.size(), 1);
    tree_.leaf_length.assign(chosen_.size(), 0);
    tree_.leaf_width.assign(chosen_.size(), 0);
    tree_.leaf_facing.assign(chosen_.size(), 0);
    pose_.R_wb.resize(chosen_.size());
    pose_.x_w.resize(chosen_.size());
    for (std::size_t b = 0; b < chosen_.size(); ++b) {
        const auto i = std::size_t(chosen_.first[b]);
        const Kind kind = whole_.kind[i];
        tree_.kind[b] = kind;
        tree_.branch[b] = whole_.branch[i];
        tree_.level[b] = whole_.level[i];
        tree_.s[b] = whole_.s[i];
        tree_.size[b] = whole_.size[i];
        tree_.stiffness[b] = whole_.stiffness[i];
        tree_.damping[b] = whole_.damping[i];
        if (!whole_.leaf_count.empty()) tree_.leaf_count[b] = whole_.leaf_count[i];
        if (!whole_.leaf_facing.empty()) tree_.leaf_facing[b] = whole_.leaf_facing[i];
        tree_.parent[b] = chosen_.on[b];
        pose_.R_wb[b] = give_.pose.R_wb[i];
        pose_.x_w[b] = give_.pose.x_w[i];
        if (kind == Kind::branch) shape_wood(b, i);
        if (chosen_.clump[b]) shape_clump(b);
    }
    for (std::size_t b = 0; b < chosen_.size(); ++b) set_joint_and_mass(b);
    match_give();
    if (std::all_of(chosen_.clump.begin(), chosen_.clump.end(), [](std::uint8_t c) { return c == 0; })) {
        tree_.leaf_length.clear();
        tree_.leaf_width.clear();
        if (whole_.leaf_facing.empty()) tree_.leaf_facing.clear();
        if (whole_.leaf_count.empty()) tree_.leaf_count.clear();
    }
    return std::move(tree_);
}

} // namespace

Tree resolve(const Tree& whole, std::int64_t bodies) {
    if (bodies >= std::int64_t(whole.size_bodies())) return whole;
    const Flexibility give = flexibility_at_sway(whole);
    return Lumper(whole, give, choose_bodies(whole, give, bodies)).run();
}

} // namespace bough

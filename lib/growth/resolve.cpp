#include "resolve.h"
#include "../model/body_shape.h"
#include "resolve_choice.h"
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace bough {
namespace {

constexpr double most_stiffness = 1e12;            // [N m/rad]
constexpr double lever_over_gyration = 1.15;       // of a clump's joint
constexpr double gravity = 9.81, most_droop = 0.8; // [m/s^2], [rad]
// A twig's drag in that of leaves that face all ways, of the same area (air.h): twice as much broadside, and leaves fold, which is made up for at 8 m/s.
constexpr double wood_in_leaf = 2 * (1 + 8 / 7.5);

// What the parts of a resolved body come to, about its joint, in the world's axes.
struct Sums {
    double mass = 0, give = 0, loss = 0;
    Vec3 first = Vec3::Zero();  // [kg m] about the world's origin
    double leaves = 0;          // [m^2]
    double met = 0;             // [m^2] of leaves that face all ways, of the same drag in horizontal winds
    double wood = 0;            // [m^2] of wood across the wind, of the same drag in horizontal winds
    double thickness = 0;       // [m] times the leaves' area
    double proportion = 0;      // [1] likewise
    std::int64_t count = 0;     // leaves
    Vec3 joints = Vec3::Zero(); // [kg m] of what hangs directly on the wood, by its mass
    double joined = 0;          // [kg]
    std::int32_t parts = 0;
    Mat3 yields = Mat3::Zero();  // [rad/(N m)] the joints of its own branch to a torque about the first of them, world
    std::int32_t last = -1;      // the last piece of its branch
    Mat3 inertia = Mat3::Zero(); // about the centre of mass, world
    Vec3 com = Vec3::Zero();     // [m] world
};

// A blade's drag over that of one that faces all ways (air.h), mean over horizontal winds: n its normal, (u.n)^2 is (1 - n_y^2) / 2 of |u|^2, which a quarter
// of its drag does not ask for. At 8 m/s blades that stream give the same within a tenth, as they turn to the wind as often as from it.
double met_by_wind(const Vec3& normal) {
    return 0.5 + 0.75 * (1 - normal.y() * normal.y());
}

// A cylinder's drag over that of one across the wind, mean over horizontal winds: of (1 - c^2)^3/2, c = u.t, to second order in the axis' level part, and
// exact for upright and level ones.
double met_by_wind_across(const Vec3& axis) {
    const double level = 1 - axis.y() * axis.y();
    return 1 - 0.75 * level + 0.1744 * level * level;
}

// What a joint further out, whose load's first moment is `outer`, feels of a torque about the first joint of its branch, whose load's is `inner`: all loads
// growing alike. Torques are across the moments under any acceleration; along them, that of the moment's own share. No more than all of it.
Mat3 share_of_torque(const Vec3& outer, const Vec3& inner) {
    const double square = inner.squaredNorm();
    if (!(square > 0)) return Mat3::Identity();
    const double share = std::clamp(outer.dot(inner) / square, 0.0, 1.0);
    const Mat3 M =
        (outer.dot(inner) * Mat3::Identity() - inner * outer.transpose() + share * inner * inner.transpose()) / square;
    return M / std::max(1.0, M.norm() / std::sqrt(3.0));
}

double section(const Vec3& size) {
    return frustum_section(size[0], size[1], size[2]);
}

class Lumper {
public:
    Lumper(const Tree& whole, const Flexibility& give, const Resolution& chosen)
        : whole_(whole), give_(give), chosen_(chosen), sum_(chosen.size()) {}
    Tree run();

private:
    void add_up();
    void place(std::size_t b);
    void wood(std::size_t b, std::size_t i);
    void clump(std::size_t b);
    void match();

    const Tree& whole_;
    const Flexibility& give_;
    const Resolution& chosen_;
    std::vector<Sums> sum_;
    Tree tree_;
    DrawnPose pose_;
};

void Lumper::add_up() {
    const std::size_t n = whole_.size_bodies();
    for (std::size_t i = 0; i < n; ++i) {
        Sums& s = sum_[std::size_t(chosen_.body[i])];
        const Vec3& size = whole_.size[i];
        s.mass += whole_.mass[i];
        s.first += whole_.mass[i] * give_.pose.at(i, whole_.com[i]);
        s.give += give_.give[i];
        s.loss += give_.loss[i];
        ++s.parts;
        if (is_flat(whole_.kind[i])) {
            const double area = foliage_area(whole_, i);
            s.leaves += area;
            s.met += area * (is_clump(whole_, i) ? 1 : met_by_wind(give_.pose.R_wb[i].col(1)));
            s.thickness += area * size[2];
            s.proportion += area * size[1] / size[0];
            s.count += whole_.leaf_count.empty() ? 1 : whole_.leaf_count[i];
        } else if (whole_.kind[i] == Kind::branch) {
            s.wood += section(size) * met_by_wind_across(give_.pose.R_wb[i].col(2));
        }
        const std::int32_t p = whole_.parent[i];
        if (p < 0 || chosen_.body[std::size_t(p)] != chosen_.body[i]) {
            s.joints += give_.mass[i] * give_.pose.x_w[i];
            s.joined += give_.mass[i];
        }
        const auto first = std::size_t(chosen_.first[std::size_t(chosen_.body[i])]);
        if (whole_.kind[i] == Kind::branch && whole_.kind[first] == Kind::branch &&
            whole_.branch[i] == whole_.branch[first]) {
            s.last = std::int32_t(i);
            const Mat3 M = share_of_torque(give_.first[i], give_.first[first]);
            s.yields += M.transpose() * stiffness_w(whole_, i, give_.pose.R_wb[i]).inverse() * M;
        }
    }
    for (Sums& s : sum_) s.com = s.first / s.mass;
    for (std::size_t i = 0; i < n; ++i) {
        Sums& s = sum_[std::size_t(chosen_.body[i])];
        const Mat3& R = give_.pose.R_wb[i];
        const Mat3 d = cross_matrix<double>(give_.pose.at(i, whole_.com[i]) - s.com);
        s.inertia += R * whole_.inertia[i] * R.transpose() - whole_.mass[i] * d * d;
    }
}

// What the first of its bodies brings along.
void Lumper::place(std::size_t b) {
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
void Lumper::wood(std::size_t b, std::size_t i) {
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
    const double own = section(tree_.size[b]) * met_by_wind_across(pose_.R_wb[b].col(2));
    if (s.parts > 1 && own > 0) tree_.drag[b] = s.wood / own;
    if (last != i)
        tree_.stiffness[b] = (pose_.R_wb[b].transpose() * s.yields * pose_.R_wb[b]).diagonal().cwiseInverse();
}

void Lumper::clump(std::size_t b) {
    const Sums& s = sum_[b];
    const auto host_body = std::size_t(tree_.parent[b]);
    const double gyration = std::sqrt(s.inertia.trace() / 2 / s.mass);
    const Vec3 foot = s.joints / s.joined - gyration * pose_.R_wb[host_body].col(2);
    const Vec3 way = s.com - foot;
    const Vec3 z = way.norm() > 1e-9 * gyration ? Vec3(way.normalized()) : Vec3(pose_.R_wb[host_body].col(2));
    // Held out level it droops no more than branches do (carry.h).
    const double lever = std::max({lever_over_gyration * gyration, gravity * s.give / (2 * s.mass * most_droop)});
    const Vec3 side = Vec3::UnitY().cross(z);
    const Vec3 x = side.norm() > 1e-6 ? Vec3(side.normalized()) : Vec3(Vec3::UnitX());
    pose_.R_wb[b].col(0) = x;
    pose_.R_wb[b].col(1) = z.cross(x);
    pose_.R_wb[b].col(2) = z;
    pose_.x_w[b] = s.com - lever * z;
    const Mat3 about_z = pose_.R_wb[b].transpose() * s.inertia * pose_.R_wb[b];
    const double first = s.mass * lever;
    const double swing = first * lever + 0.5 * (about_z(0, 0) + about_z(1, 1));
    const double bend = s.give > 0 ? 2 * first * first / s.give : most_stiffness;
    tree_.stiffness[b] = {bend, bend, bend * about_z(2, 2) / swing};
    // An ellipsoid (clump.h) of as wide a spread.
    const double along = std::max(0.5 * (about_z(0, 0) + about_z(1, 1) - about_z(2, 2)) / s.mass, 0.0);
    const double across = about_z(2, 2) / s.mass;
    tree_.size[b] = {lever + std::sqrt(5 * along), 2 * std::sqrt(5 * across / (1 + clump_depth * clump_depth)),
                     s.thickness / s.leaves};
    tree_.leaf_count[b] = std::int32_t(std::min<std::int64_t>(s.count, std::numeric_limits<std::int32_t>::max()));
    const double one = s.leaves / double(s.count), slim = s.proportion / s.leaves;
    tree_.leaf_length[b] = std::sqrt(2 * one / slim);
    tree_.leaf_width[b] = std::sqrt(2 * one * slim);
    tree_.drag[b] = (s.met + s.wood * wood_in_leaf) / leaf_area(tree_.size[b][0], tree_.size[b][1]);
}

// From the tips inward: joints as soft as makes each body of several parts give what they gave together.
void Lumper::match() {
    const std::size_t n = chosen_.size();
    std::vector<Borne> on(n);
    std::vector<double> mass = tree_.mass;
    std::vector<Vec3> first(n);
    for (std::size_t b = 0; b < n; ++b) first[b] = pose_.R_wb[b] * (tree_.mass[b] * tree_.com[b]);
    for (std::size_t b = n; b-- > 0;) {
        const Sums& s = sum_[b];
        const Vec3 drawn = tree_.stiffness[b];
        // A clump's twist, in which its weight has no part, stays.
        const auto K_at = [&](double factor) {
            tree_.stiffness[b] = factor * drawn;
            if (chosen_.clump[b]) tree_.stiffness[b].z() = drawn.z();
            return stiffness_w(tree_, b, pose_.R_wb[b]);
        };
        double factor = 1;
        if (s.parts > 1 && s.give > 0) {
            const auto gives_more = [&](double log_factor) {
                const Yielding y = yielding(K_at(std::exp(log_factor)), first[b], on[b]);
                return !y.stands || y.give > s.give;
            };
            double low = -20, high = 20;
            while (high - low > 1e-6) {
                const double middle = (low + high) / 2;
                (gives_more(middle) ? low : high) = middle;
            }
            factor = std::exp(high);
        }
        const Mat3 K = K_at(factor);
        const Yielding y = yielding(K, first[b], on[b]);
        const double strain = y.turn.cwiseProduct(K * y.turn).sum();
        if (s.parts > 1 && strain > 0) tree_.damping[b] = s.loss / strain;
        if (tree_.parent[b] < 0) continue;
        const auto p = std::size_t(tree_.parent[b]);
        mass[p] += mass[b];
        first[p] += first[b] + mass[b] * (pose_.x_w[b] - pose_.x_w[p]);
        on[p] += y.passed;
    }
}

Tree Lumper::run() {
    add_up();
    tree_.name = whole_.name;
    tree_.material = whole_.material;
    tree_.source = whole_.source;
    tree_.color = whole_.color;
    tree_.resize(chosen_.size());
    tree_.drag.assign(chosen_.size(), 1);
    tree_.leaf_count.assign(chosen_.size(), 1);
    tree_.leaf_length.assign(chosen_.size(), 0);
    tree_.leaf_width.assign(chosen_.size(), 0);
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
        tree_.parent[b] = chosen_.on[b];
        pose_.R_wb[b] = give_.pose.R_wb[i];
        pose_.x_w[b] = give_.pose.x_w[i];
        if (kind == Kind::branch) wood(b, i);
        if (chosen_.clump[b]) clump(b);
        place(b);
    }
    match();
    if (std::all_of(chosen_.clump.begin(), chosen_.clump.end(), [](std::uint8_t c) { return c == 0; })) {
        tree_.leaf_length.clear();
        tree_.leaf_width.clear();
        if (whole_.leaf_count.empty()) tree_.leaf_count.clear();
    }
    return std::move(tree_);
}

} // namespace

Tree resolve(const Tree& whole, std::int64_t bodies) {
    if (bodies >= std::int64_t(whole.size_bodies())) return whole;
    const Flexibility give = flexibility(whole);
    return Lumper(whole, give, choose_bodies(whole, give, bodies)).run();
}

} // namespace bough

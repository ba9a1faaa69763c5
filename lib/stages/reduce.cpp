#include "reduce.h"
#include "added_motion.h"
#include "air.h"
#include "leaf_air.h"
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <numbers>

namespace bough {
namespace {

// Even over the sphere: heights in equal steps, turned by the golden angle from one to the next.
std::array<Vec3, 64> even_directions() {
    std::array<Vec3, 64> all;
    const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
    for (std::size_t k = 0; k < all.size(); ++k) {
        const double z = 1 - (2 * double(k) + 1) / double(all.size()), r = std::sqrt(1 - z * z);
        all[k] = Vec3(r * std::cos(golden * double(k)), r * std::sin(golden * double(k)), z);
    }
    return all;
}

// Least squares of sum of bodies' forces by one force law: drag = sum f.g / sum g.g, what is left of sum |f|^2.
struct Fit {
    double drag = 0, left = 0;
};
struct Fits {
    double ff = 0, fc = 0, cc = 0, fs = 0, ss = 0; // f: the sum; c: a cylinder along z, s: a sphere; of kappa A = 1
    Fit cylinder() const { return {fc / cc, ff - fc * fc / cc}; }
    Fit sphere() const { return {fs / ss, ff - fs * fs / ss}; }
};

// Places of the bodies in their groups.
void place_bodies(const Tree& whole, Reduced& r) {
    const std::size_t n = whole.size_bodies();
    r.body.resize(n);
    r.offset.resize(n);
    r.rotation.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
        const bool held = !whole.rigid.empty() && whole.rigid[i] != 0, root = whole.parent[i] < 0;
        const auto p = std::size_t(root ? 0 : whole.parent[i]);
        if (!held) {
            r.body[i] = std::int32_t(r.leader.size());
            r.offset[i] = Vec3::Zero();
            r.rotation[i] = Quat::Identity();
            r.leader.push_back(std::int32_t(i));
            continue;
        }
        r.body[i] = root ? -1 : r.body[p];
        r.offset[i] = root ? whole.joint_position[i] : Vec3(r.offset[p] + r.rotation[p] * whole.joint_position[i]);
        r.rotation[i] = whole.joint_rotation[i];
        if (!root) r.rotation[i] = (r.rotation[p] * whole.joint_rotation[i]).normalized();
    }
}

// Ranges of the reduced tree: leaders rise, so that those of one tree stand together.
void place_ranges(Reduced& r) {
    const auto leaders_before = [&](std::size_t body) {
        return std::size_t(std::lower_bound(r.leader.begin(), r.leader.end(), std::int32_t(body)) - r.leader.begin());
    };
    for (const TreeRange& range : r.whole) {
        const std::size_t first = leaders_before(range.first_body);
        r.ranges.push_back({first, leaders_before(range.first_body + range.bodies) - first, range.first_branch});
    }
}

// What a leader brings along.
void copy_leaders(const Tree& whole, Reduced& r) {
    Tree& t = r.tree;
    t.name = whole.name;
    t.material = whole.material;
    t.source = whole.source;
    t.color = whole.color;
    t.resize(r.leader.size());
    if (!whole.load.empty()) t.load.assign(r.leader.size(), 0);
    for (std::size_t g = 0; g < r.leader.size(); ++g) {
        const auto i = std::size_t(r.leader[g]);
        const std::int32_t p = whole.parent[i];
        const bool on_held = p >= 0 && !whole.rigid.empty() && whole.rigid[std::size_t(p)] != 0;
        t.parent[g] = p < 0 ? -1 : r.body[std::size_t(p)];
        t.kind[g] = whole.kind[i];
        t.mass[g] = whole.mass[i];
        t.com[g] = whole.com[i];
        t.inertia[g] = whole.inertia[i];
        t.joint_position[g] = whole.joint_position[i];
        t.joint_rotation[g] = whole.joint_rotation[i];
        if (on_held) {
            const auto q = std::size_t(p);
            t.joint_position[g] = r.offset[q] + r.rotation[q] * whole.joint_position[i];
            t.joint_rotation[g] = (r.rotation[q] * whole.joint_rotation[i]).normalized();
        }
        t.stiffness[g] = whole.stiffness[i];
        t.damping[g] = whole.damping[i];
        t.size[g] = whole.size[i];
        t.branch[g] = whole.branch[i];
        t.level[g] = whole.level[i];
        t.s[g] = whole.s[i];
    }
}

// True where body i is in a group with others.
std::vector<std::uint8_t> joined_groups(const Reduced& r) {
    std::vector<std::uint8_t> joined(r.leader.size(), 0);
    for (std::size_t i = 0; i < r.body.size(); ++i)
        if (const std::int32_t g = r.body[i]; g >= 0 && r.leader[std::size_t(g)] != std::int32_t(i))
            joined[std::size_t(g)] = 1;
    return joined;
}

// Calls visit(body, group) for the bodies of groups of more than one.
template <class Visit> void each_joined(const Reduced& r, const std::vector<std::uint8_t>& joined, Visit&& visit) {
    for (std::size_t i = 0; i < r.body.size(); ++i)
        if (r.body[i] >= 0 && joined[std::size_t(r.body[i])]) visit(i, std::size_t(r.body[i]));
}

void sum_masses(const Tree& whole, Reduced& r, const std::vector<std::uint8_t>& joined) {
    Tree& t = r.tree;
    const auto center = [&](std::size_t i) { return Vec3(r.offset[i] + r.rotation[i] * whole.com[i]); };
    for (std::size_t g = 0; g < joined.size(); ++g)
        if (joined[g]) t.mass[g] = 0, t.com[g].setZero(), t.inertia[g].setZero();
    each_joined(r, joined, [&](std::size_t i, std::size_t g) {
        t.mass[g] += whole.mass[i];
        t.com[g] += whole.mass[i] * center(i);
    });
    for (std::size_t g = 0; g < joined.size(); ++g)
        if (joined[g]) t.com[g] /= t.mass[g];
    each_joined(r, joined, [&](std::size_t i, std::size_t g) {
        const Mat3 R = r.rotation[i].toRotationMatrix();
        const Mat3 d = cross_matrix<double>(center(i) - t.com[g]);
        t.inertia[g] += R * whole.inertia[i] * R.transpose() - whole.mass[i] * d * d;
    });
    for (std::size_t i = 0; i < whole.load.size(); ++i)
        if (r.body[i] >= 0) t.load[std::size_t(r.body[i])] += whole.load[i];
}

// Mean over all directions of the wind of a body's drag, f.u, of kappa A = 1.
double mean_drag(Kind kind) {
    return kind == Kind::branch ? 3 * std::numbers::pi / 16 : is_flat(kind) ? 1.0 / 3 : 1.0;
}

// Mass at a group's joint belongs as well to what it hangs on: it turns nothing about the joint, and the joint's place is the parent's. So
// the rest can have its centre where the air acts, from the ends inward.
void center_on_pressure(const Tree& whole, Reduced& r, const std::vector<std::uint8_t>& joined, double plate_kappa) {
    Tree& t = r.tree;
    std::vector<Vec3> pressed(joined.size(), Vec3::Zero()); // [m^3] first moment of drag areas
    std::vector<double> drag(joined.size(), 0);             // [m^2]
    each_joined(r, joined, [&](std::size_t i, std::size_t g) {
        const double area = mean_drag(whole.kind[i]) * drag_area(whole.kind[i], whole.size[i], 1, plate_kappa);
        drag[g] += area;
        pressed[g] += area * Vec3(r.offset[i] + r.rotation[i] * whole.com[i]);
    });
    for (std::size_t g = joined.size(); g-- > 0;) {
        const double arm = t.com[g].norm(), first = t.mass[g] * arm;
        if (!joined[g] || !(drag[g] > 0) || !(first > 0)) continue;
        const Vec3 along = t.com[g] / arm;
        // Centres farther out leave less inertia about them, J - first to across: none of some axis at `all`.
        const Mat3 across = Mat3::Identity() - along * along.transpose();
        const Mat3 about_joint = t.inertia[g] + first * arm * across;
        const Eigen::LLT<Mat3> root(about_joint);
        if (root.info() != Eigen::Success) continue;
        const Mat3 half = root.matrixL().solve(first * across), taken = root.matrixL().solve(Mat3(half.transpose()));
        const double all = 1 / Eigen::SelfAdjointEigenSolver<Mat3>(taken, Eigen::EigenvaluesOnly).eigenvalues()[2];
        const double to = std::min(pressed[g].dot(along) / drag[g], arm + 0.95 * (all - arm));
        if (!(to > arm)) continue;
        const double moved = t.mass[g] - first / to;
        t.mass[g] = first / to;
        t.com[g] = to * along;
        t.inertia[g] = about_joint - first * to * across;
        if (t.parent[g] < 0) continue; // mass on the ground
        const auto p = std::size_t(t.parent[g]);
        const Vec3 center = (t.mass[p] * t.com[p] + moved * t.joint_position[g]) / (t.mass[p] + moved);
        const auto about = [](const Vec3& d) { return Mat3(d.squaredNorm() * Mat3::Identity() - d * d.transpose()); };
        t.inertia[p] += t.mass[p] * about(t.com[p] - center) + moved * about(t.joint_position[g] - center);
        t.mass[p] += moved;
        t.com[p] = center;
    }
}

// How much a direction counts, by the cosine of its angle to the wind, to or fro.
double weight_of(double cosine) {
    return 0.02 + std::pow(cosine, 8);
}

// The sum of the bodies' forces, direction by direction, a group after another.
void fit_air(const Tree& whole, Reduced& r, const std::vector<std::uint8_t>& joined, double plate_kappa,
             const Vec3& toward) {
    Tree& t = r.tree;
    const std::array<Vec3, 64> directions = even_directions();
    std::vector<std::vector<std::int32_t>> members(joined.size());
    std::vector<double> reach(joined.size(), 0);
    each_joined(r, joined, [&](std::size_t i, std::size_t g) {
        members[g].push_back(std::int32_t(i));
        const bool own = whole.branch[i] == t.branch[g] && whole.kind[i] == t.kind[g];
        if (own) reach[g] = std::max(reach[g], (r.offset[i] + r.rotation[i] * Vec3(0, 0, whole.size[i][0])).norm());
    });
    const Mat3 one = Mat3::Identity();
    const DrawnPlaces drawn = toward.isZero() ? DrawnPlaces{} : drawn_places(t);
    for (std::size_t g = 0; g < joined.size(); ++g) {
        if (!joined[g]) continue;
        std::array<Vec3, 64> force;
        force.fill(Vec3::Zero());
        for (const std::int32_t member : members[g]) {
            const auto i = std::size_t(member);
            const double drag = drag_area(whole.kind[i], whole.size[i], 1, plate_kappa);
            const Mat3 R = r.rotation[i].toRotationMatrix();
            for (std::size_t k = 0; k < directions.size(); ++k)
                force[k] += drag * air_force(whole.kind[i], R, directions[k]).force;
        }
        Fits fits;
        for (std::size_t k = 0; k < directions.size(); ++k) {
            const double w = toward.isZero() ? 1 : weight_of((drawn.R[g] * directions[k]).dot(toward));
            const Vec3 cylinder = air_force(Kind::branch, one, directions[k]).force;
            fits.ff += w * force[k].squaredNorm();
            fits.fc += w * force[k].dot(cylinder);
            fits.cc += w * cylinder.squaredNorm();
            fits.fs += w * force[k].dot(directions[k]);
            fits.ss += w;
        }
        const Fit cylinder = fits.cylinder(), sphere = fits.sphere();
        const double length = std::max(reach[g], t.com[g].norm());
        if (t.kind[g] == Kind::branch && cylinder.left <= sphere.left) {
            const double radius = cylinder.drag / (cylinder_drag / 2) / (2 * length);
            t.size[g] = Vec3(length, radius, radius);
        } else {
            const double radius = std::sqrt(sphere.drag / (sphere_drag / 2) / std::numbers::pi);
            t.size[g] = Vec3(length, radius, radius);
            t.rigid.resize(joined.size(), 0);
            t.rigid[g] = round_to_air;
        }
    }
}

} // namespace

Reduced reduce(const Tree& whole, const std::vector<TreeRange>& ranges, double plate_kappa, const Vec3& toward) {
    Reduced r;
    r.whole = ranges;
    place_bodies(whole, r);
    place_ranges(r);
    copy_leaders(whole, r);
    const std::vector<std::uint8_t> joined = joined_groups(r);
    sum_masses(whole, r, joined);
    center_on_pressure(whole, r, joined, plate_kappa);
    fit_air(whole, r, joined, plate_kappa, toward);
    return r;
}

Reduced reduce(const Tree& whole, const std::vector<TreeRange>& ranges, const Scene& scene) {
    const bool one_way = scene.wind && !scene.wind->grid && !scene.wind->swirl && !scene.wind->velocity.isZero(0);
    return reduce(whole, ranges, plate_kappa(scene), one_way ? scene.wind->velocity.normalized() : Vec3(Vec3::Zero()));
}

std::optional<Selector> selector_on(const Reduced& r, const Selected& in_whole) {
    const std::int32_t g = r.body[in_whole.body];
    if (g < 0) return std::nullopt;
    std::size_t tree = 0;
    while (tree + 1 < r.whole.size() && in_whole.body >= r.whole[tree + 1].first_body) ++tree;
    Selector on;
    on.by = Selector::By::body;
    on.tree = std::int32_t(tree);
    on.body = std::int64_t(g) - std::int64_t(r.ranges[tree].first_body);
    on.point = Vec3(r.offset[in_whole.body] + r.rotation[in_whole.body] * in_whole.point_b);
    return on;
}

Scene scene_on(const Reduced& r, const Tree& whole, Scene scene) {
    std::vector<Pull> pulls;
    for (const Pull& pull : scene.pulls)
        for (const Selected& target : select(whole, r.whole, pull.on))
            if (const std::optional<Selector> on = selector_on(r, target))
                pulls.push_back({*on, pull.time, pull.force});
    scene.pulls = std::move(pulls);
    return scene;
}

} // namespace bough

#include "reduce.h"
#include "../laws/leaf_air.h"
#include "../laws/wind_field.h"
#include "../model/tree_arrays.h"
#include "reduce_air.h"
#include <algorithm>

namespace bough {
namespace {

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
    t = bodies_of(whole, r.leader);
    t.rigid.clear();
    std::fill(t.load.begin(), t.load.end(), 0);
    for (std::size_t g = 0; g < r.leader.size(); ++g) {
        const auto i = std::size_t(r.leader[g]);
        const std::int32_t p = whole.parent[i];
        t.parent[g] = p < 0 ? -1 : r.body[std::size_t(p)];
        if (p < 0 || whole.rigid.empty() || whole.rigid[std::size_t(p)] == 0) continue;
        const auto q = std::size_t(p);
        t.joint_position[g] = r.offset[q] + r.rotation[q] * whole.joint_position[i];
        t.joint_rotation[g] = (r.rotation[q] * whole.joint_rotation[i]).normalized();
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
    const bool toward_one = scene.wind && one_way(*scene.wind);
    return reduce(whole, ranges, plate_kappa(scene),
                  toward_one ? scene.wind->velocity.normalized() : Vec3(Vec3::Zero()));
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
            if (const std::optional<Selector> on = selector_on(r, target)) {
                pulls.push_back(pull);
                pulls.back().on = *on;
                if (!pull.in_body) continue;
                for (Vec3& f : pulls.back().force) f = r.rotation[target.body] * f;
            }
    scene.pulls = std::move(pulls);
    std::vector<Attachment> attachments;
    for (const Attachment& held : scene.attachments) {
        std::optional<Selector> with;
        if (held.with) with = selector_on(r, select(whole, r.whole, *held.with).front());
        for (const Selected& target : select(whole, r.whole, held.on)) {
            const std::optional<Selector> on = selector_on(r, target);
            if (held.with && (!on || !with || (on->tree == with->tree && on->body == with->body)))
                throw std::domain_error(
                    "/attachments/" + std::to_string(&held - scene.attachments.data()) +
                    (on && with ? ": holds two bodies that are one" : ": one of its two bodies stands still") +
                    " (/simulate, /rigid), expected both to move by themselves");
            if (!on) continue;
            attachments.push_back(held);
            attachments.back().on = *on;
            attachments.back().with = with;
        }
    }
    scene.attachments = std::move(attachments);
    return scene;
}

} // namespace bough

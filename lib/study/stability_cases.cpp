#include "stability_cases.h"
#include "../growth/segment.h"
#include "../model/append.h"
#include "../model/drawn_pose.h"
#include "../model/wood.h"
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace bough {
namespace {

std::string number(double x) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", x);
    return text;
}

void scale_stiffness(StabilitySetup& s, double x) {
    for (Vec3& K : s.tree.stiffness) K *= x;
}

void blow(StabilitySetup& s, double speed) {
    s.scene.wind = Wind();
    s.scene.wind->velocity = Vec3(speed, 0, 0);
}

// Mass and inertia of the bodies without children.
void scale_tips(StabilitySetup& s, double x) {
    std::vector<bool> inner(s.tree.size_bodies(), false);
    for (const std::int32_t p : s.tree.parent)
        if (p >= 0) inner[std::size_t(p)] = true;
    for (std::size_t i = 0; i < inner.size(); ++i) {
        if (inner[i]) continue;
        s.tree.mass[i] *= x;
        s.tree.inertia[i] *= x;
    }
}

// The scene stands, but for its trees, wind, pulls and motion of the ground, which belong to the user's tree.
void stand(StabilitySetup& s, const Splines& splines) {
    s.tree = segment(splines, wood_presets().front(), {});
    s.ranges = {{0, s.tree.size_bodies(), 0}};
}

Splines stem(const std::vector<Vec3>& points, const std::vector<double>& radii) {
    Splines s;
    s.parent = {-1};
    s.parent_at = {0};
    s.level = {0};
    s.first_point = {0, std::int32_t(points.size())};
    s.point = points;
    s.radius = radii;
    return s;
}

// A leaning pole cut evenly into n bodies.
void pole(StabilitySetup& s, int n, double length, double radius) {
    const Vec3 along = Vec3(0.3, 1, 0).normalized() * length;
    SegmentOptions options;
    options.segment_length = length / n * (1 + 1e-9);
    s.tree = segment(stem({Vec3::Zero(), along}, {radius, radius / 2}), wood_presets().front(), options);
    s.ranges = {{0, s.tree.size_bodies(), 0}};
}

// Bodies as no segmentation would make them: every third of a pole's shrunk to a point or thinned to a hair.
void degenerate(StabilitySetup& s, double length_factor, double radius_factor) {
    pole(s, 30, 3, 0.05);
    for (std::size_t i = 2; i < s.tree.size_bodies(); i += 3) {
        const double mass = length_factor * radius_factor * radius_factor;
        s.tree.mass[i] *= mass;
        s.tree.com[i] *= length_factor;
        Mat3& I = s.tree.inertia[i];
        const double across = std::max(length_factor * length_factor, radius_factor * radius_factor);
        I = Vec3(I(0, 0) * across, I(1, 1) * across, I(2, 2) * radius_factor * radius_factor).asDiagonal();
        I *= mass;
        s.tree.size[i][0] *= length_factor;
        s.tree.size[i].tail<2>() *= radius_factor;
        if (i + 1 < s.tree.size_bodies()) s.tree.joint_position[i + 1] *= length_factor;
    }
}

// The ground jumps by `distance` [m] within `span` [s].
void teleport(StabilitySetup& s, double distance, double span) {
    RootMotion motion;
    motion.time = {0.5, 0.5 + span};
    motion.position = {Vec3::Zero(), Vec3(distance, 0, 0)};
    s.scene.root_motion = {motion};
}

double mass_of(const Tree& tree) {
    double sum = 0;
    for (const double m : tree.mass) sum += m;
    return sum;
}

// To and fro, a full swing in 0.2 s, with the given greatest acceleration [m/s^2] of a sine that long.
void shake(StabilitySetup& s, double acceleration) {
    const double omega = 2 * std::numbers::pi / 0.2, most = acceleration / (omega * omega);
    RootMotion motion;
    for (int k = 0; k <= 20; ++k) {
        motion.time.push_back(0.5 + 0.05 * k);
        motion.position.push_back(Vec3(most * std::sin(omega * 0.05 * k), 0, 0));
    }
    s.scene.root_motion = {motion};
}

// The tree again and again, five metres apart, until there are so many.
void plant(StabilitySetup& s, int trees) {
    const Tree one = s.tree;
    for (int k = 1; k < trees; ++k) {
        const std::int32_t branches =
            s.ranges.back().first_branch + 1 + *std::max_element(one.branch.begin(), one.branch.end());
        const std::size_t first = append(s.tree, one, Vec3(5.0 * (k % 32), 0, 5.0 * (k / 32)), k);
        s.ranges.push_back({first, one.size_bodies(), branches});
    }
}

// From the foot of the tree to where its first branch ends, and a leap back.
void walk(StabilitySetup& s, double mass, double seconds) {
    Walker walker;
    walker.mass = mass;
    for (const auto& [at, time] : {std::pair{0.0, 0.2}, {1.0, 0.2 + seconds}, {0.0, 0.5 + 2 * seconds}}) {
        Walker::Stop stop;
        stop.on.by = Selector::By::branch;
        stop.on.at = at;
        stop.time = time;
        stop.leap = !walker.stops.empty() && at == 0;
        walker.stops.push_back(stop);
    }
    s.scene.walkers = {walker};
}

struct List {
    std::vector<StabilityCase> cases;
    void add(const char* group, const std::string& name, bool promised, std::function<void(StabilitySetup&)> apply) {
        cases.push_back({group, name, promised, std::move(apply)});
    }
};

void single_axes(List& list) {
    for (const double x : {0.0, 1e-12, 1e-6, 1e-4, 1e-3, 1e-2, 0.1, 1.0, 1e2, 1e4, 1e6, 1e9, 1e12, 1e15})
        list.add("stiffness", "K x " + number(x), x >= 1e-3 && x <= 1e6,
                 [x](StabilitySetup& s) { scale_stiffness(s, x); });
    for (const double x : {0.0, 1e-4, 1e-2, 0.1, 1.0, 10.0, 1e3, 1e6})
        list.add("damping", "beta " + number(x) + " s", x <= 1,
                 [x](StabilitySetup& s) { s.tree.damping.assign(s.tree.size_bodies(), x); });
    for (const double rate : {1000.0, 240.0, 120.0, 60.0, 30.0, 15.0, 10.0, 4.0, 1.0})
        list.add("step", rate > 1 ? "dt 1/" + number(rate) + " s" : "dt 1 s", rate <= 240 && rate >= 10,
                 [rate](StabilitySetup& s) { s.dt = 1 / rate; });
    for (const double speed : {0.0, 8.0, 20.0, 30.0, 50.0, 100.0})
        list.add("wind", speed > 0 ? number(speed) + " m/s" : "still air", speed <= 50,
                 [speed](StabilitySetup& s) { blow(s, speed); });
    for (const char* name : {"gusty", "storm"})
        list.add("wind", name, true, [name](StabilitySetup& s) { s.scene.wind = wind_preset(name); });
    for (const double x : {0.0, 10.0, 100.0, 1000.0})
        list.add("gravity", "g x " + number(x), x == 0, [x](StabilitySetup& s) { s.scene.gravity *= x; });
    list.add("gravity", "upside down", true, [](StabilitySetup& s) { s.scene.gravity *= -1; });
    for (const double x : {1e-6, 1e-9, 1e6})
        list.add("mass", "tips x " + number(x), x == 1e-6 || x == 1e6, [x](StabilitySetup& s) {
            scale_tips(s, x);
            if (x > 1) scale_stiffness(s, x);
        });
}

void combinations(List& list) {
    for (const double x : {1e-3, 1e6})
        for (const double speed : {30.0, 50.0})
            list.add("wind and stiffness", number(speed) + " m/s, K x " + number(x), true, [=](StabilitySetup& s) {
                blow(s, speed);
                scale_stiffness(s, x);
            });
    list.add("wind and stiffness", "30 m/s, K 0", false, [](StabilitySetup& s) {
        blow(s, 30);
        scale_stiffness(s, 0);
    });
    list.add("wind and step", "50 m/s, dt 1/10 s", true, [](StabilitySetup& s) {
        blow(s, 50);
        s.dt = 0.1;
    });
    list.add("wind and step", "50 m/s, dt 1/240 s", true, [](StabilitySetup& s) {
        blow(s, 50);
        s.dt = 1.0 / 240;
    });
    list.add("damping and stiffness", "beta 0, K x 1e-3", true, [](StabilitySetup& s) {
        s.tree.damping.assign(s.tree.size_bodies(), 0);
        scale_stiffness(s, 1e-3);
    });
    list.add("damping and stiffness", "beta 0, K x 1e+06, dt 1/10 s", true, [](StabilitySetup& s) {
        s.tree.damping.assign(s.tree.size_bodies(), 0);
        scale_stiffness(s, 1e6);
        s.dt = 0.1;
    });
    list.add("damping and stiffness", "beta 1, K x 1e+06", true, [](StabilitySetup& s) {
        s.tree.damping.assign(s.tree.size_bodies(), 1);
        scale_stiffness(s, 1e6);
    });
}

void own_trees(List& list) {
    list.add("depth", "1 body", true, [](StabilitySetup& s) { pole(s, 1, 3, 0.05); });
    list.add("depth", "chain of 400", true, [](StabilitySetup& s) { pole(s, 400, 10, 0.2); });
    list.add("depth", "chain of 1e5", true, [](StabilitySetup& s) { pole(s, 100000, 20, 0.5); });
    list.add("shape", "zero-length pieces", true, [](StabilitySetup& s) { degenerate(s, 1e-9, 1); });
    list.add("shape", "zero-radius pieces", true, [](StabilitySetup& s) { degenerate(s, 1, 1e-6); });
    list.add("shape", "pieces without extent", true, [](StabilitySetup& s) { degenerate(s, 1e-9, 1e-6); });
    list.add("shape", "coincident points", true, [](StabilitySetup& s) {
        const Vec3 a(0, 0, 0), b(0.1, 1, 0), c(0.2, 2, 0);
        stand(s, stem({a, a, b, b, b, c, c}, {0.05, 0.05, 0.04, 0.04, 0.03, 0.02, 0}));
    });
    list.add("shape", "equal K, round inertia", true, [](StabilitySetup& s) {
        for (Vec3& K : s.tree.stiffness) K.setConstant(K.mean());
        for (Mat3& I : s.tree.inertia) I = Mat3::Identity() * (I.trace() / 3);
    });
    for (const double distance : {1.0, 100.0})
        for (const double span : {1e-3, 0.1})
            list.add("ground", "jumps " + number(distance) + " m in " + number(span) + " s", false,
                     [=](StabilitySetup& s) { teleport(s, distance, span); });
    for (const double g : {1.0, 100.0})
        list.add("ground", "shakes at " + number(g) + " g", false, [g](StabilitySetup& s) { shake(s, 9.81 * g); });
    list.add("forest", "1 000 trees of 10 bodies", true, [](StabilitySetup& s) {
        pole(s, 10, 3, 0.05);
        plant(s, 1000);
    });
    list.add("forest", "one tree on 1 000 places, each ahead in the wind", true, [](StabilitySetup& s) {
        pole(s, 10, 3, 0.05);
        plant(s, 1000);
        blow(s, 20);
        s.scene.wind->gust_factor = 1.6;
        s.scene.trees.resize(1000);
        for (std::size_t k = 0; k < 1000; ++k) s.scene.trees[k].start = 0.1 * double(k);
    });
    list.add("walkers", "0.4 kg", true, [](StabilitySetup& s) { walk(s, 0.4, 0.5); });
    list.add("walkers", "10 kg, out to the tip", false, [](StabilitySetup& s) { walk(s, 10, 0.5); });
    list.add("walkers", "in a hundredth of a second", false, [](StabilitySetup& s) { walk(s, 0.4, 0.01); });
}

// Highest drawn joint, and how far from the trunk's foot any is.
std::pair<double, double> extent(const Tree& tree) {
    double top = 0, wide = 0;
    for (const Vec3& x : drawn_pose(tree).x_w) {
        top = std::max(top, x.y());
        wide = std::max(wide, std::hypot(x.x(), x.z()));
    }
    return {top, wide};
}

// Balls side by side over the crown, layer on layer.
void drop_balls(StabilitySetup& s, int count, double radius, double mass, double speed) {
    const auto [top, wide] = extent(s.tree);
    const int row = std::max(1, int(2 * wide / (3 * radius)));
    for (int k = 0; k < count; ++k) {
        const int i = k % row, j = k / row % row, layer = k / row / row;
        Ball ball;
        ball.radius = radius;
        ball.mass = mass;
        ball.position =
            Vec3((i - row / 2) * 3 * radius, top + radius + 3 * radius * (layer + 1), (j - row / 2) * 3 * radius);
        ball.velocity = Vec3(0, -speed, 0);
        s.scene.balls.push_back(ball);
    }
}

void break_at(StabilitySetup& s, double torque) {
    Fracture f;
    f.branch = f.leaf = f.petal = f.fruit = torque;
    s.scene.fracture = f;
}

void free_bodies(List& list) {
    list.add("free bodies", "thresholds 0: all breaks in one step", true, [](StabilitySetup& s) { break_at(s, 0); });
    list.add("free bodies", "thresholds infinite", true, [](StabilitySetup& s) { break_at(s, Fracture::never); });
    list.add("free bodies", "thresholds 0.1 N m", true, [](StabilitySetup& s) { break_at(s, 0.1); });
    list.add("free bodies", "10 000 balls", true, [](StabilitySetup& s) { drop_balls(s, 10000, 0.03, 0.05, 5); });
    list.add("free bodies", "a ball of 1e+06 times the tree's mass", true,
             [](StabilitySetup& s) { drop_balls(s, 1, 0.3, 1e6 * mass_of(s.tree), 5); });
    list.add("free bodies", "balls of 1e-06 times the tree's mass", true,
             [](StabilitySetup& s) { drop_balls(s, 100, 0.03, 1e-6 * mass_of(s.tree), 5); });
    list.add("free bodies", "balls at 100 m/s", true, [](StabilitySetup& s) { drop_balls(s, 100, 0.1, 1, 100); });
    list.add("free bodies", "balls at 100 m/s, thresholds 10 N m", true, [](StabilitySetup& s) {
        drop_balls(s, 100, 0.1, 1, 100);
        break_at(s, 10);
    });
    list.add("free bodies", "leaves only, thresholds 0", true, [](StabilitySetup& s) {
        Splines twig = stem({Vec3(0, 2, 0), Vec3(0.3, 2, 0)}, {1e-3, 1e-3});
        for (int k = 0; k < 20; ++k) {
            twig.leaf_branch.push_back(0);
            twig.leaf_at.push_back((k + 0.5) / 20);
            twig.leaf_position.push_back(Vec3(0.3 * (k + 0.5) / 20, 2, 0));
            twig.leaf_rotation.push_back(Quat(Eigen::AngleAxisd(k, Vec3(1, 2, 3).normalized())));
            twig.leaf_length.push_back(0.08);
            twig.leaf_width.push_back(0.05);
        }
        s.tree = segment(twig, wood_presets().front(), {});
        // Of it the leaves alone, each on the ground's own joint.
        std::vector<std::size_t> leaves;
        for (std::size_t i = 0; i < s.tree.size_bodies(); ++i)
            if (is_flat(s.tree.kind[i])) leaves.push_back(i);
        Tree only;
        only.resize(leaves.size());
        for (std::size_t k = 0; k < leaves.size(); ++k) {
            const std::size_t i = leaves[k];
            only.parent[k] = -1;
            only.kind[k] = s.tree.kind[i];
            only.mass[k] = s.tree.mass[i];
            only.com[k] = s.tree.com[i];
            only.inertia[k] = s.tree.inertia[i];
            only.joint_position[k] = Vec3(0.1 * double(k), 2, 0);
            only.joint_rotation[k] = s.tree.joint_rotation[i];
            only.stiffness[k] = s.tree.stiffness[i];
            only.damping[k] = s.tree.damping[i];
            only.size[k] = s.tree.size[i];
            only.branch[k] = std::int32_t(k);
            only.level[k] = 0;
            only.s[k] = 0;
        }
        s.tree = only;
        s.ranges = {{0, s.tree.size_bodies(), 0}};
        break_at(s, 0);
    });
}

// Of the cases of wind on the user's tree those whose motion one step a frame can be held to. A tree of a thousandth of its stiffness lies in
// the wind as a whip does, and a tenth of a second is too long for leaves: there bounded is what is promised.
bool a_frame_can_follow(const StabilityCase& c) {
    if (c.group.rfind("wind", 0) != 0 || c.name == "still air") return false;
    return c.name.find("K x 0.001") == std::string::npos && c.name.find("dt 1/10 s") == std::string::npos;
}

} // namespace

std::vector<StabilityCase> stability_cases() {
    List list;
    single_axes(list);
    combinations(list);
    own_trees(list);
    free_bodies(list);
    for (StabilityCase& c : list.cases) c.compared = c.promised && a_frame_can_follow(c);
    return list.cases;
}

} // namespace bough

#include "lib/growth/skin.h"
#include "tests/make_tree.h"
#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <numbers>
#include <tuple>

using namespace bough;
using make_tree::branched;
using make_tree::chain;
using make_tree::random_tree;

namespace {

using Key = std::tuple<double, double, double>;
Key key(const Vec3& p) {
    return {p.x(), p.y(), p.z()};
}

struct Pose {
    std::vector<Mat3> R_wb;
    std::vector<Vec3> x_w;
};

// Every joint turned by theta(i), by forward kinematics of our own.
template <class Theta> Pose posed(const Tree& tree, Theta theta) {
    Pose pose;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        const Mat3 R_pb = tree.joint_rotation[i].toRotationMatrix() * rotation_from_vector<double>(theta(i));
        const std::int32_t p = tree.parent[i];
        pose.R_wb.push_back(p < 0 ? R_pb : Mat3(pose.R_wb[std::size_t(p)] * R_pb));
        pose.x_w.push_back(p < 0 ? tree.joint_position[i]
                                 : Vec3(pose.x_w[std::size_t(p)] + pose.R_wb[std::size_t(p)] * tree.joint_position[i]));
    }
    return pose;
}

// A bend of up to `most` radians about a random axis across each joint.
Pose bent(const Tree& tree, double most, unsigned seed) {
    make_tree::Dice dice{std::mt19937(seed)};
    return posed(tree, [&](std::size_t) {
        const double angle = dice(0, most), around = dice(-std::numbers::pi, std::numbers::pi);
        return Vec3(angle * std::cos(around), angle * std::sin(around), 0);
    });
}

const SkinPart* part(const Skin& skin, const std::string& name) {
    for (const SkinPart& p : skin.part)
        if (p.name == name) return &p;
    return nullptr;
}

using Triangles = std::vector<std::array<std::int32_t, 3>>;

Triangles triangles(const Skin& skin, const std::string& name) {
    const SkinPart* p = part(skin, name);
    if (!p) return {};
    const auto first = skin.triangle.begin() + std::ptrdiff_t(p->first_index);
    return {first, first + std::ptrdiff_t(p->index_count)};
}

// Tubes of the bark. They are made one after another: a new one begins where no vertex was used before.
std::vector<Triangles> tubes(const Skin& skin) {
    std::vector<Triangles> result;
    std::int32_t last = -1;
    for (const auto& t : triangles(skin, "bark")) {
        if (std::min({t[0], t[1], t[2]}) > last) result.emplace_back();
        result.back().push_back(t);
        last = std::max({last, t[0], t[1], t[2]});
    }
    return result;
}

// Edges not run through exactly once in each direction, vertices in one place being one.
std::int64_t open_edges(const Triangles& mesh, const std::vector<Vec3>& position) {
    std::map<Key, int> id;
    std::map<std::pair<int, int>, int> runs;
    std::int64_t degenerate = 0;
    for (const auto& t : mesh) {
        int v[3];
        for (int k = 0; k < 3; ++k)
            v[k] = id.emplace(key(position[std::size_t(t[std::size_t(k)])]), int(id.size())).first->second;
        degenerate += v[0] == v[1] || v[1] == v[2] || v[2] == v[0];
        for (int k = 0; k < 3; ++k) ++runs[{v[k], v[(k + 1) % 3]}];
    }
    CHECK(degenerate == 0);
    std::int64_t open = 0;
    for (const auto& [edge, count] : runs) {
        const auto back = runs.find({edge.second, edge.first});
        open += count != 1 || back == runs.end() || back->second != 1;
    }
    return open;
}

double volume(const Triangles& mesh, const std::vector<Vec3>& p) {
    double v = 0;
    for (const auto& [a, b, c] : mesh) v += p[std::size_t(a)].dot(p[std::size_t(b)].cross(p[std::size_t(c)])) / 6;
    return v;
}

// How often a closed mesh winds about a point: sum of solid angles (van Oosterom and Strackee) over 4 pi; 1 inside.
double winding(const Triangles& mesh, const std::vector<Vec3>& p, const Vec3& q) {
    double sum = 0;
    for (const auto& t : mesh) {
        const Vec3 a = p[std::size_t(t[0])] - q, b = p[std::size_t(t[1])] - q, c = p[std::size_t(t[2])] - q;
        const double la = a.norm(), lb = b.norm(), lc = c.norm();
        sum += 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
    }
    return sum / (4 * std::numbers::pi);
}

double from_axis(const Tree& tree, const Pose& pose, std::size_t body, const Vec3& p) {
    const Vec3 d = pose.R_wb[body].transpose() * (p - pose.x_w[body]);
    const double z = std::clamp(d.z(), 0.0, tree.size[body].x());
    return (d - Vec3(0, 0, z)).norm();
}

double thickest_near(const Tree& tree, const std::array<std::int32_t, 4>& joint) {
    double r = 0;
    for (const std::int32_t j : joint) r = std::max({r, tree.size[std::size_t(j)].y(), tree.size[std::size_t(j)].z()});
    return r;
}

std::vector<std::int32_t> branch_starts(const Tree& tree) {
    std::vector<std::int32_t> starts;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i)
        if (tree.kind[i] == Kind::branch && !continues_parent(tree, i)) starts.push_back(std::int32_t(i));
    return starts;
}

// Tubes by branch. A tube's own branch is that of the last body it is bound to: its collar's parent comes before.
std::map<std::int32_t, Triangles> tubes_by_branch(const Tree& tree, const Skin& skin) {
    std::map<std::int32_t, Triangles> result;
    for (Triangles& tube : tubes(skin)) {
        std::int32_t last = 0;
        for (const auto& t : tube)
            for (const std::int32_t v : t) last = std::max(last, skin.joint[std::size_t(v)][0]);
        result[tree.branch[std::size_t(last)]] = std::move(tube);
    }
    return result;
}

} // namespace

TEST_CASE("drawn_pose agrees with the sweep written out") {
    const Tree tree = random_tree(400, 3);
    Pose got;
    drawn_pose(tree, got.R_wb, got.x_w);
    const Pose want = posed(tree, [](std::size_t) { return Vec3(Vec3::Zero()); });
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        CHECK((got.R_wb[i] - want.R_wb[i]).norm() < 1e-12);
        CHECK((got.x_w[i] - want.x_w[i]).norm() < 1e-12);
    }
}

TEST_CASE("each branch is one closed tube") {
    Tree beside = chain(3, 1, 0.05, 0.01);
    beside.joint_position[0] = {1, 0, 0};
    for (const Tree& tree : {branched(), random_tree(600, 1), random_tree(600, 2), chain(7, 2, 0.1, 0),
                             chain(1, 1, 0.1, 0), chain(1, 1, 0.1, 0.1), make_tree::forest({branched(), beside})}) {
        for (const int sides : {3, 8}) {
            const Skin skin = build_skin(tree, {sides});
            const std::vector<Triangles> all = tubes(skin);
            CHECK(all.size() == branch_starts(tree).size());
            for (const Triangles& tube : all) {
                CHECK(open_edges(tube, skin.position) == 0);
                CHECK(volume(tube, skin.position) > 0);
            }
        }
    }
}

TEST_CASE("fruit are closed and as large as spheres; leaves have both faces") {
    const Tree tree = branched();
    const Skin skin = build_skin(tree, {});
    CHECK(open_edges(triangles(skin, "fruit"), skin.position) == 0);
    const double sphere = 4 * std::numbers::pi / 3 * std::pow(0.03, 3);
    CHECK(volume(triangles(skin, "fruit"), skin.position) == Approx(sphere).epsilon(0.3));
    Vec3 sum = Vec3::Zero();
    double area = 0;
    for (const auto& [a, b, c] : triangles(skin, "leaf")) {
        const Vec3 &p = skin.position[std::size_t(a)], &q = skin.position[std::size_t(b)],
                   &r = skin.position[std::size_t(c)];
        const Vec3 facing = (q - p).cross(r - p) / 2;
        CHECK(facing.normalized().dot(skin.normal[std::size_t(a)]) == Approx(1));
        sum += facing;
        area += facing.norm();
    }
    CHECK(sum.norm() < 1e-12);
    CHECK(area == Approx(3 * 2 * 0.08 * 0.05 / 2));
    const Tree bare = chain(2, 1, 0.1, 0.05);
    CHECK(build_skin(bare, {}).part.size() == 1);
}

TEST_CASE("the skin's volume approaches the frustums' as sides grow, with the square of the side's angle") {
    const double r0 = 0.1, r1 = 0.03, length = 2;
    const double solid = std::numbers::pi * length * (r0 * r0 + r0 * r1 + r1 * r1) / 3;
    double before = 0;
    for (const int sides : {8, 16, 32, 64}) {
        const Skin skin = build_skin(chain(9, length, r0, r1), {sides});
        const double missing = 1 - volume(triangles(skin, "bark"), skin.position) / solid;
        CHECK(missing > 0);
        if (before > 0) CHECK(before / missing == Approx(4).epsilon(0.05));
        before = missing;
    }
    CHECK(before < 2e-3);
}

TEST_CASE("weights sum to 1 and joints are the piece, its parent or the next piece") {
    for (const Tree& tree : {branched(), random_tree(600, 4)}) {
        const Skin skin = build_skin(tree, {});
        for (std::size_t v = 0; v < skin.position.size(); ++v) {
            double sum = 0;
            for (std::size_t k = 0; k < 4; ++k) {
                sum += double(skin.weight[v][k]);
                CHECK(skin.weight[v][k] >= 0);
                const std::int32_t a = skin.joint[v][0], b = skin.joint[v][k];
                REQUIRE((b >= 0 && b < std::int32_t(tree.size_bodies())));
                if (skin.weight[v][k] > 0)
                    CHECK((a == b || tree.parent[std::size_t(a)] == b || tree.parent[std::size_t(b)] == a));
                else
                    CHECK(a == b);
            }
            CHECK(sum == Approx(1).epsilon(1e-6));
        }
        for (const auto& t : triangles(skin, "leaf"))
            for (const std::int32_t v : t) {
                CHECK(tree.kind[std::size_t(skin.joint[std::size_t(v)][0])] == Kind::leaf);
                CHECK(skin.weight[std::size_t(v)][0] == 1);
            }
    }
}

TEST_CASE("the drawn pose deforms to the drawn positions") {
    const Tree tree = random_tree(600, 5);
    const Skin skin = build_skin(tree, {});
    const Pose pose = posed(tree, [](std::size_t) { return Vec3(Vec3::Zero()); });
    std::vector<Vec3> position, normal;
    SkinDeformer(skin, tree).deform(pose.R_wb, pose.x_w, position, normal);
    double worst = 0, worst_normal = 0;
    for (std::size_t v = 0; v < position.size(); ++v) {
        worst = std::max(worst, (position[v] - skin.position[v]).norm());
        worst_normal = std::max(worst_normal, (normal[v] - skin.normal[v]).norm());
    }
    CHECK(worst < 1e-12);
    CHECK(worst_normal < 1e-12);
}

TEST_CASE("a rigid motion of the whole tree moves the skin rigidly") {
    const Tree tree = branched();
    const Skin skin = build_skin(tree, {});
    const Mat3 turn = make_tree::turn(1.1, {1, 2, 3}).toRotationMatrix();
    const Vec3 shift(4, -5, 6);
    Pose pose = posed(tree, [](std::size_t) { return Vec3(Vec3::Zero()); });
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        pose.R_wb[i] = turn * pose.R_wb[i];
        pose.x_w[i] = turn * pose.x_w[i] + shift;
    }
    std::vector<Vec3> position, normal;
    SkinDeformer(skin, tree).deform(pose.R_wb, pose.x_w, position, normal);
    for (std::size_t v = 0; v < position.size(); ++v) {
        CHECK((position[v] - turn * skin.position[v] - shift).norm() < 1e-12);
        CHECK((normal[v] - turn * skin.normal[v]).norm() < 1e-12);
    }
}

TEST_CASE("normals are unit and outward, drawn and bent") {
    for (const Tree& tree : {branched(), random_tree(600, 6)}) {
        const Skin skin = build_skin(tree, {});
        const Pose pose = bent(tree, 0.5, 7);
        std::vector<Vec3> position, normal;
        SkinDeformer(skin, tree).deform(pose.R_wb, pose.x_w, position, normal);
        using Vectors = const std::vector<Vec3>*;
        for (const auto& [p, n] : {std::pair<Vectors, Vectors>(&skin.position, &skin.normal), {&position, &normal}}) {
            for (const Vec3& v : *n) CHECK(v.norm() == Approx(1).epsilon(1e-9));
            std::int64_t inward = 0, all = 0;
            for (const auto& t : triangles(skin, "bark")) {
                const auto [a, b, c] = t;
                const Vec3 facing =
                    ((*p)[std::size_t(b)] - (*p)[std::size_t(a)]).cross((*p)[std::size_t(c)] - (*p)[std::size_t(a)]);
                Vec3 mean = Vec3::Zero();
                for (const std::int32_t v : t) mean += (*n)[std::size_t(v)];
                inward += facing.dot(mean) < 0;
                ++all;
            }
            // Only hidden triangles, between collar and root ring, may fold.
            CHECK(double(inward) <= 0.01 * double(all));
        }
        // Drawn, every ring corner's normal points away from its body's axis.
        const Pose drawn = posed(tree, [](std::size_t) { return Vec3(Vec3::Zero()); });
        for (const auto& t : triangles(skin, "bark"))
            for (const std::int32_t index : t) {
                const std::size_t v = std::size_t(index), b = std::size_t(skin.joint[v][0]);
                if (skin.weight[v][0] < 1) continue;
                const Vec3 d = drawn.R_wb[b].transpose() * (skin.position[v] - drawn.x_w[b]);
                const double mid = d.z() - tree.size[b].x() / 2;
                if (std::abs(mid) > 1e-9 || std::hypot(d.x(), d.y()) < 1e-9) continue; // mid rings only
                CHECK((drawn.R_wb[b].transpose() * skin.normal[v]).dot(Vec3(d.x(), d.y(), 0)) > 0);
            }
    }
}

TEST_CASE("v is arc length over the base's circumference, u goes once around with a doubled seam") {
    const double length = 3, r0 = 0.1;
    const Tree tree = chain(6, length, r0, 0.02, 0.2);
    const Skin skin = build_skin(tree, {8});
    const Pose drawn = posed(tree, [](std::size_t) { return Vec3(Vec3::Zero()); });
    std::map<float, std::vector<std::size_t>> rings; // by v
    for (std::size_t v = 0; v < skin.position.size(); ++v) rings[skin.texture[v][1]].push_back(v);
    double arc = 0;
    int full = 0;
    for (const auto& [v, corners] : rings) {
        if (corners.size() != 9) continue; // the closed ends have 8, one a triangle
        CHECK(double(v) == Approx(arc / (2 * std::numbers::pi * r0)).margin(1e-6));
        Vec3 center = Vec3::Zero();
        for (std::size_t k = 0; k < 8; ++k) center += skin.position[corners[k]] / 8;
        const std::size_t body = std::size_t(std::min(5.0, std::floor(arc / 0.5 + 1e-9)));
        CHECK((center - drawn.x_w[body] - drawn.R_wb[body].col(2) * (arc - 0.5 * double(body))).norm() < 1e-12);
        for (std::size_t k = 0; k < 9; ++k) CHECK(double(skin.texture[corners[k]][0]) == Approx(double(k) / 8));
        CHECK(skin.position[corners[0]] == skin.position[corners[8]]);
        arc += 0.25;
        ++full;
    }
    CHECK(full == 13);
}

TEST_CASE("texture coordinates are continuous: no triangle spans the seam, v rises from base to tip of every branch") {
    for (const Tree& tree : {branched(), random_tree(600, 8)}) {
        const Skin skin = build_skin(tree, {});
        for (const auto& t : triangles(skin, "bark")) {
            std::array<double, 3> u{}, v{};
            for (std::size_t k = 0; k < 3; ++k)
                u[k] = double(skin.texture[std::size_t(t[k])][0]), v[k] = double(skin.texture[std::size_t(t[k])][1]);
            const auto [low, high] = std::minmax_element(u.begin(), u.end());
            CHECK(*high - *low < 0.34);
            // u counterclockwise about the branch and v towards the tip: every triangle keeps its sense in the texture.
            CHECK((u[1] - u[0]) * (v[2] - v[0]) - (u[2] - u[0]) * (v[1] - v[0]) > 0);
        }
        // Vertices in one place of the bark, on the two sides of a seam or of a closed end, agree in v.
        std::map<Key, float> at;
        for (const auto& t : triangles(skin, "bark"))
            for (const std::int32_t i : t) {
                const float v = skin.texture[std::size_t(i)][1];
                CHECK(at.emplace(key(skin.position[std::size_t(i)]), v).first->second == v);
            }
    }
}

TEST_CASE("bent joints keep the tube whole: edges keep their length, vertices stay near their body") {
    for (const unsigned seed : {1u, 2u, 3u}) {
        const Tree tree = random_tree(600, seed);
        const Skin skin = build_skin(tree, {});
        const Pose pose = bent(tree, 0.5, seed + 10);
        std::vector<Vec3> position, normal;
        SkinDeformer(skin, tree).deform(pose.R_wb, pose.x_w, position, normal);
        double longest = 0, farthest = 0;
        for (const auto& t : triangles(skin, "bark")) {
            for (std::size_t k = 0; k < 3; ++k) {
                const std::size_t a = std::size_t(t[k]), b = std::size_t(t[(k + 1) % 3]);
                const double grown = (position[a] - position[b]).norm() - (skin.position[a] - skin.position[b]).norm();
                longest = std::max(longest, grown / thickest_near(tree, skin.joint[a]));
                farthest = std::max(farthest, from_axis(tree, pose, std::size_t(skin.joint[a][0]), position[a]) /
                                                  thickest_near(tree, skin.joint[a]));
            }
        }
        CHECK(longest < 1); // in radii of the piece
        CHECK(farthest < 1.2);
    }
}

TEST_CASE("a bend of 0.5 rad at every joint costs little volume") {
    const Tree tree = chain(12, 3, 0.05, 0.05);
    const Skin skin = build_skin(tree, {16});
    const double drawn = volume(triangles(skin, "bark"), skin.position);
    for (const double angle : {0.1, 0.5}) {
        const Pose pose = posed(tree, [&](std::size_t i) { return Vec3(i == 0 ? 0 : angle, 0, 0); });
        std::vector<Vec3> position, normal;
        SkinDeformer(skin, tree).deform(pose.R_wb, pose.x_w, position, normal);
        const double bent_volume = volume(triangles(skin, "bark"), position);
        // By hand: joint rings shrink by cos(angle / 2) in the plane of the bend and stand aslant by as much.
        const double c = std::cos(angle / 2);
        CHECK(bent_volume / drawn > (1 + c * c) / 2 - 0.01);
        CHECK(bent_volume / drawn < 1);
    }
}

TEST_CASE("a side branch starts inside its parent, drawn and bent either way") {
    for (const Tree& tree : {branched(), random_tree(300, 9), random_tree(300, 10)}) {
        const Skin skin = build_skin(tree, {});
        const std::map<std::int32_t, Triangles> all = tubes_by_branch(tree, skin);
        for (const unsigned seed : {0u, 1u, 2u}) {
            const Pose pose = bent(tree, seed == 0 ? 0 : 0.4, seed);
            std::vector<Vec3> position, normal;
            SkinDeformer(skin, tree).deform(pose.R_wb, pose.x_w, position, normal);
            for (const std::int32_t start : branch_starts(tree)) {
                const std::int32_t parent = tree.parent[std::size_t(start)];
                if (parent < 0) continue;
                const Triangles& own = all.at(tree.branch[std::size_t(start)]);
                const Triangles& around = all.at(tree.branch[std::size_t(parent)]);
                int inside = 0, outside = 0;
                for (const auto& t : own)
                    for (const std::int32_t v : t)
                        if (skin.joint[std::size_t(v)][0] == parent)
                            (winding(around, position, position[std::size_t(v)]) > 0.5 ? inside : outside) += 1;
                CHECK(inside > 0);
                CHECK(outside == 0);
            }
        }
    }
}

TEST_CASE("extremes: long chains, odd parents, thin tips") {
    SECTION("a branch of 1e5 pieces") {
        const Skin skin = build_skin(chain(100000, 1000, 0.1, 0), {3});
        CHECK(skin.position.size() > 100000u * 4);
        CHECK(open_edges(triangles(skin, "bark"), skin.position) == 0);
    }
    SECTION("a leaf and a fruit on the ground, a branch on a fruit, two pieces going on from one") {
        Tree tree;
        make_tree::add_leaf(tree, -1, {0, 0, 0}, make_tree::upright(), 0.1, 0.05, 3e-4, 0, 0, 0);
        make_tree::add_fruit(tree, -1, {1, 0, 0}, make_tree::upright(), 0, 0.05, 0, 0, 0);
        make_tree::add_piece(tree, 1, {0, 0, 0}, Quat::Identity(), 1, 0.1, 0.05, 1, 0, 0);
        make_tree::add_piece(tree, 2, {0, 0, 1}, make_tree::turn(0.4, Vec3::UnitX()), 1, 0.05, 0, 1, 0, 0.5);
        make_tree::add_piece(tree, 2, {0, 0, 1}, make_tree::turn(-0.4, Vec3::UnitX()), 1, 0.05, 0, 1, 0, 0.5);
        const Skin skin = build_skin(tree, {});
        CHECK(skin.part.size() == 3);
        CHECK(tubes(skin).size() == 2);
        for (const Triangles& tube : tubes(skin)) CHECK(open_edges(tube, skin.position) == 0);
        CHECK(open_edges(triangles(skin, "fruit"), skin.position) == 0);
        CHECK(std::all_of(skin.normal.begin(), skin.normal.end(), [](const Vec3& n) { return n.allFinite(); }));
    }
    SECTION("no bodies") {
        CHECK(build_skin(Tree(), {}).position.empty());
    }
    SECTION("a chain that folds back on itself") {
        const Skin skin = build_skin(chain(5, 2, 0.1, 0.1, std::numbers::pi), {});
        for (const Vec3& p : skin.position) CHECK(p.allFinite());
        for (const Vec3& n : skin.normal) CHECK(n.norm() == Approx(1));
    }
}

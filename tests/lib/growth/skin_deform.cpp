#include "lib/model/drawn_pose.h"
#include "tests/support/skin_checks.h"

using namespace bough;
using namespace skin_checks;
using make_tree::branched;
using make_tree::chain;
using make_tree::random_tree;

TEST_CASE("drawn_pose agrees with the sweep written out") {
    const Tree tree = random_tree(400, 3);
    const DrawnPose got = drawn_pose(tree);
    const SkinPose want = posed(tree, [](std::size_t) { return Vec3(Vec3::Zero()); });
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        CHECK((got.R_wb[i] - want.R_wb[i]).norm() < 1e-12);
        CHECK((got.x_w[i] - want.x_w[i]).norm() < 1e-12);
    }
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
    const SkinPose pose = posed(tree, [](std::size_t) { return Vec3(Vec3::Zero()); });
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
    SkinPose pose = posed(tree, [](std::size_t) { return Vec3(Vec3::Zero()); });
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
        const SkinPose pose = bent(tree, 0.5, 7);
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
        const SkinPose drawn = posed(tree, [](std::size_t) { return Vec3(Vec3::Zero()); });
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

TEST_CASE("bent joints keep the tube whole: edges keep their length, vertices stay near their body") {
    for (const unsigned seed : {1u, 2u, 3u}) {
        const Tree tree = random_tree(600, seed);
        const Skin skin = build_skin(tree, {});
        const SkinPose pose = bent(tree, 0.5, seed + 10);
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
        const SkinPose pose = posed(tree, [&](std::size_t i) { return Vec3(i == 0 ? 0 : angle, 0, 0); });
        std::vector<Vec3> position, normal;
        SkinDeformer(skin, tree).deform(pose.R_wb, pose.x_w, position, normal);
        const double bent_volume = volume(triangles(skin, "bark"), position);
        // By hand: joint rings shrink by cos(angle / 2) in the plane of the bend and stand aslant by as much.
        const double c = std::cos(angle / 2);
        CHECK(bent_volume / drawn > (1 + c * c) / 2 - 0.01);
        CHECK(bent_volume / drawn < 1);
    }
}

TEST_CASE("a bent joint's ring halves the angle, mid rings follow their piece alone") {
    const Tree tree = chain(2, 2, 0.05, 0.05);
    const Skin skin = build_skin(tree, {8});
    const SkinPose pose = posed(tree, [&](std::size_t i) { return Vec3(i == 0 ? 0 : 0.5, 0, 0); });
    std::vector<Vec3> position, normal;
    SkinDeformer(skin, tree).deform(pose.R_wb, pose.x_w, position, normal);
    const Vec3 along = pose.R_wb[0].col(2) + pose.R_wb[1].col(2);
    int joint = 0, mid = 0;
    for (std::size_t v = 0; v < position.size(); ++v) {
        const double drawn = skin.position[v].y(); // the chain stands upright, its pieces 1 m long
        if (std::abs(drawn - 1) < 1e-9) {
            CHECK(std::abs((position[v] - pose.x_w[1]).dot(along)) < 1e-9);
            ++joint;
        }
        for (const std::size_t body : {0u, 1u}) {
            if (std::abs(drawn - 0.5 - double(body)) > 1e-9) continue;
            CHECK((pose.R_wb[body].transpose() * (position[v] - pose.x_w[body])).z() == Approx(0.5));
            CHECK(from_axis(tree, pose, body, position[v]) == Approx(0.05));
            ++mid;
        }
    }
    CHECK(joint == 9);
    CHECK(mid == 18);
}

TEST_CASE("a side branch starts inside its parent, drawn and bent either way") {
    for (const Tree& tree : {branched(), random_tree(300, 9), random_tree(300, 10)}) {
        const Skin skin = build_skin(tree, {});
        const std::map<std::int32_t, Triangles> all = tubes_by_branch(tree, skin);
        for (const unsigned seed : {0u, 1u, 2u}) {
            const SkinPose pose = bent(tree, seed == 0 ? 0 : 0.4, seed);
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

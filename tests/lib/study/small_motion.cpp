// Where a tree stands that cannot stay as it is drawn (small_motion.h), by the balance of each joint, summed apart.
#include "lib/study/small_motion.h"
#include "lib/growth/segment.h"
#include <catch2/catch.hpp>

using namespace bough;

TEST_CASE("a thread of 0.6 mm goes over to where each joint's spring bears what hangs beyond it") {
    // 80 joints that all give way: a lift passed from one to the next makes Newton's step some 1e9 rad.
    Splines s;
    s.parent = {-1};
    s.parent_at = {0};
    s.level = {0};
    s.first_point = {0, 2};
    s.point = {Vec3(0, 0, 0), Vec3(0, 4, 0)};
    s.radius = {0.0003, 0.0003};
    SegmentOptions options;
    options.segment_length = 0.05;
    const Tree tree = segment(s, wood_presets().front(), options);
    const SmallMotion small(tree, Vec3(0, -9.81, 0), Pose::drawn);
    CHECK(small.joints().back().y() < 0);             // hangs
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero(); // of the weight beyond, about the origin
    double worst = 0;
    for (std::size_t i = tree.size_bodies(); i-- > 0;) {
        const Mat3& R = small.rotations()[i];
        const Vec3 weight(0, -9.81 * tree.mass[i], 0), x = small.joints()[i];
        force += weight;
        moment += Vec3(x + R * tree.com[i]).cross(weight);
        const Mat3 base =
            (i == 0 ? Mat3(Mat3::Identity()) : small.rotations()[i - 1]) * tree.joint_rotation[i].toRotationMatrix();
        const Eigen::AngleAxisd turn(Mat3(base.transpose() * R));
        const Vec3 spring = base * tree.stiffness[i].cwiseProduct(turn.angle() * turn.axis());
        worst = std::max(worst, (spring - (moment - x.cross(force))).norm());
    }
    CHECK(worst < 1e-6 * moment.norm()); // 2e-7 N m of 1 N m
}

// formats/exports/own_mesh.h: a placed twig is drawn as the beam that its joint stands for.
#include "formats/exports/own_mesh.h"
#include "formats/exports/own_mover.h"
#include "lib/model/drawn_pose.h"
#include "tests/support/make_tree.h"
#include <catch2/catch.hpp>

using namespace bough;

TEST_CASE("a twig's mesh takes the line of a beam under an even load, from its foot to where its body has its end") {
    const Tree tree = make_tree::chain(2, 1, 0.1, 0.1);
    const DrawnPose pose = drawn_pose(tree);
    constexpr int points = 11;
    constexpr float length = 0.8f, size = 2.5f; // of the twig in its own frame, and of that
    OwnMesh mesh;
    OwnSurface rod;
    for (int k = 0; k < points; ++k) rod.position.push_back({0, 0, length * float(k) / (points - 1)});
    rod.normal.assign(points, Eigen::Vector3f::UnitX());
    rod.triangle = {{0, 1, 2}};
    mesh.shape = {rod};
    OwnPlace place;
    place.body = 1, place.foot = 0, place.length = length;
    place.turn = size * Eigen::Matrix3f::Identity();
    place.place = pose.x_w[1].cast<float>();
    mesh.part.resize(1);
    mesh.part[0].placed = {place};
    const Skin skin = skin_of(mesh);
    OwnMover mover(mesh, tree);

    // The body turns a little about x, what bears it about y: against that it stays along z in the drawn axes.
    const double turn = 1e-3;
    const Mat3 borne = Eigen::AngleAxisd(0.7, Vec3::UnitY()).toRotationMatrix();
    MotionFrame frame;
    frame.position = {pose.x_w[0], pose.x_w[1]};
    frame.rotation = {Quat(borne * pose.R_wb[0]),
                      Quat(borne * Eigen::AngleAxisd(turn, Vec3::UnitX()).toRotationMatrix() * pose.R_wb[1])};
    frame.position[1] = frame.position[0] + borne * (pose.x_w[1] - pose.x_w[0]);
    mover.go_to(frame);
    std::vector<Vec3> moved(points);
    mover.positions(0, moved);
    for (int k = 0; k < points; ++k) {
        const double s = double(k) / (points - 1), whole = double(length * size);
        const Vec3 along = borne.transpose() * (moved[std::size_t(k)] - frame.position[1]);
        // q x^2 (6 L^2 - 4 L x + x^2) / 24 E I, over its value at L.
        const double line = s * s * (6 - 4 * s + s * s) / 3;
        CHECK(along.z() == Approx(whole * s).margin(1e-6));
        CHECK(along.y() == Approx(-turn * whole * line).margin(1e-7));
        CHECK(std::abs(along.x()) < 1e-6);
        const auto v = std::size_t(k);
        CHECK(skin.weight[v][0] + skin.weight[v][1] == Approx(1));
        CHECK(skin.joint[v][0] == 1);
    }
    CHECK(skin.weight[0][1] == 1); // at its foot it goes with what bears it
    CHECK(skin.weight[points - 1][0] == 1);
}

// A model's mesh as a rig: skinned here by the rig's joints, it is where DrivenMesh has it, however the file binds it.
#include "formats/models/driven_rig.h"
#include "tests/support/two_bones.h"

using namespace bough;
using namespace bough::test;
using namespace bough::test::two_bones;

namespace {

Eigen::Affine3d joint_at(const RigPose& pose, std::size_t j) {
    return Eigen::Translation3d(pose.place[j]) * pose.rotation[j];
}

// Linear blend skinning of the rig's mesh; how far it is from the driven one's vertices, and its normals from theirs.
struct RigOff {
    double place = 0, normal = 0;
};
RigOff rig_off(const Rig& rig, const RigPose& pose, const DrivenMesh& mesh) {
    const std::size_t n = mesh.vertices();
    std::vector<Vec3> place(n), normal(n);
    mesh.positions(0, place);
    mesh.normals(0, normal);
    REQUIRE(rig.mesh.skin.position.size() == n);
    RigOff off;
    for (std::size_t v = 0; v < n; ++v) {
        Eigen::Affine3d M;
        M.matrix().setZero();
        double sum = 0;
        for (std::size_t s = rig.mesh.first_share[v]; s < rig.mesh.first_share[v + 1]; ++s) {
            const RigMesh::Share& share = rig.mesh.share[s];
            const auto j = std::size_t(share.joint);
            M.matrix() += double(share.weight) * (joint_at(pose, j) * rig.joints.bind[j].inverse()).matrix();
            sum += double(share.weight);
        }
        CHECK(std::abs(sum - 1) < 1e-6);
        off.place = std::max(off.place, (M * rig.mesh.skin.position[v] - place[v]).norm());
        const Vec3 turned = M.linear().inverse().transpose() * rig.mesh.skin.normal[v];
        off.normal = std::max(off.normal, (turned.normalized() - normal[v]).norm());
    }
    return off;
}

// In the drawn pose, and bent; with the rig that was made.
Rig checked_rig(TwoBones& model, const Tree& alone) {
    Placed at(model, alone);
    DrivenMesh& mesh = *at.mesh;
    const Tree& tree = at.tree;
    const Mat3& placed = at.turned;
    const Vec3& foot = at.foot;
    DrivenRig bones(mesh);
    RigOff off = rig_off(bones.rig, bones.rig.joints.drawn, mesh);
    CHECK(off.place < 1e-5);
    CHECK(off.normal < 1e-5);
    const Mat3 Q = Eigen::AngleAxisd(-0.3, Vec3::UnitX()).toRotationMatrix();
    const MotionFrame frame = bent_frame(tree, around_z(0.7), Q, placed, foot);
    mesh.go_to(frame);
    off = rig_off(bones.rig, bones.pose_of(frame), mesh);
    CHECK(off.place < 1e-5);
    CHECK(off.normal < 1e-5);
    for (std::size_t j = 0; j < bones.rig.joints.size(); ++j) CHECK(bones.rig.joints.parent[j] < int(j));
    return std::move(bones.rig);
}

} // namespace

TEST_CASE(
    "a mesh that is drawn as it is bound has a joint a bone, bound where it is drawn, and one that stands still") {
    TwoBones model;
    const Rig rig = checked_rig(model, model.tree());
    CHECK(rig.joints.name == std::vector<std::string>{"trunk", "upper", "still"});
    CHECK(rig.joints.parent == std::vector<std::int32_t>{-1, 0, -1});
    CHECK(rig.joints.travels == std::vector<char>{true, true, false});
    for (std::size_t j = 0; j < 3; ++j) CHECK(rig.joints.bind[j].isApprox(joint_at(rig.joints.drawn, j), 1e-9));
}

TEST_CASE("a mesh that is drawn in another pose than it is bound in is bound where its skin says") {
    TwoBones model;
    const Tree tree = model.tree(); // of the straight one, whose bones are the same but for a bend
    model.file.json["nodes"][1]["rotation"] = {0, 0, std::sin(0.02), std::cos(0.02)};
    const Rig rig = checked_rig(model, tree);
    CHECK(rig.joints.size() == 3);
    CHECK_FALSE(std::all_of(rig.joints.bind.begin(), rig.joints.bind.end(), [&](const Eigen::Affine3d& bind) {
        return bind.isApprox(joint_at(rig.joints.drawn, std::size_t(&bind - rig.joints.bind.data())), 1e-6);
    }));
}

TEST_CASE("two skins that bind one bone differently get a joint each") {
    TwoBones model;
    GltfJson& json = model.file.json;
    const Tree tree = model.tree();
    json["skins"].push_back(json["skins"][0]);
    std::vector<float> bind;
    for (const double down : {1.0, 0.0}) {
        const Eigen::Affine3d B = Eigen::Translation3d(0.25, -down, 0) * Eigen::AngleAxisd(down, Vec3::UnitY()) *
                                  Eigen::Translation3d(mesh_offset) * Eigen::Scaling(1.5);
        for (int k = 0; k < 16; ++k) bind.push_back(float(B.matrix()(k % 4, k / 4)));
    }
    json["skins"][1]["inverseBindMatrices"] = model.file.add(bind, "MAT4", 5126);
    json["nodes"].push_back({{"name", "second"}, {"mesh", 0}, {"skin", 1}});
    json["scenes"][0]["nodes"].push_back(7);
    const Rig rig = checked_rig(model, tree);
    CHECK(rig.joints.size() == 4);
    CHECK(std::count(rig.joints.name.begin(), rig.joints.name.end(), "upper_bound") +
              std::count(rig.joints.name.begin(), rig.joints.name.end(), "trunk_bound") ==
          1);
}

TEST_CASE("a bone that flattens what it moves beside another is refused by its name") {
    TwoBones model;
    const Tree tree = model.tree();
    std::vector<float> bind;
    for (const double size : {0.0, 2.0}) {
        const Eigen::Affine3d B = Eigen::Translation3d(0, size / 2 - 1, 0) * Eigen::Scaling(size, size, 2.0);
        for (int k = 0; k < 16; ++k) bind.push_back(float(B.matrix()(k % 4, k / 4)));
    }
    model.file.json["skins"][0]["inverseBindMatrices"] = model.file.add(bind, "MAT4", 5126);
    ImportNotes notes;
    std::vector<std::string> lines;
    const DrivenMesh mesh(read_user_model(model.file.saved(), notes), tree, {}, lines);
    CHECK_THROWS_WITH(DrivenRig(mesh), Catch::Matchers::Contains("its bone") &&
                                           Catch::Matchers::Contains("which a skeleton of USD does not hold"));
}

// DART's step on one of our trees, to be held against treeprofile's figures: bodies on ball joints with the tree's masses, inertias,
// stiffness and damping (DART's springs are implicit), under gravity, started at rest, unloaded, as --set pose=rest does.
//   dart_step TREE [STEPS [FPS]]     prints ns a body and step
// Making the skeleton takes minutes from some thousand bodies on.
#include "formats/documents/tree.h"
#include <chrono>
#include <dart/dart.hpp>
#include <fstream>
#include <iostream>
#include <sstream>

namespace {

dart::dynamics::SkeletonPtr skeleton_of(const bough::Tree& tree) {
    using namespace dart::dynamics;
    const SkeletonPtr skeleton = Skeleton::create("tree");
    std::vector<BodyNode*> nodes;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        BallJoint::Properties joint;
        joint.mName = "joint " + std::to_string(i);
        joint.mT_ParentBodyToJoint.linear() = tree.joint_rotation[i].toRotationMatrix();
        joint.mT_ParentBodyToJoint.translation() = tree.joint_position[i];
        for (int k = 0; k < 3; ++k) {
            joint.mSpringStiffnesses[k] = tree.stiffness[i][k];
            joint.mDampingCoefficients[k] = tree.damping[i] * tree.stiffness[i][k];
        }
        BodyNode::Properties body;
        body.mName = "body " + std::to_string(i);
        body.mInertia = Inertia(tree.mass[i], tree.com[i], tree.inertia[i]);
        BodyNode* parent = tree.parent[i] < 0 ? nullptr : nodes[std::size_t(tree.parent[i])];
        nodes.push_back(skeleton->createJointAndBodyNodePair<BallJoint>(parent, joint, body).second);
    }
    return skeleton;
}

} // namespace

int main(int argc, char** argv) try {
    if (argc < 2 || argc > 4) {
        std::cerr << "usage: dart_step TREE [STEPS [FPS]]\n";
        return 1;
    }
    const int steps = argc > 2 ? std::stoi(argv[2]) : 30;
    const double fps = argc > 3 ? std::stod(argv[3]) : 30;
    std::ifstream file(argv[1], std::ios::binary);
    std::stringstream content;
    content << file.rdbuf();
    const bough::Tree tree = bough::read_tree(content.str(), argv[1]);

    const auto world = dart::simulation::World::create();
    world->setGravity(Eigen::Vector3d(0, -9.81, 0));
    world->setTimeStep(1 / fps);
    const auto skeleton = skeleton_of(tree);
    world->addSkeleton(skeleton);
    world->step(); // whatever it sets up once
    const auto start = std::chrono::steady_clock::now();
    for (int k = 0; k < steps; ++k) world->step();
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    std::cout << "DART " << DART_VERSION << ", " << tree.size_bodies() << " bodies, " << steps << " steps of 1/" << fps
              << " s: " << time.count() / steps / double(tree.size_bodies()) * 1e9
              << " ns a body and step; most turned " << skeleton->getPositions().cwiseAbs().maxCoeff() << " rad\n";
} catch (const std::exception& error) {
    std::cerr << "dart_step: " << error.what() << "\n";
    return 2;
}

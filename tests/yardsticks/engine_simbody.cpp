// Compiled without -DNDEBUG (CMakeLists.txt): Debian's library is, and its headers' classes differ.
#include "engine.h"
#include <Simbody.h>

namespace yardstick {
namespace {

SimTK::Vec3 to_simbody(const Vec3& v) {
    return {v.x(), v.y(), v.z()};
}
Vec3 from_simbody(const SimTK::Vec3& v) {
    return {v[0], v[1], v[2]};
}
SimTK::Rotation to_simbody(const Quat& q) {
    return SimTK::Rotation(SimTK::Quaternion(q.w(), q.x(), q.y(), q.z()));
}

SimTK::Body::Rigid rigid_body(const Tree& tree, std::size_t i) {
    const Mat3& I = tree.inertia[i];
    const SimTK::Vec3 com = to_simbody(tree.com[i]);
    const SimTK::Inertia about_com(SimTK::Vec3(I(0, 0), I(1, 1), I(2, 2)), SimTK::Vec3(I(0, 1), I(0, 2), I(1, 2)));
    return SimTK::Body::Rigid(
        SimTK::MassProperties(tree.mass[i], com, about_com.shiftFromMassCenter(-com, tree.mass[i])));
}

class SimbodyEngine : public Engine {
public:
    SimbodyEngine(const Tree& tree, const Vec3& gravity) : matter(system) {
        for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
            SimTK::MobilizedBody& parent = tree.parent[i] < 0 ? static_cast<SimTK::MobilizedBody&>(matter.updGround())
                                                              : ball[std::size_t(tree.parent[i])];
            ball.push_back(SimTK::MobilizedBody::Ball(
                parent, SimTK::Transform(to_simbody(tree.joint_rotation[i]), to_simbody(tree.joint_position[i])),
                rigid_body(tree, i), SimTK::Transform()));
            weight.push_back(tree.mass[i] * gravity);
            com.push_back(to_simbody(tree.com[i]));
        }
        state = system.realizeTopology();
        matter.setUseEulerAngles(state, false);
        system.realizeModel(state);
        mobility_forces.resize(state.getNU());
        body_forces.resize(matter.getNumBodies());
    }
    const char* name() const override { return "Simbody"; }

    void move(const Motion& motion, Bodies& bodies) override {
        for (std::size_t i = 0; i < ball.size(); ++i) {
            const Quat q = motion.turn[i].normalized();
            ball[i].setQFromVector(state, SimTK::Vector(SimTK::Vec4(q.w(), q.x(), q.y(), q.z())));
            ball[i].setUFromVector(state, SimTK::Vector(to_simbody(q * motion.rate[i])));
        }
        turn = motion.turn;
        system.realize(state, SimTK::Stage::Dynamics);
        for (std::size_t i = 0; i < ball.size(); ++i) {
            const SimTK::Rotation& R = ball[i].getBodyRotation(state);
            for (int row = 0; row < 3; ++row)
                for (int column = 0; column < 3; ++column) bodies.R_wb[i](row, column) = R[row][column];
            bodies.joint[i] = from_simbody(ball[i].getBodyOriginLocation(state));
            bodies.com[i] = from_simbody(ball[i].findStationLocationInGround(state, com[i]));
            bodies.com_velocity[i] = from_simbody(ball[i].findStationVelocityInGround(state, com[i]));
            bodies.omega[i] = from_simbody(ball[i].getBodyAngularVelocity(state));
        }
    }

    void accelerate(const Loads& loads, std::vector<Vec3>& acceleration) override {
        body_forces.setToZero();
        for (std::size_t i = 0; i < ball.size(); ++i) {
            const SimTK::Vec3 force = to_simbody(loads.force[i] + weight[i]);
            const SimTK::Vec3 arm = ball[i].expressVectorInGroundFrame(state, com[i]);
            body_forces[ball[i].getMobilizedBodyIndex()] =
                SimTK::SpatialVec(to_simbody(loads.moment[i]) + arm % force, force);
            const Vec3 torque = turn[i].normalized() * loads.torque[i];
            for (int k = 0; k < 3; ++k) mobility_forces[int(ball[i].getFirstUIndex(state)) + k] = torque[k];
        }
        matter.calcAccelerationIgnoringConstraints(state, mobility_forces, body_forces, u_dot, body_accelerations);
        for (std::size_t i = 0; i < ball.size(); ++i) {
            const int first = ball[i].getFirstUIndex(state);
            acceleration[i] = turn[i].normalized().conjugate() * Vec3(u_dot[first], u_dot[first + 1], u_dot[first + 2]);
        }
    }

private:
    SimTK::MultibodySystem system;
    SimTK::SimbodyMatterSubsystem matter;
    SimTK::State state;
    std::vector<SimTK::MobilizedBody::Ball> ball;
    std::vector<Vec3> weight; // [N]
    std::vector<SimTK::Vec3> com;
    std::vector<Quat> turn;
    SimTK::Vector mobility_forces, u_dot;
    SimTK::Vector_<SimTK::SpatialVec> body_forces, body_accelerations;
};

} // namespace

std::unique_ptr<Engine> make_simbody(const Tree& tree, const Vec3& gravity) {
    return std::make_unique<SimbodyEngine>(tree, gravity);
}

} // namespace yardstick

#include "engine.h"
#include <Eigen/Eigenvalues>
#include <cstring>
#include <mujoco/mujoco.h>
#include <sstream>
#include <stdexcept>

namespace yardstick {
namespace {

// MuJoCo refuses masses and pivots of the mass matrix below 1e-15. Motion does not change when all masses and forces are
// multiplied by one number; a power of two costs no digit.
constexpr double mass_scale = 0x1p60;

void attribute(std::ostream& out, const char* name, std::initializer_list<double> values) {
    out << ' ' << name << "=\"";
    for (const double v : values) out << v << ' ';
    out << '"';
}

void open_body(std::ostream& out, const Tree& tree, std::size_t i) {
    const Vec3 &at = tree.joint_position[i], &com = tree.com[i];
    const Quat& q = tree.joint_rotation[i];
    const Mat3 I = mass_scale * tree.inertia[i];
    out << "<body name=\"b" << i << '"';
    attribute(out, "pos", {at.x(), at.y(), at.z()});
    attribute(out, "quat", {q.w(), q.x(), q.y(), q.z()});
    out << "><joint type=\"ball\"/><inertial";
    attribute(out, "pos", {com.x(), com.y(), com.z()});
    attribute(out, "mass", {mass_scale * tree.mass[i]});
    if (I == Mat3(I.diagonal().asDiagonal())) {
        attribute(out, "diaginertia", {I(0, 0), I(1, 1), I(2, 2)});
    } else { // by principal axes; MuJoCo's own search for them ends at 1e-6
        const Eigen::SelfAdjointEigenSolver<Mat3> principal(I);
        Mat3 axes = principal.eigenvectors();
        if (axes.determinant() < 0) axes.col(0) = -axes.col(0);
        const Quat turn(axes);
        const Vec3& d = principal.eigenvalues();
        attribute(out, "quat", {turn.w(), turn.x(), turn.y(), turn.z()});
        attribute(out, "diaginertia", {d.x(), d.y(), d.z()});
    }
    out << "/>\n";
}

// The tree as MJCF, children inside their parents: depth first, with a stack.
std::string mjcf(const Tree& tree, const Vec3& gravity) {
    std::vector<std::vector<std::size_t>> children(tree.size_bodies());
    std::vector<std::size_t> roots;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i)
        (tree.parent[i] < 0 ? roots : children[std::size_t(tree.parent[i])]).push_back(i);
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out.precision(17);
    out << "<mujoco><option";
    attribute(out, "gravity", {gravity.x(), gravity.y(), gravity.z()});
    out << "/><worldbody>\n";
    struct Visit {
        std::size_t body;
        bool leaving;
    };
    std::vector<Visit> stack;
    for (auto root = roots.rbegin(); root != roots.rend(); ++root) stack.push_back({*root, false});
    while (!stack.empty()) {
        const Visit visit = stack.back();
        stack.pop_back();
        if (visit.leaving) {
            out << "</body>";
            continue;
        }
        open_body(out, tree, visit.body);
        stack.push_back({visit.body, true});
        for (const std::size_t child : children[visit.body]) stack.push_back({child, false});
    }
    out << "</worldbody></mujoco>\n";
    return out.str();
}

std::unique_ptr<mjModel, decltype(&mj_deleteModel)> load(const std::string& text) {
    const auto files = std::make_unique<mjVFS>(); // too large for a stack
    mj_defaultVFS(files.get());
    if (mj_makeEmptyFileVFS(files.get(), "tree.xml", int(text.size())) != 0)
        throw std::runtime_error("MuJoCo takes no file of this size");
    std::memcpy(files->filedata[mj_findFileVFS(files.get(), "tree.xml")], text.data(), text.size());
    char error[1000] = "";
    std::unique_ptr<mjModel, decltype(&mj_deleteModel)> model(mj_loadXML("tree.xml", files.get(), error, sizeof error),
                                                              mj_deleteModel);
    mj_deleteVFS(files.get());
    if (!model) throw std::runtime_error(std::string("MuJoCo: ") + error);
    return model;
}

class MujocoEngine : public Engine {
public:
    MujocoEngine(const Tree& tree, const Vec3& gravity)
        : model(load(mjcf(tree, gravity))), data(mj_makeData(model.get()), mj_deleteData) {
        for (std::size_t i = 0; i < tree.size_bodies(); ++i)
            id.push_back(mj_name2id(model.get(), mjOBJ_BODY, ("b" + std::to_string(i)).c_str()));
    }
    const char* name() const override { return "MuJoCo"; }

    void move(const Motion& motion, Bodies& bodies) override {
        for (std::size_t i = 0; i < id.size(); ++i) {
            const Quat q = motion.turn[i].normalized();
            const int joint = model->body_jntadr[id[i]];
            mjtNum* const qpos = data->qpos + model->jnt_qposadr[joint];
            qpos[0] = q.w(), qpos[1] = q.x(), qpos[2] = q.y(), qpos[3] = q.z();
            Eigen::Map<Vec3>(data->qvel + model->jnt_dofadr[joint]) = motion.rate[i];
        }
        mj_fwdPosition(model.get(), data.get());
        mj_fwdVelocity(model.get(), data.get());
        for (std::size_t i = 0; i < id.size(); ++i) {
            bodies.R_wb[i] = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(data->xmat + 9 * id[i]);
            bodies.joint[i] = Eigen::Map<const Vec3>(data->xpos + 3 * id[i]);
            bodies.com[i] = Eigen::Map<const Vec3>(data->xipos + 3 * id[i]);
            Eigen::Matrix<double, 6, 1> velocity;
            mj_objectVelocity(model.get(), data.get(), mjOBJ_BODY, id[i], velocity.data(), 0);
            bodies.com_velocity[i] = velocity.tail<3>();
            bodies.omega[i] = velocity.head<3>();
        }
    }

    void accelerate(const Loads& loads, std::vector<Vec3>& acceleration) override {
        for (std::size_t i = 0; i < id.size(); ++i) {
            Eigen::Map<Vec3>(data->qfrc_applied + dof(i)) = mass_scale * loads.torque[i];
            Eigen::Map<Vec3>(data->xfrc_applied + 6 * id[i]) = mass_scale * loads.force[i];
            Eigen::Map<Vec3>(data->xfrc_applied + 6 * id[i] + 3) = mass_scale * loads.moment[i];
        }
        mj_fwdActuation(model.get(), data.get());
        mj_fwdAcceleration(model.get(), data.get());
        for (int w = 0; w < mjNWARNING; ++w)
            if (data->warning[w].number > 0) throw std::runtime_error(mju_warningText(w, data->warning[w].lastinfo));
        for (std::size_t i = 0; i < id.size(); ++i)
            acceleration[i] = Eigen::Map<const Vec3>(data->qacc_smooth + dof(i));
    }

private:
    int dof(std::size_t i) const { return model->body_dofadr[id[i]]; }
    std::unique_ptr<mjModel, decltype(&mj_deleteModel)> model;
    std::unique_ptr<mjData, decltype(&mj_deleteData)> data;
    std::vector<int> id; // MuJoCo numbers bodies depth first
};

} // namespace

std::unique_ptr<Engine> make_mujoco(const Tree& tree, const Vec3& gravity) {
    return std::make_unique<MujocoEngine>(tree, gravity);
}

} // namespace yardstick

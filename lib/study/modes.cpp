#include "modes.h"
#include "../laws/air_load.h"
#include "../laws/wind.h"
#include "../plan/body_air.h"
#include "lanczos.h"
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <numbers>
#include <numeric>
#include <stdexcept>

namespace bough {
namespace {

using Eigen::Index, Eigen::MatrixXd, Eigen::VectorXd;

constexpr Index sway_steps = 24;
// Of vectors; of values its square. The looser one finds whether there is anything to look for.
constexpr double precise = 1e-9, rough = 1e-4;
constexpr int restarts = 2000;

// The lowest modes, frequencies rising: 1 / omega^2 and y (small_motion.h) of the k-th.
class LowestModes {
public:
    LowestModes(const SmallMotion&, Index count, const std::function<void(std::int64_t)>& progress);
    Index count() const { return Index(order_.size()); }
    double value(Index k) const { return value_[order_[std::size_t(k)]]; }
    const double* y(Index k) const { return iteration_.numbers(order_[std::size_t(k)]); }

private:
    VectorXd largest(Index count, double tolerance);
    std::vector<SmallMotion::Moving> work_;
    std::int64_t operations_ = 0;
    Lanczos iteration_;
    std::vector<double> value_; // of the vectors kept
    std::vector<Index> order_;
};

VectorXd LowestModes::largest(Index count, double tolerance) {
    VectorXd values = iteration_.largest(count, std::max<Index>(2 * count + 10, 20), tolerance, restarts);
    if (values.size() == 0)
        throw std::domain_error(
            "the lowest modes do not converge: there are too many of nearly the same frequency; ask "
            "for fewer, or without leaves");
    return values;
}

// A Krylov space has one direction of each eigenspace: of modes of the same frequency, as a round trunk has them, others turn up once those are taken
// out. So what is left is looked at until nothing above the last of the `count` is in it: roughly, as mostly there is not.
LowestModes::LowestModes(const SmallMotion& motion, Index count, const std::function<void(std::int64_t)>& progress)
    : iteration_(motion.rows(), [this, &motion, progress](const double* y, double* out) {
          if (progress) progress(++operations_);
          motion.operate(y, out, work_);
      }) {
    double last = 0; // of the `count` largest values found
    for (Index more = count; iteration_.kept() < motion.rows(); more = std::min<Index>(4, count)) {
        if (last > 0 && largest(1, rough)[0] * (1 + rough) < last) break;
        const VectorXd next = largest(std::min(more, motion.rows() - iteration_.kept()), precise);
        Index fresh = 0;
        while (fresh < next.size() && next[fresh] > last * (1 + 1e-12)) ++fresh;
        if (fresh == 0) break;
        iteration_.keep(fresh);
        value_.insert(value_.end(), next.begin(), next.begin() + fresh);
        order_.resize(value_.size());
        std::iota(order_.begin(), order_.end(), Index(0));
        std::stable_sort(order_.begin(), order_.end(),
                         [&](Index a, Index b) { return value_[std::size_t(a)] > value_[std::size_t(b)]; });
        if (order_.size() > std::size_t(count)) order_.resize(std::size_t(count));
        if (Index(order_.size()) == count) last = value(count - 1);
        if (fresh < next.size()) break;
    }
}

// D of the air on body i, of its centre of mass's velocity and its turning. Single leaves and petals turn with the wind, as those of clumps do.
struct AirDamping {
    Mat3 drag = Mat3::Zero(), spin = Mat3::Zero();
};

std::vector<AirDamping> air_on(const Tree& tree, const Scene& scene, const SmallMotion& motion) {
    std::vector<AirDamping> damping(tree.size_bodies());
    const LeafTerms<double> terms = leaf_terms<double>(scene);
    for (std::size_t i = 0; i < damping.size(); ++i) {
        const Mat3& R = motion.rotations()[i];
        const Mat3 I = R * tree.inertia[i] * R.transpose();
        Vec3 u = Vec3::Zero();
        if (scene.wind) u = mean_wind(*scene.wind, motion.joints()[i] + R * tree.com[i]);
        const AirBody<double> body = air_body(tree, i, scene);
        const AirBody<double> mean = streaming(body, leaf_proportion(tree, i), R);
        damping[i].drag = mean.drag_area * air_damping(mean.kind, R, u, mean.facing, mean.normal);
        if (has_leaf_air(terms, body.kind)) damping[i].drag += leaf_damping(terms, body, R, u);
        damping[i].spin = air_load(body, terms, R, u).spin * I;
    }
    return damping;
}

Vec3 far_end(const Tree& tree, std::size_t i, const Mat3& R) {
    return R.col(2) * tree.size[i][0];
}

// Twice the kinetic energy of body i.
double energy_of(const Tree& tree, const SmallMotion::Motion& m, const Mat3& R, std::size_t i) {
    const Vec3 turn_b = R.transpose() * m.turn;
    return tree.mass[i] * m.com.squaredNorm() + turn_b.dot(tree.inertia[i] * turn_b);
}

NaturalMode mode_of(const Tree& tree, const SmallMotion& small, const std::vector<AirDamping>& air, double value,
                    std::vector<Vec3> a) {
    const double omega = 1 / std::sqrt(value);
    const std::vector<SmallMotion::Motion> moved = small.motion(a);
    const auto levels = std::size_t(*std::max_element(tree.level.begin(), tree.level.end())) + 1;
    NaturalMode mode;
    mode.share.assign(levels + 1, 0);
    double kinetic = 0, wood = 0, drag = 0, largest = 0;
    Vec3 momentum = Vec3::Zero();
    for (std::size_t i = 0; i < a.size(); ++i) {
        const Mat3& R = small.rotations()[i];
        const SmallMotion::Motion& m = moved[i];
        const double energy = energy_of(tree, m, R, i);
        kinetic += energy;
        mode.share[tree.kind[i] == Kind::branch ? std::size_t(tree.level[i]) : levels] += energy;
        momentum += tree.mass[i] * m.com;
        const Vec3 angle = small.spring_rates()[i] * a[i];
        wood += tree.damping[i] * angle.dot(tree.stiffness[i].cwiseProduct(angle));
        if (!air.empty()) drag += m.com.dot(air[i].drag * m.com) + m.turn.dot(air[i].spin * m.turn);
        const double way = (m.joint + m.turn.cross(far_end(tree, i, R))).norm();
        if (way > largest) largest = way, mode.farthest = i;
    }
    mode.frequency = omega / (2 * std::numbers::pi);
    mode.wood = wood / (2 * omega * kinetic);
    mode.damping = mode.wood + drag / (2 * omega * kinetic);
    mode.effective_mass = momentum.cwiseAbs2() / kinetic;
    for (double& share : mode.share) share /= kinetic;
    for (Vec3& turn : a) turn /= largest;
    mode.turn = std::move(a);
    return mode;
}

} // namespace

std::vector<NaturalMode> natural_modes(const SmallMotion& small, const Tree& tree, const Scene& scene,
                                       const ModeOptions& options, const std::function<void(std::int64_t)>& progress) {
    const LowestModes lowest(small, std::min<Index>(options.count, small.rows()), progress);
    const std::vector<AirDamping> air = options.air ? air_on(tree, scene, small) : std::vector<AirDamping>();
    std::vector<NaturalMode> modes;
    for (Index k = 0; k < lowest.count(); ++k)
        modes.push_back(mode_of(tree, small, air, lowest.value(k), small.turns(lowest.y(k))));
    return modes;
}

std::vector<BranchMotion> moving_branches(const SmallMotion& small, const Tree& tree, const NaturalMode& mode,
                                          std::size_t most) {
    const std::vector<SmallMotion::Motion> moved = small.motion(mode.turn);
    std::vector<BranchMotion> all(std::size_t(*std::max_element(tree.branch.begin(), tree.branch.end())) + 1);
    double kinetic = 0;
    for (std::size_t i = 0; i < moved.size(); ++i) {
        const Mat3& R = small.rotations()[i];
        BranchMotion& b = all[std::size_t(tree.branch[i])];
        b.branch = tree.branch[i];
        if (tree.kind[i] == Kind::branch) b.level = tree.level[i];
        const double energy = energy_of(tree, moved[i], R, i);
        b.share += energy;
        kinetic += energy;
        const Vec3 way = moved[i].joint + moved[i].turn.cross(far_end(tree, i, R));
        if (way.norm() > b.way.norm()) b.way = way;
    }
    for (BranchMotion& b : all) b.share /= kinetic;
    std::erase_if(all, [](const BranchMotion& b) { return b.branch < 0; }); // of which no body is left
    const auto listed = all.begin() + std::ptrdiff_t(std::min(most, all.size()));
    std::partial_sort(all.begin(), listed, all.end(), [](const BranchMotion& a, const BranchMotion& b) {
        return a.share != b.share ? a.share > b.share : a.branch < b.branch;
    });
    all.erase(listed, all.end());
    return all;
}

ShapePose swung(const SmallMotion& small, const Tree& tree, const NaturalMode& mode, double amplitude) {
    const std::size_t n = tree.size_bodies();
    ShapePose pose;
    pose.position.resize(n);
    pose.rotation.resize(n);
    std::vector<Quat> turn(n); // of the body from where it stands, world
    for (std::size_t i = 0; i < n; ++i) {
        turn[i] = quaternion_from_vector<double>(amplitude * mode.turn[i]);
        pose.position[i] = small.joints()[i];
        if (tree.parent[i] >= 0) {
            const auto p = std::size_t(tree.parent[i]);
            turn[i] = turn[p] * turn[i];
            pose.position[i] = pose.position[p] + turn[p] * (small.joints()[i] - small.joints()[p]);
        }
        pose.rotation[i] = (turn[i] * Quat(small.rotations()[i])).normalized();
    }
    return pose;
}

Sway sway_along(const SmallMotion& small, const Vec3& direction) {
    const VectorXd start = small.excited(direction);
    const Index steps = std::min<Index>(sway_steps, small.rows());
    MatrixXd basis(small.rows(), steps);
    VectorXd diagonal(steps), beside(steps), next(small.rows());
    basis.col(0) = start.normalized();
    std::vector<SmallMotion::Moving> work;
    Index made = 0;
    while (made < steps) {
        small.operate(basis.col(made).data(), next.data(), work);
        diagonal[made] = next.dot(basis.col(made));
        for (int twice = 0; twice < 2; ++twice) // orthogonal to rounding
            next -= basis.leftCols(made + 1) * (basis.leftCols(made + 1).transpose() * next).eval();
        beside[made] = next.norm();
        if (++made == steps || !(beside[made - 1] > 1e-12 * diagonal[0])) break;
        basis.col(made) = next / beside[made - 1];
    }
    Eigen::SelfAdjointEigenSolver<MatrixXd> ritz;
    ritz.computeFromTridiagonal(diagonal.head(made), beside.head(made - 1));
    const auto hertz = [](double value) { return 1 / std::sqrt(value) / (2 * std::numbers::pi); };
    Sway sway;
    sway.lowest = hertz(ritz.eigenvalues()[made - 1]);
    for (Index k = 0; k < made; ++k) {
        const double first = ritz.eigenvectors()(0, k), share = first * first;
        if (share > sway.share) sway.frequency = hertz(ritz.eigenvalues()[k]), sway.share = share;
    }
    return sway;
}

} // namespace bough

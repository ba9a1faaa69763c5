#include "flexibility.h"
#include <Eigen/Cholesky>
#include <algorithm>

namespace bough {

Mat3 stiffness_w(const Tree& tree, std::size_t i, const Mat3& R_wb) {
    constexpr double least = 1e-12; // [N m/rad] of a joint without stiffness
    return R_wb * tree.stiffness[i].cwiseMax(least).asDiagonal() * R_wb.transpose();
}

Yielding yielding(const Mat3& K, const Vec3& H, const Borne& on) {
    const Vec3 g(0, -9.81, 0);
    const Mat3 gH = g * H.transpose(), level = g.dot(H) * Mat3::Identity();
    const Mat3 T = cross_matrix(H) + on.b;
    Yielding y;
    Mat3 C = level - gH + on.A;
    Eigen::LLT<Mat3> W(Mat3(K + level - 0.5 * (gH + gH.transpose()) + on.A));
    y.stands = W.info() == Eigen::Success;
    if (!y.stands) {
        W.compute(K);
        C.setZero();
    }
    y.turn = W.solve(T);
    y.give = T.cwiseProduct(y.turn).sum();
    y.passed.A = on.A - C.transpose() * W.solve(C);
    y.passed.b = on.b - C.transpose() * y.turn;
    return y;
}

Flexibility flexibility(const Tree& tree) {
    const std::size_t n = tree.size_bodies();
    Flexibility f{drawn_pose(tree),       tree.mass, std::vector<Vec3>(n), std::vector<double>(n),
                  std::vector<double>(n), {}};
    for (std::size_t i = 0; i < n; ++i) f.first[i] = f.pose.R_wb[i] * (tree.mass[i] * tree.com[i]);
    std::vector<Borne> on(n);
    for (std::size_t i = n; i-- > 0;) {
        const Mat3 K = stiffness_w(tree, i, f.pose.R_wb[i]);
        const Yielding y = yielding(K, f.first[i], on[i]);
        f.give[i] = y.give;
        f.loss[i] = tree.damping[i] * y.turn.cwiseProduct(K * y.turn).sum();
        if (tree.parent[i] < 0) continue;
        const auto p = std::size_t(tree.parent[i]);
        f.mass[p] += f.mass[i];
        f.first[p] += f.first[i] + f.mass[i] * (f.pose.x_w[i] - f.pose.x_w[p]);
        on[p] += y.passed;
    }
    f.whole = f.give;
    for (std::size_t i = n; i-- > 0;)
        if (tree.parent[i] >= 0) f.whole[std::size_t(tree.parent[i])] += f.whole[i];
    return f;
}

} // namespace bough

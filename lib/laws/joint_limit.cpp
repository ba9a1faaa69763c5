#include "joint_limit.h"
#include "../base/cholesky.h"

namespace bough {

template <class T>
bool stop_at_limit(const Vector3<T>& limit, const Matrix3<T>& L, Vector3<T>& theta, Vector3<T>& scaled_rate) {
    if (!theta.allFinite()) return false; // to be found, not hidden
    Vector3<T> side = Vector3<T>::Zero();
    for (int k = 0; k < 3; ++k) {
        if (!(std::abs(theta[k]) > limit[k])) continue;
        side[k] = theta[k] > 0 ? T(1) : T(-1);
        theta[k] = side[k] * limit[k];
    }
    if (side.isZero(0)) return false;
    Matrix3<T> c = body_rate_jacobian_inverse(theta).transpose();
    solve_lower(L, c);
    for (int held = 0; held < 3; ++held) {
        int k = 0;
        if (!((c.transpose() * scaled_rate).cwiseProduct(side).maxCoeff(&k) > 0)) break;
        // The other columns lose their part along this one, so that their projections keep it at rest.
        const Vector3<T> n = c.col(k).normalized();
        scaled_rate -= n * n.dot(scaled_rate);
        c -= (n * (n.transpose() * c)).eval();
        side[k] = 0;
    }
    return true;
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template bool stop_at_limit(const Vector3<T>&, const Matrix3<T>&, Vector3<T>&, Vector3<T>&);
#include "../base/instantiate.inc"

} // namespace bough

// symmetric_eigen.h: the eigenproblem of symmetric 3x3 matrices.
#pragma once
#include "math.h"
#include <cmath>
#include <limits>

namespace bough {

// Finds eigenvectors (columns) and values by cyclic Jacobi rotations. Small eigenvalues keep their relative accuracy, and equal ones need no case.
template <class T> void symmetric_eigen(Matrix3<T> A, Matrix3<T>& V, Vector3<T>& values) {
    V.setIdentity();
    constexpr int pairs[3][2] = {{0, 1}, {0, 2}, {1, 2}};
    // Quadratic convergence: from the fourth sweep on nothing is left to turn in either precision.
    for (int sweep = 0; sweep < 6; ++sweep) {
        bool turned = false;
        for (const auto& [p, q] : pairs) {
            const T off = A(p, q);
            const T limit = std::numeric_limits<T>::epsilon() * std::sqrt(std::abs(A(p, p)) * std::abs(A(q, q))) / 8;
            if (!(std::abs(off) > limit)) continue;
            turned = true;
            const T tau = (A(q, q) - A(p, p)) / (2 * off);
            const T t = (tau >= 0 ? T(1) : T(-1)) / (std::abs(tau) + std::sqrt(1 + tau * tau));
            const T c = 1 / std::sqrt(1 + t * t), s = t * c;
            const int r = 3 - p - q;
            A(p, p) -= t * off;
            A(q, q) += t * off;
            A(p, q) = A(q, p) = 0;
            const T arp = A(r, p), arq = A(r, q);
            A(r, p) = A(p, r) = c * arp - s * arq;
            A(r, q) = A(q, r) = s * arp + c * arq;
            const Vector3<T> vp = V.col(p), vq = V.col(q);
            V.col(p) = c * vp - s * vq;
            V.col(q) = s * vp + c * vq;
        }
        if (!turned) break;
    }
    values = A.diagonal();
}

} // namespace bough

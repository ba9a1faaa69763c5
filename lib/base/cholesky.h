// cholesky.h: Cholesky's factor of a symmetric 3 x 3 matrix, A = L L^T, and solving with L. Eigen's own reaches for its products of large matrices,
// which take the compiler seconds in each source. Cost: 30 operations for the factor, 12 a column solved.
#pragma once
#include "math.h"

namespace bough {

// Reads the lower half of A.
template <class T> struct Cholesky {
    Matrix3<T> L;          // complete up to the first pivot that is not above 0; from there on A's own lower half
    bool positive = false; // true if A is positive definite; NaN passes as positive, and shows in L

    explicit Cholesky(const Matrix3<T>& A) {
        L << A(0, 0), T(0), T(0), A(1, 0), A(1, 1), T(0), A(2, 0), A(2, 1), A(2, 2);
        for (int k = 0; k < 3; ++k) {
            T pivot = L(k, k);
            if (k > 0) pivot -= L.row(k).head(k).squaredNorm();
            if (pivot <= T(0)) return;
            L(k, k) = std::sqrt(pivot);
            for (int i = k + 1; i < 3; ++i) {
                T below = L(i, k);
                if (k > 0) below -= L.row(i).head(k).dot(L.row(k).head(k));
                L(i, k) = below / L(k, k);
            }
        }
        positive = true;
    }

    // Returns A^-1 b.
    Vector3<T> solve(Vector3<T> b) const {
        b[0] /= L(0, 0);
        b[1] = (b[1] - L(1, 0) * b[0]) / L(1, 1);
        b[2] = (b[2] - (L(2, 0) * b[0] + L(2, 1) * b[1])) / L(2, 2);
        b[2] /= L(2, 2);
        b[1] = (b[1] - L(2, 1) * b[2]) / L(1, 1);
        b[0] = (b[0] - (L(1, 0) * b[1] + L(2, 0) * b[2])) / L(0, 0);
        return b;
    }
};

// Makes X L^-1 X. L is lower triangular.
template <class T> void solve_lower(const Matrix3<T>& L, Matrix3<T>& X) {
    const Vector3<T> scale = L.diagonal().cwiseInverse();
    for (int c = 0; c < 3; ++c) {
        X(0, c) *= scale[0];
        X(1, c) = (X(1, c) - X(0, c) * L(1, 0)) * scale[1];
        X(2, c) = ((X(2, c) - X(0, c) * L(2, 0)) - X(1, c) * L(2, 1)) * scale[2];
    }
}

// Makes X L^-T X.
template <class T> void solve_lower_transposed(const Matrix3<T>& L, Matrix3<T>& X) {
    const Vector3<T> scale = L.diagonal().cwiseInverse();
    for (int c = 0; c < 3; ++c) {
        X(2, c) *= scale[2];
        X(1, c) = (X(1, c) - L(2, 1) * X(2, c)) * scale[1];
        X(0, c) = (X(0, c) - (L(1, 0) * X(1, c) + L(2, 0) * X(2, c))) * scale[0];
    }
}

} // namespace bough

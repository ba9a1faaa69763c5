// lanczos.h: the largest eigenvalues, and their vectors, of a symmetric operator that is never formed.
//
// Lanczos's iteration with thick restarts (Wu, Simon, SIAM J. Matrix Anal. Appl. 22:602, 2000): where the basis is full, its best Ritz vectors and
// the residual begin the next one. A Ritz pair (theta, x) has the residual |A x - theta x| = |beta s|, s the last number of its vector in the basis.
// Each new vector is made orthogonal to the basis by Gram and Schmidt's classical step, once more where the first took out more than rounding leaves.
// (Spectra's solver does the same work on one thread in four times the passes over the basis: a million bodies and 10 modes took 94 s, and 2.5 GB.)
// A Krylov space has one direction of each eigenspace. keep() takes vectors out of the operator, so that another call finds the next direction.
// Rows are worked on in blocks, whose sums are added in their order: the thread count cannot change the result.
// Cost: a step is an operation and two passes over the basis. Memory: (vectors kept + basis) rows.
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <functional>

namespace bough {

class Lanczos {
public:
    // out = A y of so many rows, symmetric.
    using Operate = std::function<void(const double* y, double* out)>;
    Lanczos(Eigen::Index rows, Operate operate) : rows_(rows), operate_(std::move(operate)) {}

    // The `count` largest eigenvalues, falling, of A on all that is orthogonal to the vectors kept; fewer where it has fewer rows.
    // basis: vectors that are held, more than count; more take fewer operations. tolerance: of each residual, over its value.
    // Empty where `restarts` do not suffice.
    Eigen::VectorXd largest(Eigen::Index count, Eigen::Index basis, double tolerance, int restarts);

    // Keeps the first `count` of the vectors found by the last call.
    void keep(Eigen::Index count) { kept_ += count; }
    Eigen::Index kept() const { return kept_; }
    // [1] Of length 1. Those kept, then those found last, in the order of their values.
    Eigen::MatrixXd::ConstColXpr vector(Eigen::Index k) const { return basis_.col(k); }
    const double* numbers(Eigen::Index k) const { return basis_.col(k).data(); }

private:
    // Returns what of the first columns is in next_, which loses it.
    Eigen::VectorXd take_out(Eigen::Index columns);
    void start(Eigen::Index column);      // a vector of chance, orthogonal to those before it
    void turn(const Eigen::MatrixXd& to); // columns after those kept become their sums

    Eigen::Index rows_, kept_ = 0;
    Operate operate_;
    Eigen::MatrixXd basis_; // kept vectors, then the basis
    Eigen::VectorXd next_;
    std::uint64_t chance_ = 1;
};

} // namespace bough

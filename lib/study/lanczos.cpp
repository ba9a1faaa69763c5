#include "lanczos.h"
#include "../base/parallel.h"
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cstdint>

namespace bough {
namespace {

using Eigen::Index, Eigen::MatrixXd, Eigen::VectorXd;

constexpr Index block = 1024; // rows: 30 vectors of it are 240 kB, which stay in a core's cache

Index blocks(Index rows) {
    return (rows + block - 1) / block;
}

// work(first row, rows, block) of each block of rows, with so many vectors of it.
template <class Work> void for_blocks(Index rows, Index vectors, const Work& work) {
    parallel_blocks(std::size_t(blocks(rows)), double(block * (vectors + 2)) / 2, [&](std::size_t which, int) {
        const Index b = Index(which);
        work(b * block, std::min(block, rows - b * block), b);
    });
}

} // namespace

VectorXd Lanczos::take_out(Index columns) {
    const Index count = blocks(rows_);
    MatrixXd part(columns, count), again(columns, count);
    VectorXd before(count), after(count);
    const auto basis = basis_.leftCols(columns);
    for_blocks(rows_, columns, [&](Index first, Index rows, Index b) {
        part.col(b).noalias() = basis.middleRows(first, rows).transpose() * next_.segment(first, rows);
        before[b] = next_.segment(first, rows).squaredNorm();
    });
    VectorXd taken = part.rowwise().sum();
    for (VectorXd take = taken;;) {
        for_blocks(rows_, columns, [&](Index first, Index rows, Index b) {
            const auto here = basis.middleRows(first, rows);
            auto w = next_.segment(first, rows);
            w.noalias() -= here * take;
            again.col(b).noalias() = here.transpose() * w;
            after[b] = w.squaredNorm();
        });
        take = again.rowwise().sum();
        // What rounding leaves of a vector that was not shortened much is nothing to what is left.
        if (!(take.squaredNorm() > 1e-26 * after.sum()) || !(after.sum() > 1e-30 * before.sum())) return taken;
        taken += take;
    }
}

void Lanczos::start(Index column) {
    for (double& number : next_) {
        chance_ = chance_ * 6364136223846793005u + 1442695040888963407u;
        number = double(std::int64_t(chance_) >> 11) * 0x1p-52;
    }
    next_.normalize();
    take_out(column);
    next_.normalize();
}

void Lanczos::turn(const MatrixXd& to) {
    for_blocks(rows_, to.rows() * to.cols() / 4, [&](Index first, Index rows, Index) {
        MatrixXd made(
            rows,
            to.cols()); // column by column: Eigen's product of matrices would start threads of its own in each block
        for (Index k = 0; k < to.cols(); ++k)
            made.col(k).noalias() = basis_.block(first, kept_, rows, to.rows()) * to.col(k);
        basis_.block(first, kept_, rows, to.cols()) = made;
    });
}

VectorXd Lanczos::largest(Index count, Index most, double tolerance, int restarts) {
    const Index room = rows_ - kept_;
    count = std::min(count, room);
    most = std::clamp(most, std::min(count + 2, room), room);
    if (count <= 0) return VectorXd();
    if (basis_.cols() < kept_ + most) basis_.conservativeResize(rows_, kept_ + most);
    next_.resize(rows_);
    MatrixXd T = MatrixXd::Zero(most, most);
    start(kept_);
    Index have = 0; // vectors of the basis; next_ is the one after them
    for (int restart = 0; restart <= restarts; ++restart) {
        double beta = 0;
        while (have < most) {
            const Index column = kept_ + have++;
            basis_.col(column) = next_;
            operate_(basis_.col(column).data(), next_.data());
            const double length = next_.norm();
            const VectorXd within = take_out(column + 1).tail(have);
            T.col(have - 1).head(have) = within;
            T.row(have - 1).head(have) = within;
            beta = next_.norm();
            if (beta > 1e-14 * length)
                next_ /= beta;
            else if (beta = 0; have < room)
                start(kept_ + have); // the basis holds all that the first vector leads to
        }
        const Eigen::SelfAdjointEigenSolver<MatrixXd> ritz(T);
        const MatrixXd vectors = ritz.eigenvectors().rowwise().reverse();
        const VectorXd values = ritz.eigenvalues().reverse();
        const Eigen::ArrayXd residual = beta * vectors.row(most - 1).head(count).cwiseAbs();
        const Eigen::ArrayXd allowed = tolerance * values.head(count).cwiseAbs().cwiseMax(1e-12 * std::abs(values[0]));
        if (have == room || (residual <= allowed).all()) {
            turn(vectors.leftCols(count));
            return values.head(count);
        }
        have = std::min(most - 1, count + (most - count) / 2);
        turn(vectors.leftCols(have));
        T.setZero();
        T.diagonal().head(have) = values.head(have);
    }
    return VectorXd();
}

} // namespace bough

// Eigenvalues of matrices of known ones: A = Q diag(d) Q^T with Q of two reflections, never formed.
#include "lib/study/lanczos.h"
#include "lib/base/parallel.h"
#include <Eigen/Core>
#include <catch2/catch.hpp>

using namespace bough;
using Eigen::Index, Eigen::VectorXd;

namespace {

struct Known {
    VectorXd d, u, v;
    explicit Known(const VectorXd& values) : d(values), u(values.size()), v(values.size()) {
        for (Index i = 0; i < d.size(); ++i) u[i] = std::sin(1.0 + 3 * double(i)), v[i] = std::cos(double(i * i % 977));
        u.normalize();
        v.normalize();
    }
    static void reflect(VectorXd& y, const VectorXd& n) { y -= 2 * n.dot(y) * n; }
    VectorXd operator*(const VectorXd& y) const {
        VectorXd z = y;
        reflect(z, u);
        reflect(z, v);
        z = d.cwiseProduct(z);
        reflect(z, v);
        reflect(z, u);
        return z;
    }
    Lanczos::Operate operate(int* count = nullptr) const {
        return [this, count](const double* y, double* out) {
            if (count) ++*count;
            Eigen::Map<VectorXd>(out, d.size()) = *this * VectorXd(Eigen::Map<const VectorXd>(y, d.size()));
        };
    }
};

// 1 / k^2, as 1 / omega^2 of a beam falls.
VectorXd falling(Index rows) {
    VectorXd d(rows);
    for (Index i = 0; i < rows; ++i) d[i] = 1 / std::pow(double(i + 1), 2);
    return d;
}

void check_pairs(const Known& A, const Lanczos& lanczos, Index first, const VectorXd& values) {
    for (Index k = 0; k < values.size(); ++k) {
        const VectorXd x = lanczos.vector(first + k);
        CHECK(std::abs(x.norm() - 1) < 1e-13);
        CHECK((A * x - values[k] * x).norm() <= 2e-9 * values[k]);
        for (Index before = 0; before < first + k; ++before) CHECK(std::abs(lanczos.vector(before).dot(x)) < 1e-11);
    }
}

} // namespace

TEST_CASE("the largest values, of few rows and of many, with the fewest restarts that a basis allows") {
    for (const Index rows : {1, 2, 3, 9, 40, 700, 5000}) {
        const Known A(falling(rows));
        for (const Index count : {Index(1), Index(3), Index(10)}) {
            int operations = 0;
            Lanczos lanczos(rows, A.operate(&operations));
            const VectorXd values = lanczos.largest(count, 2 * count + 10, 1e-9, 200);
            REQUIRE(values.size() == std::min(count, rows));
            for (Index k = 0; k < values.size(); ++k) CHECK(std::abs(values[k] / A.d[k] - 1) < 1e-12);
            check_pairs(A, lanczos, 0, values);
            CHECK(operations <= std::min<Index>(rows, 120));
        }
    }
}

TEST_CASE("values close to one another take restarts, each of which goes on from the best of the one before") {
    const Index rows = 3000;
    VectorXd d(rows);
    for (Index i = 0; i < rows; ++i) d[i] = 1 / std::pow(double(i + 60), 2);
    const Known A(d);
    int operations = 0;
    Lanczos lanczos(rows, A.operate(&operations));
    const VectorXd values = lanczos.largest(10, 30, 1e-9, 200);
    REQUIRE(values.size() == 10);
    for (Index k = 0; k < 10; ++k) CHECK(std::abs(values[k] / d[k] - 1) < 1e-12);
    check_pairs(A, lanczos, 0, values);
    CHECK(operations > 60);
    CHECK(operations < 400);
}

TEST_CASE("values that several vectors share turn up one after the other, once those before are kept") {
    VectorXd d = falling(300);
    d[1] = d[2] = d[0];
    d[4] = d[3];
    const Known A(d);
    Lanczos lanczos(300, A.operate());
    VectorXd found(0);
    for (const Index count : {3, 2, 1}) {
        const VectorXd values = lanczos.largest(count, 20, 1e-10, 200);
        check_pairs(A, lanczos, lanczos.kept(), values);
        lanczos.keep(count);
        found.conservativeResize(found.size() + count);
        found.tail(count) = values;
    }
    CHECK(lanczos.kept() == 6);
    std::sort(found.begin(), found.end(), std::greater<>());
    for (Index k = 0; k < 5; ++k) CHECK(std::abs(found[k] / d[k] - 1) < 1e-12);
}

TEST_CASE("an operator of few directions is exhausted, and goes on in others") {
    VectorXd d = VectorXd::Zero(60);
    d[0] = 2;
    d[1] = d[2] = 1;
    const Known A(d);
    Lanczos lanczos(60, A.operate());
    const VectorXd values = lanczos.largest(4, 12, 1e-10, 50);
    REQUIRE(values.size() == 4);
    CHECK((values - Eigen::Vector4d(2, 1, 1, 0)).norm() < 1e-12);
    check_pairs(A, lanczos, 0, values.head(3));
    CHECK(std::abs(lanczos.vector(3).norm() - 1) < 1e-12);

    const Known zero(VectorXd::Zero(20));
    Lanczos none(20, zero.operate());
    CHECK(none.largest(2, 6, 1e-10, 50) == VectorXd::Zero(2));
    CHECK(std::abs(none.vector(0).norm() - 1) < 1e-12);
    CHECK(std::abs(none.vector(1).norm() - 1) < 1e-12);
    CHECK(std::abs(none.vector(0).dot(none.vector(1))) < 1e-12);
}

TEST_CASE("where restarts do not suffice nothing is returned") {
    VectorXd d(4000);
    for (Index i = 0; i < d.size(); ++i) d[i] = 1 + 1e-6 * double(i);
    const Known A(d);
    CHECK(Lanczos(4000, A.operate()).largest(3, 8, 1e-12, 2).size() == 0);
}

TEST_CASE("eigenvectors do not depend on the number of threads") {
    const Index rows = 100000; // more blocks than one thread takes alone
    const Known A(falling(rows));
    Lanczos one(rows, A.operate()), three(rows, A.operate());
    VectorXd values;
    {
        const ThreadLimit limit(1);
        values = one.largest(4, 20, 1e-9, 100);
    }
    const ThreadLimit limit(3);
    CHECK(three.largest(4, 20, 1e-9, 100) == values);
    for (Index k = 0; k < values.size(); ++k) CHECK(one.vector(k) == three.vector(k));
}

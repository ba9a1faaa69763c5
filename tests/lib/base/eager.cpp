// What is worked out at once is what Eigen works out, bit by bit, and is no expression.
#include "lib/base/eager.h"
#include <catch2/catch.hpp>
#include <cstring>
#include <random>

using namespace bough;

namespace {

template <class M> bool same(const M& a, const M& b) {
    return std::memcmp(a.data(), b.data(), sizeof(M)) == 0; // zeros by their signs too
}

} // namespace

TEMPLATE_TEST_CASE("sums and products are those of Eigen's own operators", "", double, float) {
    using V = Vector3<TestType>;
    using M = Matrix3<TestType>;
    std::mt19937 dice(1);
    std::normal_distribution<TestType> normal;
    const auto random = [&](auto made) {
        for (Eigen::Index k = 0; k < made.size(); ++k) made.data()[k] = normal(dice);
        return made;
    };
    for (int round = 0; round < 200; ++round) {
        const V a = random(V()), b = random(V());
        const M A = random(M()), B = random(M());
        M changes = A; // its transpose is another type
        const TestType s = normal(dice);
        const auto expect = [](const auto& found, const auto& by_eigen) {
            using Found = std::remove_cvref_t<decltype(found)>;
            static_assert(std::is_same_v<Found, V> || std::is_same_v<Found, M>); // found in bough, and so no expression
            CHECK(same<Found>(found, Found(by_eigen)));
        };
        // A member named is Eigen's.
        expect(a + b, a.operator+(b));
        expect(a - b, a.operator-(b));
        expect(-a, a.operator-());
        expect(a * s, a.operator*(s));
        expect(s * a, a.operator*(s));
        expect(3 * a, a.operator*(3));
        expect(a / s, a.operator/(s));
        expect(a / 3, a.operator/(3));
        expect(A + B, A.operator+(B));
        expect(A - B, A.operator-(B));
        expect(-A, A.operator-());
        expect(A * s, A.operator*(s));
        expect(s * A, A.operator*(s));
        expect(A / s, A.operator/(s));
        expect(A * B, A.operator*(B));
        expect(A * a, A.operator*(a));
        expect(A.transpose() * a, A.transpose().operator*(a));
        expect(A.transpose() * B, A.transpose().operator*(B));
        expect(A * B.transpose(), A.operator*(B.transpose()));
        expect(changes.transpose() * a, A.transpose().operator*(a));
        expect(A + B.transpose(), A.operator+(B.transpose()));
        expect(A - B.transpose(), A.operator-(B.transpose()));
        expect(a * b.transpose(), a.operator*(b.transpose()));
        const auto one = M::Identity();
        expect(s * M::Identity(), one.operator*(s));
        expect(M::Identity() * s, one.operator*(s));
        expect(M::Identity() + A, one.operator+(A));
        expect(M::Identity() - A, one.operator-(A));
        expect(A + M::Identity(), A.operator+(one));
        expect(A - M::Identity(), A.operator-(one));
        // Longer ones too, in the same order.
        expect(A * (a - b) + s * b, V(A.operator*(a.operator-(b))).operator+(b.operator*(s)));
        expect(A * B * A.transpose(), M(A.operator*(B)).operator*(A.transpose()));
    }
}

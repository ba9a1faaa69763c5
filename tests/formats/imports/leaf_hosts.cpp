// leaf_hosts.h: the branch that a search over every segment of every branch finds, for many leaves around many branches.
#include "formats/imports/leaf_hosts.h"
#include "formats/imports/on_polyline.h"
#include <catch2/catch.hpp>
#include <random>

using namespace bough;

TEST_CASE("leaves without a branch get the nearest, others keep theirs") {
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    const auto point = [&] { return Vec3(normal(random), normal(random), normal(random)); };
    std::vector<ImportedBranch> branches(60);
    for (ImportedBranch& b : branches) {
        b.point = {5 * point()};
        for (int k = 0; k < 8; ++k) b.point.push_back(b.point.back() + 0.5 * point());
        b.radius.assign(b.point.size(), 0.01);
    }
    std::vector<ImportedLeaf> leaves(400);
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        leaves[i].position = 6 * point();
        leaves[i].branch = i % 7 == 0 ? std::int32_t(i % branches.size()) : -1;
    }
    std::vector<ImportedLeaf> hosted = leaves;
    find_hosts(branches, hosted);
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        if (leaves[i].branch >= 0) {
            CHECK(hosted[i].branch == leaves[i].branch);
            continue;
        }
        double nearest = 1e300;
        for (const ImportedBranch& b : branches)
            nearest = std::min(nearest, nearest_on(b.point, leaves[i].position).distance);
        REQUIRE(hosted[i].branch >= 0);
        CHECK(nearest_on(branches[hosted[i].branch].point, leaves[i].position).distance == Approx(nearest));
    }
}

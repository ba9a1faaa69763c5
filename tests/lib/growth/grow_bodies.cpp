// grow.h: whole trees: the same bytes, independent draws, the default tree, and trees of N bodies.
#include "lib/growth/segment.h"
#include "tests/support/grow_measure.h"
#include "tests/support/sanitized.h"
#include <string>

using namespace bough;
using namespace bough::measure;

namespace {

template <class T> void add_bytes(std::string& bytes, const std::vector<T>& values) {
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

std::string bytes_of(const Splines& s) {
    std::string bytes;
    add_bytes(bytes, s.parent);
    add_bytes(bytes, s.parent_at);
    add_bytes(bytes, s.level);
    add_bytes(bytes, s.first_point);
    add_bytes(bytes, s.point);
    add_bytes(bytes, s.radius);
    add_bytes(bytes, s.leaf_branch);
    add_bytes(bytes, s.leaf_at);
    add_bytes(bytes, s.leaf_position);
    for (const Quat& q : s.leaf_rotation) add_bytes(bytes, std::vector<double>{q.x(), q.y(), q.z(), q.w()});
    add_bytes(bytes, s.leaf_length);
    add_bytes(bytes, s.leaf_width);
    add_bytes(bytes, s.fruit_branch);
    add_bytes(bytes, s.fruit_center);
    return bytes;
}

} // namespace

TEST_CASE("The same seed gives the same bytes, another one another tree") {
    const GrowthParameters p = default_growth();
    const std::string once = bytes_of(grow(p, 7, {true, false, true}));
    CHECK((once == bytes_of(grow(p, 7, {true, false, true}))));
    CHECK((once != bytes_of(grow(p, 8, {true, false, true}))));
    const Splines with = grow(p, 7, {true, false, true}), without = grow(p, 7, {});
    CHECK(with.point == without.point);
    CHECK((bytes_of(grow_bodies(p, 7, {true, false, true}, 3000)) ==
           bytes_of(grow_bodies(p, 7, {true, false, true}, 3000))));
}

TEST_CASE("One parameter changed leaves the other draws alone") {
    const GrowthParameters p = default_growth();
    const Splines before = grow(p, 7, {});
    GrowthParameters changed = p;
    changed.level[3].length_v = 0.05;
    changed.level[3].curve_v = 10;
    Splines after = grow(changed, 7, {});
    REQUIRE(after.level == before.level);
    for (std::size_t b = 0; b < before.branches(); ++b)
        if (before.level[b] < 3)
            CHECK(before.point[last(before, b)] == after.point[last(after, b)]);
        else
            CHECK(start_direction(before, b).isApprox(start_direction(after, b), 1e-9));
    // More children: the boughs there keep the lengths' variation that they had, by number.
    changed = plain(2);
    changed.shape = 3;
    changed.level[1].length_v = 0.1;
    const Splines few = grow(changed, 7, {});
    changed.level[1].branches = 11;
    const Splines more = grow(changed, 7, {});
    for (std::size_t b = 1; b < few.branches(); ++b) CHECK(length(few, b) == Approx(length(more, b)));
}

TEST_CASE("The default tree is a sound broad-leaved tree of about 8 m") {
    for (std::uint64_t seed : {1, 2, 3}) {
        const Splines s = grow(default_growth(), seed, {true, false, true});
        check_sound(s);
        double top = 0;
        for (const Vec3& x : s.point) top = std::max(top, x.y());
        CHECK(top > 7);
        CHECK(top < 9);
        const double slimness = 8 / (2 * at(s, 0, 0.2).second);
        CHECK(slimness > 40);
        CHECK(slimness < 65);
    }
}

TEST_CASE("A tree of N bodies comes to N within a tenth") {
    for (const std::int64_t bodies : cases<std::int64_t>(7, {100, 137, 250, 600, 1000, 4321, 20000, 100000, 1000000}))
        for (const bool foliage : {false, true}) {
            INFO(bodies << (foliage ? " with" : " without") << " leaves and fruit");
            const Splines s = grow_bodies(default_growth(), 11, {foliage, false, foliage}, bodies);
            check_sound(s);
            CHECK(std::abs(double(count_bodies(s, SegmentOptions())) / double(bodies) - 1) <= 0.1);
            CHECK(length(s, 0) == Approx(default_growth().scale));
            CHECK((s.leaves() > 0) == foliage);
        }
}

TEST_CASE("A number of bodies changes no byte of the tree") {
    const Items items{true, false, true};
    const std::string whole = bytes_of(grow(default_growth(), 4, items));
    for (const std::int64_t bodies : {60, 4000, 1000000}) {
        const Splines s = grow_bodies(default_growth(), 4, items, bodies);
        CHECK(s.bodies == bodies);
        CHECK((bytes_of(s) == whole));
    }
}

TEST_CASE("Stems of one level only, and numbers that cannot be") {
    GrowthParameters p = plain(2);
    p.level[1].branches = 33;
    for (const std::int64_t bodies : {40, 5000}) {
        const Splines s = grow_bodies(p, 1, {}, bodies);
        CHECK(std::abs(double(count_bodies(s, SegmentOptions())) / double(bodies) - 1) <= 0.1);
    }
    CHECK(std::abs(double(count_bodies(grow_bodies(plain(1), 1, {}, 5000), SegmentOptions())) - 5000) <= 500);
    CHECK_THROWS_WITH(grow_bodies(p, 1, {}, 0), Catch::Contains("bodies"));
    CHECK_THROWS_WITH(grow_bodies(p, 1, {}, 20000001), Catch::Contains("bodies"));
}

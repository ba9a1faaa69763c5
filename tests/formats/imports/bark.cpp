#include "formats/imports/bark_twigs.h"
#include "tests/support/tubes.h"
#include <catch2/catch.hpp>

using namespace bough;
using namespace bough::test;

namespace {

// A stem that bends, of five bones of 1 m; its true radius falls from 0.1 to 0.05.
struct Stem {
    std::vector<Vec3> point;
    std::vector<double> radius;
    std::vector<speedtree::Bone> bones;
};

Stem stem() {
    Stem s;
    Vec3 at = Vec3::Zero();
    for (int k = 0; k <= 5; ++k) {
        s.point.push_back(at);
        s.radius.push_back(0.1 - 0.01 * k);
        at += Vec3(std::sin(0.15 * k), std::cos(0.15 * k), 0.05 * k).normalized();
    }
    for (int k = 0; k < 5; ++k) {
        speedtree::Bone bone;
        bone.parent = k - 1;
        bone.start = s.point[std::size_t(k)], bone.end = s.point[std::size_t(k) + 1];
        bone.has_end = true;
        s.bones.push_back(bone);
    }
    return s;
}

void check(const Stem& s, BarkSurface surface, double tolerance) {
    const std::vector<BarkTaper> found = bark_tapers(Bark(std::move(surface), s.bones.size()), s.bones);
    for (std::size_t b = 0; b < s.bones.size(); ++b) {
        INFO(b);
        CHECK(found[b].start == Approx(s.radius[b]).epsilon(tolerance));
        CHECK(found[b].end == Approx(s.radius[b + 1]).epsilon(tolerance));
    }
}

const std::vector<std::int32_t> bones{0, 1, 2, 3, 4};

} // namespace

TEST_CASE("bark around bones: the radius of the circle that its corners stand on, for any number of corners") {
    const Stem s = stem();
    for (const int corners : {3, 4, 6, 7, 16}) {
        INFO(corners);
        BarkSurface surface;
        add_tube(surface, s.point, s.radius, bones, corners, 0.3);
        check(s, surface, 0.02);
    }
}

TEST_CASE("bark is told from twigs, cards and shoots that move with the same bones") {
    const Stem s = stem();
    BarkSurface surface;
    add_tube(surface, s.point, s.radius, bones, 6);
    const std::size_t bark = surface.point.size();
    for (std::int32_t b = 0; b < 5; ++b)
        for (int k = 0; k < 12; ++k) {
            const double t = (k + 0.5) / 12, angle = 2.4 * k;
            const Vec3 base = s.point[std::size_t(b)] + t * (s.point[std::size_t(b) + 1] - s.point[std::size_t(b)]);
            const Vec3 out(std::cos(angle), 0.5, std::sin(angle)); // a twig begins on the axis, inside the bark
            add_tube(surface, {base, base + 0.7 * out, base + 1.5 * out}, {0.02, 0.012, 0.004}, {b}, 4);
            const Vec3 wide = out.unitOrthogonal(); // a leaf
            const auto first = std::int32_t(surface.point.size());
            for (const Vec3& p :
                 {Vec3(base + out - 0.2 * wide), Vec3(base + out + 0.2 * wide), Vec3(base + 1.4 * out)}) {
                surface.point.push_back(p);
                surface.bone.push_back(b);
            }
            surface.triangle.push_back({first, first + 1, first + 2});
        }
    CHECK(surface.point.size() > 20 * bark);
    check(s, surface, 0.02);
    // Twigs alone are no bark.
    BarkSurface twigs;
    add_tube(twigs, {{0.5, 0.5, 0}, {1.5, 0.6, 0}}, {0.02, 0.01}, {0}, 6);
    CHECK(bark_tapers(Bark(twigs, 5), s.bones)[0].start == 0);
}

TEST_CASE("twigs without bones: axis, radii and forks of tubes, welded to the stem or not; no leaves, fruit or bark") {
    const Stem s = stem();
    BarkSurface surface;
    add_tube(surface, s.point, s.radius, bones, 6);
    // A bent twig that tapers, turned so that its tip leans back to the stem.
    const std::vector<Vec3> bent{{0, 0.5, 0}, {0.4, 0.6, 0}, {0.8, 0.8, 0.1}, {1.1, 1.1, 0.2}, {1.3, 1.5, 0.2}};
    const std::vector<double> thick{0.03, 0.025, 0.02, 0.015, 0.01};
    add_tube(surface, bent, thick, {0}, 8);
    // A ball and a card.
    add_tube(surface, {{2, 0, 0}, {2, 0.1, 0}, {2, 0.2, 0}, {2, 0.3, 0}}, {0.1, 0.2, 0.2, 0.1}, {0}, 8);
    const auto first = std::int32_t(surface.point.size());
    for (const Vec3& p : {Vec3(0.2, 1, 0), Vec3(0.2, 1, 0.2), Vec3(1.2, 1, 0.2), Vec3(1.2, 1, 0)}) {
        surface.point.push_back(p);
        surface.bone.push_back(0);
    }
    surface.triangle.push_back({first, first + 1, first + 2});
    surface.triangle.push_back({first, first + 2, first + 3});
    const auto found_in = [&](const BarkSurface& of) {
        const Bark bark(of, s.bones.size());
        return twigs_without_bones(bark, s.bones, bark_tapers(bark, s.bones));
    };
    const std::vector<Twig> twigs = found_in(surface);
    REQUIRE(twigs.size() == 1);
    CHECK((twigs[0].point.front() - bent.front()).norm() < 0.01);
    CHECK((twigs[0].point.back() - bent.back()).norm() < 0.01);
    CHECK(twigs[0].radius.front() == Approx(0.03).epsilon(0.05));
    CHECK(twigs[0].radius.back() == Approx(0.01).epsilon(0.05));
    // The same with an arm that is welded to its middle ring, as it is to the stem's own bark.
    BarkSurface forked = surface;
    const std::size_t ring = 6 * s.point.size() + 8 * 2; // the twig's third
    const std::size_t arm = forked.point.size();
    add_tube(forked, {{0.85, 0.9, 0.3}, {0.9, 1, 0.8}, {0.9, 1, 1.2}}, {0.015, 0.012, 0.01}, {0}, 8);
    for (std::size_t c = 0; c < 8; ++c) {
        const auto at = [&](std::size_t from, std::size_t k) { return std::int32_t(from + k % 8); };
        forked.triangle.push_back({at(ring, c), at(ring, c + 1), at(arm, c)});
        forked.triangle.push_back({at(ring, c + 1), at(arm, c + 1), at(arm, c)});
    }
    const std::vector<Twig> two = found_in(forked);
    REQUIRE(two.size() == 2);
    const Vec3 ends[2] = {bent.back(), {0.9, 1, 1.2}};
    for (const Vec3& end : ends)
        CHECK(std::min((two[0].point.back() - end).norm(), (two[1].point.back() - end).norm()) < 0.02);
}

TEST_CASE("a tube that ends in a point, corners twice in one place, squares, how far bark goes") {
    speedtree::Bone bone;
    bone.end = Vec3(0, 2, 0);
    BarkSurface cone;
    add_tube(cone, {{0, 0, 0}, {0, 2, 0}}, {0.2, 0}, {0}, 8);
    const BarkTaper taper = bark_tapers(Bark(cone, 1), {bone})[0];
    CHECK(taper.start == Approx(0.2));
    CHECK(taper.end == Approx(0.01)); // a tenth of the median, at 1 m
    // Every triangle with corners of its own, as a mesh split by its normals has.
    BarkSurface split;
    for (const auto& triangle : cone.triangle) {
        std::array<std::int32_t, 3> own;
        for (std::size_t k = 0; k < 3; ++k) {
            own[k] = std::int32_t(split.point.size());
            split.point.push_back(cone.point[std::size_t(triangle[k])]);
            split.bone.push_back(0);
        }
        split.triangle.push_back(own);
    }
    CHECK(bark_tapers(Bark(split, 1), {bone})[0].start == Approx(0.2));
    for (const int corners : {3, 4, 5}) {
        BarkSurface tube;
        add_tube(tube, {{0, 0, 0}, {0, 1, 0}, {0, 2, 0}}, {0.1, 0.1, 0.1}, {0}, corners);
        const BarkTaper found = bark_tapers(Bark(tube, 1), {bone})[0];
        CHECK(found.rings == 5);
        CHECK(found.square == (corners == 4 ? 5 : 0));
    }
    // A stem of 2 m, and a twig on it that goes 3 m up beside it, of one bone.
    BarkSurface pair;
    add_tube(pair, {{0, 0, 0}, {0, 1, 0}, {0, 2, 0}}, {0.1, 0.1, 0.05}, {0}, 6);
    add_tube(pair, {{0, 1, 0}, {0.3, 1.5, 0}, {0.3, 4, 0}}, {0.02, 0.02, 0.01}, {0}, 6);
    const Bark bark(pair, 1);
    const BarkRing ring = bark.ring(0, {0, 0.1, 0}, {0, 1, 0});
    CHECK(ring.radius == Approx(0.1));
    CHECK(bark.reach(0, ring.piece, Vec3::Zero(), {0, 1, 0}, 0.2) == Approx(2));
}

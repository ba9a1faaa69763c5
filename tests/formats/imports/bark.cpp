#include "formats/imports/bark.h"
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

// leaf_form.h, blade.h: outlines against areas known otherwise, surfaces against their outlines.
#include "lib/growth/blade.h"
#include <catch2/catch.hpp>
#include <map>
#include <numbers>

using namespace bough;

namespace {

LeafForm flat(std::vector<double> outline) {
    LeafForm form;
    form.outline = std::move(outline);
    form.petiole = form.fold = form.curl = 0;
    return form;
}

// A lobed leaf, with a notch at its foot and corners.
LeafForm lobed() {
    LeafForm form = flat({0.1, 0.03, 0, 0.4, 0, 0.4, 0.3, 0.5, 0.55, 1, 0.55, 1, 0.5, 0.3, 0.5, 0.3, 0.8, 0.3, 1, 0});
    form.petiole = 0.25;
    return form;
}

double triangle_area(const Blade& blade, const std::array<std::int32_t, 3>& t) {
    const auto at = [&](std::size_t k) -> const Vec3& { return blade.position[std::size_t(t[k])]; };
    return (at(1) - at(0)).cross(at(2) - at(0)).norm() / 2;
}

} // namespace

TEST_CASE("an outline of corners has the area of its polygon, a smooth one that of the ellipse it goes through") {
    // A kite: corners stand twice.
    const LeafForm kite = flat({0, 0, 0, 0, 0.4, 1, 0.4, 1, 1, 0});
    CHECK(leaf_area_of(leaf_half(kite, 0.6, 5)) == Approx(0.3).epsilon(1e-12));
    std::vector<double> ellipse;
    for (int k = 0; k <= 16; ++k) {
        const double angle = std::numbers::pi * k / 16;
        ellipse.insert(ellipse.end(), {k == 16 ? 1 : (1 - std::cos(angle)) / 2, k == 16 ? 0 : std::sin(angle)});
    }
    CHECK(leaf_area_of(leaf_half(flat(ellipse), 0.6, 6)) == Approx(std::numbers::pi / 4 * 0.6).epsilon(2e-3));
}

TEST_CASE("teeth stand out of the margin, a petiole takes its share of the length") {
    LeafForm form = flat({0, 0.2, 0.4, 1, 0.7, 0.7, 1, 0});
    const double plain = leaf_area_of(leaf_half(form, 0.5, 6));
    form.teeth = 10;
    form.tooth = 0.1;
    const double toothed = leaf_area_of(leaf_half(form, 0.5, 6));
    CHECK(toothed > plain);
    CHECK(toothed < plain * 1.25);
    CHECK(leaf_half(form, 0.5, 0).size() > 20);
    form.teeth = 0;
    form.petiole = 0.3;
    CHECK(leaf_area_of(leaf_half(form, 0.5, 6)) == Approx(0.7 * plain).margin(0.3 * 0.024 + 0.005));
}

TEST_CASE("a flat blade's triangles cover its outline once, on both faces, and look away from each other") {
    for (const LeafForm& form : {lobed(), flat({0, 0.2, 0.4, 1, 0.7, 0.7, 1, 0})}) {
        const double area = leaf_area_of(leaf_half(form, 0.8, 1));
        const Blade blade = blade_mesh(form, 0.8);
        double up = 0, down = 0;
        for (const auto& t : blade.triangle) {
            const auto at = [&](std::size_t k) -> const Vec3& { return blade.position[std::size_t(t[k])]; };
            const double y = (at(1) - at(0)).cross(at(2) - at(0)).y() / 2;
            (y > 0 ? up : down) += y;
            for (const std::int32_t v : t) CHECK(blade.normal[std::size_t(v)].y() * y >= 0);
        }
        CHECK(up == Approx(area).epsilon(1e-9)); // an ear over another, or outside, would add to it
        CHECK(down == Approx(-area).epsilon(1e-9));
    }
}

TEST_CASE("a folded and curled blade keeps its area and its length along the midrib") {
    LeafForm form = lobed();
    const Blade plain = blade_mesh(form, 0.8);
    form.fold = 25;
    const Blade folded = blade_mesh(form, 0.8);
    double was = 0, is = 0;
    for (const auto& t : plain.triangle) was += triangle_area(plain, t);
    for (const auto& t : folded.triangle) is += triangle_area(folded, t);
    CHECK(is == Approx(was).epsilon(0.01)); // a fold along the midrib is an isometry
    form.curl = 60;
    const Blade curled = blade_mesh(form, 0.8);
    Vec3 tip = Vec3::Zero();
    for (const Vec3& p : curled.position)
        if (p.z() > tip.z()) tip = p;
    // The arc of length 1 that turns by 60 degrees: chord 2 sin(30) / (pi / 3), hanging by half the angle.
    CHECK(tip.norm() == Approx(2 * 0.5 / (std::numbers::pi / 3)).epsilon(0.01));
    CHECK(tip.y() == Approx(-tip.norm() * 0.5).epsilon(0.02));
    for (const Vec3& n : curled.normal) CHECK(n.norm() == Approx(1));
}

TEST_CASE("each blade keeps to its square of the picture, foot below, tip above") {
    for (const Blade& blade : {blade_mesh(lobed(), 0.8), blade_card(lobed(), 0.8)}) {
        bool upper = false, lower = false;
        for (std::size_t v = 0; v < blade.position.size(); ++v) {
            const auto& [u, w] = blade.uv[v];
            CHECK((u >= 0 && u <= 1 && w >= 0 && w <= 0.5));
            (blade.normal[v].y() > 0 ? upper : lower) = true;
            CHECK((blade.normal[v].y() > 0 ? u <= 0.5 : u >= 0.5));
        }
        CHECK((upper && lower));
    }
    const Blade spray = spray_card(lobed(), 0.8);
    CHECK(spray.position.size() == 4);
    for (const auto& [u, w] : spray.uv) CHECK((w >= 0.5 && u <= 0.5));
    CHECK(spray.area > 0);
    CHECK(spray.area < 1.5); // of a square's 1, as leaves overlap
}

TEST_CASE("needles of a bundle are as many blades") {
    LeafForm form = flat({0, 0.2, 0.8, 0.2, 1, 0});
    form.needles = 5;
    form.spread = 40;
    const Blade five = blade_mesh(form, 0.1);
    double left = 0, right = 0;
    for (const Vec3& p : five.position) left = std::min(left, p.x()), right = std::max(right, p.x());
    CHECK(five.triangle.size() % 5 == 0);
    CHECK(five.triangle.size() >= 5 * 8);
    CHECK(right == Approx(std::sin(20 * std::numbers::pi / 180)).margin(0.03));
    CHECK(left == Approx(-right));
}

TEST_CASE("forms out of range are refused by their field") {
    const auto refused = [](const char* field, auto change) {
        LeafForm form = flat({0, 0.2, 0.4, 1, 1, 0});
        change(form);
        CHECK_THROWS_WITH(check_leaf_form(form), Catch::StartsWith(field));
    };
    check_leaf_form(lobed());
    check_leaf_form(LeafForm());
    refused("leaf_outline", [](LeafForm& f) { f.outline.pop_back(); });
    refused("leaf_outline", [](LeafForm& f) { f.outline[3] = 1.2; });
    refused("leaf_outline", [](LeafForm& f) { f.outline.back() = 0.1; });
    refused("leaf_veins", [](LeafForm& f) { f.veins = "none"; });
    refused("leaf_petiole", [](LeafForm& f) { f.petiole = 0.9; });
    refused("leaf_needles", [](LeafForm& f) { f.needles = 0; });
    refused("leaf_teeth", [](LeafForm& f) { f.teeth = -1; });
}

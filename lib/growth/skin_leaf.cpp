#include "clump.h"
#include "skin_mesh.h"
#include <numbers>

namespace bough {

namespace {

// A blade of length, width and thickness; where it stands in the world.
void add_blade(Skin& skin, Kind kind, const Vec3& size, const Mat3& axes, const Vec3& foot, const Binding& binding) {
    const auto at = [&](double x, double y, double z) { return Vec3(foot + axes * Vec3(x, y, z)); };
    // A kite has the area of the triangle of its length and width; leaves are widest near the base, petals near the tip.
    const double widest = kind == Kind::petal ? 0.7 : 0.4;
    // The faces stand a leaf's thickness apart, so that they do not flicker in programs that draw both.
    for (const double side : {1.0, -1.0}) {
        const double y = side * size.z() / 2;
        const Vec3 normal = side * axes.col(1);
        const std::int32_t a = add_vertex(skin, at(0, y, 0), normal, 0.5, 0, binding);
        for (const double across : {-0.5, 0.5})
            add_vertex(skin, at(across * size.y(), y, widest * size.x()), normal, 0.5 + across, widest, binding);
        add_vertex(skin, at(0, y, size.x()), normal, 0.5, 1, binding);
        for (const auto& [b, c] : {std::pair(1, 3), std::pair(3, 2)}) {
            if (side > 0)
                skin.triangle.push_back({a, a + b, a + c});
            else
                skin.triangle.push_back({a, a + c, a + b});
        }
    }
}

} // namespace

void add_leaf(Skin& skin, const Tree& tree, const DrawnPose& pose, std::size_t body) {
    add_blade(skin, tree.kind[body], tree.size[body], pose.R_wb[body], pose.x_w[body], bound_to(body));
}

void add_clump(Skin& skin, const Tree& tree, const DrawnPose& pose, std::size_t body, std::int32_t leaves) {
    const Mat3& R = pose.R_wb[body];
    const Vec3 size = clump_leaf_size(tree, body, leaves);
    for (const ClumpLeaf& leaf : clump_leaves(tree, body, R, leaves)) {
        skin.clump_leaf.push_back(std::int32_t(skin.position.size()));
        add_blade(skin, tree.kind[body], size, R * leaf.axes, pose.at(body, leaf.foot), bound_to(body));
    }
}

void add_fruit(Skin& skin, const Tree& tree, const DrawnPose& pose, std::size_t body) {
    constexpr int columns = int(fruit_columns), bands = int(fruit_bands);
    const double center = tree.size[body].x(), radius = tree.size[body].y();
    const Binding binding = bound_to(body);
    const double pi = std::numbers::pi;

    // Profile from the joint's side to the far end: distance along the body, radius, normal's angle from -z.
    struct Row {
        double z, r, angle;
    };
    std::vector<Row> rows;
    const bool stalk = center > radius;
    if (stalk) {
        const double neck = 0.04; // [rad] where the stalk enters the sphere
        rows.push_back({0, 0, 0});
        rows.push_back({0, 0.04 * radius, pi / 2});
        rows.push_back({center - radius * std::cos(neck), radius * std::sin(neck), neck});
    } else {
        rows.push_back({center - radius, 0, 0});
    }
    for (int k = 1; k <= bands; ++k) {
        const double angle = pi * k / bands;
        rows.push_back({center - radius * std::cos(angle), k < bands ? radius * std::sin(angle) : 0, angle});
    }

    std::int32_t lower = 0;
    for (std::size_t row = 0; row < rows.size(); ++row) {
        const Row& at = rows[row];
        std::int32_t upper = 0; // the number of column 0
        for (int j = 0; j <= columns; ++j) {
            // No triangle has a pole's first or last: programs leave out what none has, and count anew.
            if (at.r == 0 && j == (row == 0 ? columns : 0)) continue;
            const double around = 2 * pi * (j % columns) / columns;
            const Vec3 out(std::cos(around), std::sin(around), 0);
            const Vec3 normal = std::sin(at.angle) * out - std::cos(at.angle) * Vec3::UnitZ();
            const std::int32_t added =
                add_vertex(skin, pose.at(body, at.r * out + at.z * Vec3::UnitZ()), pose.R_wb[body] * normal,
                           double(j) / columns, double(row) / double(rows.size() - 1), binding);
            upper = added - j;
        }
        for (std::int32_t j = 0; row > 0 && j < columns; ++j) {
            if (rows[row - 1].r > 0) skin.triangle.push_back({lower + j, lower + j + 1, upper + j + 1});
            if (at.r > 0) skin.triangle.push_back({lower + j, upper + j + 1, upper + j});
        }
        lower = upper;
    }
}

} // namespace bough

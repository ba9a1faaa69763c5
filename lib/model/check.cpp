#include "../base/cholesky.h"
#include "../base/shortest_text.h"
#include "check_parts.h"
#include "splines.h"
#include "tree.h"
#include "tree_arrays.h"
#include <Eigen/Eigenvalues>
#include <limits>

namespace bough {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

std::string text(double value) {
    return shortest_text(value);
}
std::string text(std::size_t value) {
    return std::to_string(value);
}

bool is_finite(double value) {
    return std::isfinite(value);
}
template <class Derived> bool is_finite(const Eigen::MatrixBase<Derived>& value) {
    return value.allFinite();
}
bool is_finite(const Quat& value) {
    return value.coeffs().allFinite();
}

// Collects the first broken rule; each rule is one call, and does nothing once one is broken.
class Rules {
public:
    std::optional<Defect> defect;

    template <class T>
    Rules& length(const char* field, const std::vector<T>& values, std::size_t expected, const char* what) {
        if (!defect && values.size() != expected)
            broken(field, -1,
                   "has " + text(values.size()) + " entries, expected " + text(expected) + " (" + what + ")");
        return *this;
    }

    // holds(value) for every entry; message(index, value) says how it is and what was expected.
    template <class T, class Holds, class Message>
    Rules& each(const char* field, const std::vector<T>& values, Holds holds, Message message) {
        if (defect) return *this;
        for (std::size_t i = 0; i < values.size(); ++i)
            if (!holds(i, values[i])) {
                broken(field, std::int64_t(i), message(i, values[i]));
                break;
            }
        return *this;
    }

    template <class T> Rules& all_finite(const char* field, const std::vector<T>& values) {
        return each(
            field, values, [](std::size_t, const T& v) { return is_finite(v); },
            [](std::size_t, const T&) { return std::string("is not finite, expected finite numbers"); });
    }

    // Of places and sizes.
    Rules& lengths(const char* field, const std::vector<Vec3>& values) {
        return all_finite(field, values)
            .each(
                field, values, [](std::size_t, const Vec3& v) { return v.cwiseAbs().maxCoeff() <= largest_length; },
                [](std::size_t, const Vec3& v) {
                    return "is (" + text(v.x()) + ", " + text(v.y()) + ", " + text(v.z()) + "), expected at most " +
                           text(largest_length) + " either way";
                });
    }

    Rules& between(const char* field, const std::vector<double>& values, double low, double high) {
        const bool open = high == std::numeric_limits<double>::infinity();
        const std::string expected = open ? text(low) + " or more" : text(low) + " to " + text(high);
        return each(
            field, values, [=](std::size_t, double v) { return is_finite(v) && v >= low && v <= high; },
            [=](std::size_t, double v) { return "is " + text(v) + ", expected " + expected; });
    }

    Rules& positive(const char* field, const std::vector<double>& values, double high = unbounded) {
        return each(
            field, values, [=](std::size_t, double v) { return is_finite(v) && v > 0 && v <= high; },
            [=](std::size_t, double v) {
                return "is " + text(v) + ", expected more than 0" + (v > high ? ", at most " + text(high) : "");
            });
    }

    Rules& index(const char* field, const std::vector<std::int32_t>& values, std::size_t count, const char* what) {
        return each(
            field, values, [=](std::size_t, std::int32_t v) { return v >= 0 && std::size_t(v) < count; },
            [=](std::size_t, std::int32_t v) {
                return "is " + std::to_string(v) + ", expected " + what + ", 0 to less than " + text(count);
            });
    }

    Rules& parents(const std::vector<std::int32_t>& values) {
        return each(
            "parent", values, [](std::size_t i, std::int32_t v) { return v >= -1 && v < std::int64_t(i); },
            [](std::size_t i, std::int32_t v) {
                if (i == 0) return "is " + std::to_string(v) + ", expected -1 (the first one stands on the ground)";
                return "is " + std::to_string(v) + ", expected -1 or less than " + text(i) +
                       " (parents stand before children)";
            });
    }

    Rules& not_negative(const char* field, const std::vector<std::int32_t>& values) {
        return each(
            field, values, [](std::size_t, std::int32_t v) { return v >= 0; },
            [](std::size_t, std::int32_t v) { return "is " + std::to_string(v) + ", expected 0 or more"; });
    }

    Rules& unit(const char* field, const std::vector<Quat>& values) {
        return all_finite(field, values)
            .each(
                field, values, [](std::size_t, const Quat& q) { return std::abs(q.norm() - 1) <= 1e-6; },
                [](std::size_t, const Quat& q) {
                    return "has length " + text(q.norm()) + ", expected a unit quaternion";
                });
    }

    Rules& rule(bool holds, const std::string& field, std::int64_t index, const std::string& message) {
        if (!defect && !holds) broken(field, index, message);
        return *this;
    }

private:
    void broken(const std::string& field, std::int64_t index, const std::string& message) {
        defect = Defect{field, index, message};
    }
};

// Every entry of the vector >= 0, the first `positive` of them > 0.
void check_sizes(Rules& rules, const char* field, const std::vector<Vec3>& values, int positive) {
    rules.all_finite(field, values)
        .each(
            field, values,
            [=](std::size_t, const Vec3& v) {
                return v.minCoeff() >= 0 && (positive == 0 || v.head(positive).minCoeff() > 0);
            },
            [=](std::size_t, const Vec3& v) {
                return "is (" + text(v.x()) + ", " + text(v.y()) + ", " + text(v.z()) + "), expected " +
                       (positive == 0 ? "0 or more each" : "a length above 0 and no negative size");
            });
}

// At least 1, and 1 where is_leaf(index) does not hold.
template <class IsLeaf> void check_counts(Rules& rules, const std::vector<std::int32_t>& counts, IsLeaf is_leaf) {
    rules.each(
        "leaf_count", counts, [&](std::size_t i, std::int32_t n) { return n == 1 || (n > 1 && is_leaf(i)); },
        [&](std::size_t i, std::int32_t n) {
            return "is " + std::to_string(n) + ", expected " +
                   (is_leaf(i) ? "1 or more" : "1 (only a leaf stands for more)");
        });
}

void check_colors(Rules& rules, const std::vector<Vec3>& colors) {
    rules.length("color", colors, colors.empty() ? 0 : default_colors().size(), "none, or bark, leaf, petal and fruit")
        .each(
            "color", colors, [](std::size_t, const Vec3& c) { return c.minCoeff() >= 0 && c.maxCoeff() <= 1; },
            [](std::size_t, const Vec3& c) {
                return "is (" + text(c.x()) + ", " + text(c.y()) + ", " + text(c.z()) + "), expected 0 to 1 each";
            });
}

// Moments of a real body: the second-moment matrix tr(I)/2 - I must not be negative, which is the triangle inequality
// of the principal moments and holds I itself above zero too. Cholesky pivots after a lift by rounding.
bool possible_inertia(const Mat3& inertia) {
    const double trace = inertia.trace();
    if (trace == 0) return inertia.isZero(0);
    if (!(trace > 0) || (inertia - inertia.transpose()).cwiseAbs().maxCoeff() > 1e-9 * trace) return false;
    const Mat3 moments = (0.5 * trace + 1e-9 * trace) * Mat3::Identity() - inertia;
    return Cholesky<double>(moments / trace).positive;
}

} // namespace

std::optional<Defect> check(const Splines& splines) {
    Rules rules;
    const std::size_t branches = splines.branches(), points = splines.points();
    const std::size_t leaves = splines.leaves(), fruits = splines.fruits();
    rules.rule(branches > 0, "parent", -1, "is empty, expected at least one branch")
        .length("parent_at", splines.parent_at, branches, "one for each branch")
        .length("level", splines.level, branches, "one for each branch")
        .length("first_point", splines.first_point, branches + 1, "one for each branch, and the end")
        .length("radius", splines.radius, points, "one for each point")
        .length("leaf_at", splines.leaf_at, leaves, "one for each leaf")
        .length("leaf_position", splines.leaf_position, leaves, "one for each leaf")
        .length("leaf_rotation", splines.leaf_rotation, leaves, "one for each leaf")
        .length("leaf_length", splines.leaf_length, leaves, "one for each leaf")
        .length("leaf_width", splines.leaf_width, leaves, "one for each leaf")
        .length("leaf_kind", splines.leaf_kind, splines.leaf_kind.empty() ? 0 : leaves, "none, or one for each leaf")
        .length("leaf_count", splines.leaf_count, splines.leaf_count.empty() ? 0 : leaves, "none, or one for each leaf")
        .length("fruit_at", splines.fruit_at, fruits, "one for each fruit")
        .length("fruit_position", splines.fruit_position, fruits, "one for each fruit")
        .length("fruit_center", splines.fruit_center, fruits, "one for each fruit")
        .length("fruit_radius", splines.fruit_radius, fruits, "one for each fruit");
    if (rules.defect) return rules.defect;

    const auto& first = splines.first_point;
    rules.rule(splines.bodies >= 0, "bodies", -1,
               "is " + std::to_string(splines.bodies) + ", expected 0 (as many as come) or more");
    rules.parents(splines.parent)
        .between("parent_at", splines.parent_at, 0, 1)
        .not_negative("level", splines.level)
        .rule(first.front() == 0, "first_point", 0, "is " + std::to_string(first.front()) + ", expected 0")
        .each(
            "first_point", first,
            [&](std::size_t b, std::int32_t p) { return b == 0 || std::int64_t(p) - first[b - 1] >= 2; },
            [&](std::size_t b, std::int32_t p) {
                return "is " + std::to_string(p) + ", expected " + std::to_string(std::int64_t(first[b - 1]) + 2) +
                       " or more (a branch has at least two points)";
            })
        .rule(std::size_t(first.back()) == points, "first_point", std::int64_t(branches),
              "is " + std::to_string(first.back()) + ", expected the number of points, " + text(points))
        .lengths("point", splines.point)
        .between("radius", splines.radius, 0, largest_length)
        .index("leaf_branch", splines.leaf_branch, branches, "a branch")
        .between("leaf_at", splines.leaf_at, 0, 1)
        .lengths("leaf_position", splines.leaf_position)
        .unit("leaf_rotation", splines.leaf_rotation)
        .positive("leaf_length", splines.leaf_length, largest_length)
        .positive("leaf_width", splines.leaf_width, largest_length)
        .each(
            "leaf_kind", splines.leaf_kind, [](std::size_t, std::int32_t k) { return k == 0 || k == 1; },
            [](std::size_t, std::int32_t k) { return "is " + std::to_string(k) + ", expected 0 (leaf) or 1 (petal)"; });
    check_counts(rules, splines.leaf_count, [&](std::size_t k) { return !splines.is_petal(k); });
    rules.index("fruit_branch", splines.fruit_branch, branches, "a branch")
        .between("fruit_at", splines.fruit_at, 0, 1)
        .lengths("fruit_position", splines.fruit_position)
        .lengths("fruit_center", splines.fruit_center)
        .each(
            "fruit_center", splines.fruit_center,
            [&](std::size_t i, const Vec3& center) { return center != splines.fruit_position[i]; },
            [](std::size_t, const Vec3&) { return std::string("is the fruit's joint, expected a point off it"); })
        .positive("fruit_radius", splines.fruit_radius, largest_length);
    check_colors(rules, splines.color);
    return rules.defect;
}

std::optional<Defect> check(const Tree& tree) {
    Rules rules;
    const std::size_t n = tree.size_bodies();
    rules.rule(n > 0, "parent", -1, "is empty, expected at least one body");
    const auto length = [&](const char* name, const auto& absent, const auto& array) {
        using Absent = std::decay_t<decltype(absent)>;
        if constexpr (always_there<Absent>)
            rules.length(name, array, n, "one for each body");
        else if constexpr (std::is_same_v<Absent, AsLeafLength>)
            rules.length(name, array, tree.leaf_length.size(), "as many as /leaf_length");
        else if constexpr (!std::is_same_v<Absent, InNoDocument>) // a message names a document's field
            rules.length(name, array, array.empty() ? 0 : n, "none, or one for each body");
    };
    each_array(length, tree);
    if (rules.defect) return rules.defect;

    rules.parents(tree.parent)
        .each(
            "kind", tree.kind, [](std::size_t, Kind k) { return k <= Kind::petal; },
            [](std::size_t, Kind k) {
                return "is " + std::to_string(int(k)) + ", expected 0 (branch), 1 (leaf), 2 (fruit) or 3 (petal)";
            })
        .positive("mass", tree.mass)
        .lengths("com", tree.com)
        .all_finite("inertia", tree.inertia)
        .each(
            "inertia", tree.inertia, [](std::size_t, const Mat3& i) { return possible_inertia(i); },
            [](std::size_t, const Mat3& i) {
                const Vec3 m = Eigen::SelfAdjointEigenSolver<Mat3>(i, Eigen::EigenvaluesOnly).eigenvalues();
                return "has principal moments " + text(m[0]) + ", " + text(m[1]) + ", " + text(m[2]) +
                       ", which no body has, expected none negative and the two smaller to reach the largest";
            })
        .lengths("joint_position", tree.joint_position)
        .unit("joint_rotation", tree.joint_rotation);
    check_sizes(rules, "stiffness", tree.stiffness, 0);
    rules.between("damping", tree.damping, 0, unbounded);
    check_sizes(rules, "size", tree.size, 1);
    rules.lengths("size", tree.size);
    rules.not_negative("branch", tree.branch).not_negative("level", tree.level).between("s", tree.s, 0, 1);
    rules.each(
        "rigid", tree.rigid, [](std::size_t, std::uint8_t r) { return r <= 1; },
        [](std::size_t, std::uint8_t r) {
            return "is " + std::to_string(int(r)) + ", expected 0 (its joint moves) or 1 (it is rigid)";
        });
    check_counts(rules, tree.leaf_count, [&](std::size_t i) { return is_flat(tree.kind[i]); });
    rules.between("leaf_length", tree.leaf_length, 0, largest_length)
        .between("leaf_width", tree.leaf_width, 0, largest_length)
        .between("leaf_facing", tree.leaf_facing, 0, 1)
        .between("drag", tree.drag, 0, unbounded);
    check_colors(rules, tree.color);
    return rules.defect;
}

} // namespace bough

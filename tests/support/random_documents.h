// random_documents.h: valid documents full of awkward numbers, and helpers to write and read them in tests.
#pragma once
#include "formats/open.h"
#include "lib/model/motion.h"
#include "lib/model/scene.h"
#include "lib/model/splines.h"
#include "lib/model/tree_arrays.h"
#include "replaced.h"
#include <bit>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <unistd.h>

namespace bough::test {

// A folder of this test's own, removed afterwards.
struct Folder {
    std::filesystem::path path;
    Folder() {
        std::string name = (std::filesystem::temp_directory_path() / "bough-test-XXXXXX").string();
        path = ::mkdtemp(name.data());
    }
    ~Folder() { std::filesystem::remove_all(path); }
    std::string operator/(const std::string& name) const { return (path / name).string(); }
    std::size_t files() const {
        return std::size_t(
            std::distance(std::filesystem::directory_iterator(path), std::filesystem::directory_iterator()));
    }
};

inline void put(const std::filesystem::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

// What `write(Output&)` writes.
template <class Write> std::string written(Write write) {
    const Folder folder;
    Output output(folder / "document");
    write(output);
    output.finish();
    return read_input(folder / "document");
}

// What an InputError says, "" where nothing is thrown.
template <class Read> std::string error_of(Read read) {
    try {
        read();
    } catch (const InputError& e) {
        return e.what();
    }
    return "";
}

struct Random {
    std::mt19937_64 engine{20};

    // Any finite double but for its size: signs, subnormal ones, zeros of both signs, extremes.
    double any() {
        for (;;) {
            const double value = std::bit_cast<double>(engine());
            switch (engine() % 16) {
            case 0:
                return -0.0;
            case 1:
                return 0.0;
            case 2:
                return std::numeric_limits<double>::denorm_min();
            case 3:
                return std::numeric_limits<double>::max();
            case 4:
                return 1;
            case 5:
                return 9007199254740993.0;
            default:
                if (std::isfinite(value)) return value;
            }
        }
    }
    double length() { // as a document may hold it, up to its largest
        const double value = any();
        return std::abs(value) <= 1e15 ? value : std::copysign(1e15, value);
    }
    Vec3 place() { return {length(), length(), length()}; }
    double size() { return std::max(std::abs(length()), std::numeric_limits<double>::denorm_min()); }
    double positive() { return std::max(std::abs(any()), std::numeric_limits<double>::denorm_min()); }
    double fraction() { return std::generate_canonical<double, 53>(engine); }
    Vec3 vector() { return {any(), any(), any()}; }
    Quat rotation() {
        return Quat(fraction() - 0.5, fraction() - 0.5, fraction() - 0.5, fraction() + 0.1).normalized();
    }
    std::int32_t below(std::size_t count) { return std::int32_t(engine() % count); }
};

// A body's inertia with uneven digits: that of three masses on turned axes.
inline Mat3 random_inertia(Random& random) {
    const Mat3 r = random.rotation().toRotationMatrix();
    const Mat3 moments = r * Vec3(random.fraction() + 0.1, random.fraction() + 0.1, 1e-7).asDiagonal() * r.transpose();
    const Mat3 inertia = moments.trace() * Mat3::Identity() - moments;
    return 0.5 * (inertia + inertia.transpose());
}

inline Tree random_tree(std::size_t bodies, Random& random) {
    Tree t;
    t.resize(bodies);
    for (std::size_t i = 0; i < bodies; ++i) {
        t.parent[i] = i == 0 ? -1 : random.below(i + 1) - 1;
        t.kind[i] = Kind(random.below(3));
        t.mass[i] = random.positive();
        t.com[i] = random.place();
        t.inertia[i] = random_inertia(random);
        t.joint_position[i] = random.place();
        t.joint_rotation[i] = random.rotation();
        t.stiffness[i] = random.vector().cwiseAbs();
        t.damping[i] = std::abs(random.any());
        t.size[i] = {random.size(), std::abs(random.length()), 0};
        t.branch[i] = random.below(1u << 31);
        t.level[i] = random.below(9);
        t.s[i] = random.fraction();
        const bool leaf = t.kind[i] == Kind::leaf;
        t.leaf_count.push_back(leaf ? 1 + random.below(2000) : 1);
        t.leaf_length.push_back(leaf ? random.fraction() : 0);
        t.leaf_width.push_back(leaf ? random.fraction() : 0);
        t.leaf_facing.push_back(random.fraction());
        t.drag.push_back(random.fraction());
    }
    t.name = "Weide \xc3\xa4 \"quoted\" \\ \n\t\x01 \xf0\x9f\x8c\xb3";
    t.source = "treegen --seed 7\ntreeconvert -";
    return t;
}

inline Splines random_splines(std::size_t branches, Random& random) {
    Splines s;
    s.first_point.push_back(0);
    for (std::size_t b = 0; b < branches; ++b) {
        s.parent.push_back(b == 0 ? -1 : random.below(b + 1) - 1);
        s.parent_at.push_back(random.fraction());
        s.level.push_back(random.below(5));
        const int points = 2 + random.below(4);
        for (int i = 0; i < points; ++i) {
            s.point.push_back(random.place());
            s.radius.push_back(std::abs(random.length()));
        }
        s.first_point.push_back(std::int32_t(s.points()));
        s.leaf_branch.push_back(random.below(branches));
        s.leaf_at.push_back(random.fraction());
        s.leaf_position.push_back(random.place());
        s.leaf_rotation.push_back(random.rotation());
        s.leaf_length.push_back(random.size());
        s.leaf_width.push_back(random.size());
        s.leaf_kind.push_back(random.below(2));
        s.leaf_count.push_back(s.leaf_kind.back() == 1 ? 1 : 1 + random.below(2000));
        if (b % 2 == 0) continue;
        s.fruit_branch.push_back(random.below(branches));
        s.fruit_at.push_back(random.fraction());
        s.fruit_position.push_back(Vec3(1, 2, 3));
        s.fruit_center.push_back(Vec3(1, 2, random.fraction()));
        s.fruit_radius.push_back(random.size());
    }
    for (int i = 0; i < 4; ++i) s.color.push_back({random.fraction(), random.fraction(), random.fraction()});
    s.material = "black-willow";
    s.source = "test";
    return s;
}

inline RootMotion random_root_motion(std::int32_t tree, std::size_t keys, bool position, bool rotation,
                                     Random& random) {
    RootMotion m;
    m.tree = tree;
    for (std::size_t k = 0; k < keys; ++k) {
        m.time.push_back(random.fraction() + double(k));
        if (position) m.position.push_back(random.place());
        if (rotation) m.rotation.push_back(random.rotation());
    }
    return m;
}

inline JointLimit random_joint_limit(Random& random) {
    const auto angles = [&] { return Vec3(180 * (1 - random.fraction()), 180 * (1 - random.fraction()), 180); };
    return {angles(), angles(), angles()};
}

inline Motion random_motion(const MotionFields& fields, std::int64_t bodies, std::int64_t frames, Random& random) {
    Motion motion;
    motion.header.bodies = bodies;
    motion.header.fps = 24;
    motion.header.fields = fields;
    motion.header.name = "oak";
    motion.header.balls = bodies > 2 ? 2 : 0;
    motion.header.events = true;
    const auto vectors = [&](std::vector<Vec3>& to, bool wanted) {
        for (std::int64_t i = 0; wanted && i < bodies; ++i) to.push_back(random.vector());
    };
    for (std::int64_t f = 0; f < frames; ++f) {
        MotionFrame frame;
        frame.frame = 5 + f;
        frame.time = double(f) / 24;
        vectors(frame.position, fields.pose);
        for (std::int64_t i = 0; fields.pose && i < bodies; ++i) frame.rotation.push_back(random.rotation());
        vectors(frame.velocity, fields.velocity);
        vectors(frame.angular_velocity, fields.velocity);
        vectors(frame.torque, fields.torque);
        vectors(frame.theta, fields.angles);
        vectors(frame.theta_dot, fields.angles);
        for (std::int64_t i = 0; fields.stress && i < bodies; ++i) frame.stress.push_back(random.vector().x());
        for (std::int64_t k = 0; bodies > 2 && k < f % 3; ++k) // frames without events among those with
            frame.events.add(k == 0  ? "broke"
                             : f % 2 ? "hit"
                                     : "landed",
                             (7 * f + k) % bodies, k == 0 ? -1 : k, random.vector().x());
        motion.frame.push_back(frame);
    }
    return motion;
}

// Equal bit by bit: 0 and -0 differ.
inline bool same(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}
inline bool same(const Vec3& a, const Vec3& b) {
    return same(a.x(), b.x()) && same(a.y(), b.y()) && same(a.z(), b.z());
}
inline bool same(const Mat3& a, const Mat3& b) {
    return same(Vec3(a.col(0)), Vec3(b.col(0))) && same(Vec3(a.col(1)), Vec3(b.col(1))) &&
           same(Vec3(a.col(2)), Vec3(b.col(2)));
}
inline bool same(const Quat& a, const Quat& b) {
    return same(Vec3(a.vec()), Vec3(b.vec())) && same(a.w(), b.w());
}
template <class T>
requires std::is_integral_v<T> || std::is_enum_v<T>
bool same(T a, T b) {
    return a == b;
}
bool same(const MotionFrame& a, const MotionFrame& b);
template <class T> bool same(const std::vector<T>& a, const std::vector<T>& b) {
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (!same(a[i], b[i])) return false;
    return true;
}

inline bool same(const Tree& a, const Tree& b) {
    bool all = a.name == b.name && a.material == b.material && a.source == b.source && same(a.color, b.color);
    each_array([&](const char*, const auto&, const auto& x, const auto& y) { all = all && same(x, y); }, a, b);
    return all;
}

inline bool same(const Splines& a, const Splines& b) {
    return same(a.parent, b.parent) && same(a.parent_at, b.parent_at) && same(a.level, b.level) &&
           same(a.first_point, b.first_point) && same(a.point, b.point) && same(a.radius, b.radius) &&
           same(a.leaf_branch, b.leaf_branch) && same(a.leaf_at, b.leaf_at) && same(a.leaf_position, b.leaf_position) &&
           same(a.leaf_rotation, b.leaf_rotation) && same(a.leaf_length, b.leaf_length) &&
           same(a.leaf_width, b.leaf_width) && same(a.fruit_branch, b.fruit_branch) && same(a.fruit_at, b.fruit_at) &&
           same(a.fruit_position, b.fruit_position) && same(a.fruit_center, b.fruit_center) &&
           same(a.fruit_radius, b.fruit_radius) && same(a.leaf_kind, b.leaf_kind) && same(a.leaf_count, b.leaf_count) &&
           same(a.color, b.color) && a.material == b.material && a.name == b.name && a.source == b.source;
}

inline bool same(const RootMotion& a, const RootMotion& b) {
    return a.tree == b.tree && same(a.time, b.time) && same(a.position, b.position) && same(a.rotation, b.rotation);
}

inline bool same(const JointLimit& a, const JointLimit& b) {
    return same(a.branch, b.branch) && same(a.leaf, b.leaf) && same(a.fruit, b.fruit);
}

inline bool same(const MotionFrame& a, const MotionFrame& b) {
    return a.frame == b.frame && same(a.time, b.time) && same(a.position, b.position) && same(a.rotation, b.rotation) &&
           same(a.velocity, b.velocity) && same(a.angular_velocity, b.angular_velocity) && same(a.torque, b.torque) &&
           same(a.theta, b.theta) && same(a.theta_dot, b.theta_dot) && same(a.stress, b.stress) &&
           a.events.what == b.events.what && a.events.body == b.events.body && a.events.on == b.events.on &&
           same(a.events.value, b.events.value);
}

inline bool same(const Motion& a, const Motion& b) {
    const MotionFields &f = a.header.fields, &g = b.header.fields;
    return same(a.header.fps, b.header.fps) && a.header.bodies == b.header.bodies && a.header.balls == b.header.balls &&
           a.header.name == b.header.name && a.header.source == b.header.source && f.pose == g.pose &&
           f.velocity == g.velocity && f.torque == g.torque && f.angles == g.angles && f.stress == g.stress &&
           same(a.frame, b.frame);
}

} // namespace bough::test

#include "../base/fnv.h"
#include "../laws/air.h"
#include "../laws/leaf_air.h"
#include "world.h"
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace bough {
namespace {

void put(std::vector<double>& out, const Vec3& v) {
    out.insert(out.end(), v.data(), v.data() + 3);
}
void put(std::vector<double>& out, const Quat& q) {
    out.insert(out.end(), q.coeffs().data(), q.coeffs().data() + 4);
}

// Numbers one after the other; running out of them is an error, as a number that is no index is.
class Reader {
public:
    explicit Reader(const std::vector<double>& numbers) : numbers_(numbers) {}
    double real() {
        if (at_ == numbers_.size()) throw std::invalid_argument("ends early");
        return numbers_[at_++];
    }
    std::size_t index(std::size_t below, const char* of) {
        const double x = real();
        if (!(x >= 0 && x < double(below) && x == std::floor(x)))
            throw std::invalid_argument("entry " + std::to_string(at_ - 1) + " is " + std::to_string(x) +
                                        ", expected " + of + ", 0 to less than " + std::to_string(below));
        return std::size_t(x);
    }
    Vec3 vector() {
        Vec3 v;
        for (int k = 0; k < 3; ++k) v[k] = real();
        return v;
    }
    Quat quaternion() {
        Quat q;
        for (int k = 0; k < 4; ++k) q.coeffs()[k] = real();
        return q;
    }
    void finish() const {
        if (at_ != numbers_.size())
            throw std::invalid_argument("has " + std::to_string(numbers_.size()) + " numbers, expected " +
                                        std::to_string(at_));
    }

private:
    const std::vector<double>& numbers_;
    std::size_t at_ = 0;
};

void put(std::vector<double>& out, const FreeMotion& m) {
    put(out, m.x);
    put(out, m.q);
    put(out, m.v);
    put(out, m.omega);
}

FreeMotion read_motion(Reader& in) {
    FreeMotion m;
    m.x = in.vector();
    m.q = in.quaternion();
    m.v = in.vector();
    m.omega = in.vector();
    return m;
}

} // namespace

template <class T> std::uint64_t state_hash(const Plan<T>& plan, const State<T>& state, const World<T>& world) {
    const std::uint64_t trees = state_hash(plan, state);
    if (!world.on()) return trees;
    Fnv hash(trees);
    for (const std::uint32_t joint : world.broken) hash.add(joint);
    for (const FreeBody& free : world.free) {
        std::vector<double> numbers;
        put(numbers, free.motion);
        for (const double x : numbers) hash.add(x);
    }
    return hash.value();
}

template <class T> std::vector<double> saved_world(const State<T>& state, const World<T>& world) {
    std::vector<double> out;
    if (!world.on()) return out;
    out.push_back(double(state.loads.size()));
    for (const Load<T>& load : state.loads) {
        out.push_back(double(load.body));
        put(out, Vec3(load.point_b.template cast<double>()));
        put(out, Vec3(load.force.template cast<double>()));
    }
    out.push_back(double(world.broken.size()));
    for (const std::uint32_t joint : world.broken) out.push_back(double(joint));
    out.push_back(double(world.free.size()));
    for (const FreeBody& free : world.free) {
        put(out, free.motion);
        out.push_back(free.at_rest);
        out.push_back(free.quiet);
        if (free.ball()) continue;
        out.push_back(free.mass);
        for (int k = 0; k < 9; ++k) out.push_back(free.inertia(k / 3, k % 3));
        out.push_back(double(free.parts.size()));
        for (const FreePart& part : free.parts) {
            out.push_back(double(part.body));
            put(out, part.q);
            put(out, part.joint);
            put(out, part.com);
        }
    }
    return out;
}

template <class T>
void restore_world(Plan<T>& plan, State<T>& state, World<T>& world, const std::vector<double>& saved) {
    if (!world.on()) {
        if (!saved.empty()) throw std::invalid_argument("is not empty, but nothing is free in this scene");
        return;
    }
    const Tree& tree = *world.tree;
    const std::size_t n = tree.size_bodies();
    Reader in(saved);
    const std::size_t loads = in.index(saved.size() + 1, "a number of forces");
    for (std::size_t k = 0; k < loads; ++k) {
        const std::size_t body = in.index(n, "a body");
        const Vec3 point = in.vector(), force = in.vector();
        state.loads.push_back({body, point.template cast<T>(), force.template cast<T>()});
    }
    const std::size_t breaks = in.index(n + 1, "a number of joints");
    for (std::size_t k = 0; k < breaks; ++k) world.broken.push_back(std::uint32_t(in.index(n, "a body")));
    const std::size_t bodies = in.index(n + world.balls + 1, "a number of free bodies");
    if (bodies != world.balls + breaks)
        throw std::invalid_argument("has " + std::to_string(bodies) + " free bodies, expected " +
                                    std::to_string(world.balls + breaks));
    for (std::size_t k = 0; k < bodies; ++k) {
        if (k >= world.balls) world.free.emplace_back();
        FreeBody& free = world.free[k];
        free.motion = read_motion(in);
        free.at_rest = in.real() != 0;
        free.quiet = in.real();
        if (k < world.balls) continue;
        free.mass = in.real();
        for (int e = 0; e < 9; ++e) free.inertia(e / 3, e % 3) = in.real();
        const std::size_t parts = in.index(n + 1, "a number of bodies");
        if (parts == 0) throw std::invalid_argument("a free body of no bodies");
        for (std::size_t p = 0; p < parts; ++p) {
            FreePart part;
            part.body = std::int64_t(in.index(n, "a body"));
            part.kind = tree.kind[std::size_t(part.body)];
            part.size = tree.size[std::size_t(part.body)];
            part.q = in.quaternion();
            part.joint = in.vector();
            part.com = in.vector();
            part.drag_area =
                drag_area(tree, std::size_t(part.body), part.kind, plan.scene.air_density, plate_kappa(plan.scene));
            free.parts.push_back(part);
        }
        finish(free);
    }
    in.finish();
    world.near.forget();
    if (world.broken.empty()) return;
    if (!plan.scene.fracture) throw std::invalid_argument("has broken joints, but this scene has no fracture");
    detach(plan, state, world.subtrees, world.broken, world.remaining);
    std::erase_if(world.breakable, [&](const Breakable& joint) { return world.remaining.gone[joint.body] != 0; });
    if (!plan.contact) return;
    world.response.make(plan, tree, world.subtrees);
    world.rigid.make(plan, tree, world.subtrees, false);
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template std::uint64_t state_hash(const Plan<T>&, const State<T>&, const World<T>&);                               \
    template std::vector<double> saved_world(const State<T>&, const World<T>&);                                        \
    template void restore_world(Plan<T>&, State<T>&, World<T>&, const std::vector<double>&);
#include "../base/instantiate.inc"

} // namespace bough

#include "fingerprint.h"
#include "../base/fnv.h"

namespace bough {
namespace {

// Fields and lengths in a fixed order.
struct Fingerprint {
    Fnv hash;
    void add(std::uint64_t bits) { hash.add(bits); }
    void add(double value) { hash.add(value); }
    void add(const Vec3& v) {
        for (int k = 0; k < 3; ++k) add(v[k]);
    }
    void add(const Tree& tree) {
        add(std::uint64_t(tree.size_bodies()));
        for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
            add(std::uint64_t(tree.parent[i]));
            add(std::uint64_t(tree.kind[i]));
            add(tree.mass[i]);
            add(tree.com[i]);
            for (int k = 0; k < 9; ++k) add(tree.inertia[i](k / 3, k % 3));
            add(tree.joint_position[i]);
            for (int k = 0; k < 4; ++k) add(tree.joint_rotation[i].coeffs()[k]);
            add(tree.stiffness[i]);
            add(tree.damping[i]);
            add(tree.size[i]);
            add(std::uint64_t(tree.branch[i]));
            add(std::uint64_t(tree.level[i]));
            add(tree.s[i]);
            if (!tree.rigid.empty()) add(std::uint64_t(tree.rigid[i])); // how the air meets it (reduce.h)
        }
        for (const double load : tree.load) add(load);
        for (const std::int32_t leaves : tree.leaf_count) add(std::uint64_t(leaves)); // a clump has an air of its own
        for (const double facing : tree.leaf_facing) add(facing);
        for (const double drag : tree.drag) add(drag);
    }
    void add(const Wind& w) {
        add(w.velocity);
        for (const double value : {w.reference_height, w.profile, w.turbulence, w.gust_factor, w.gust_period})
            add(value);
        add(w.seed);
        // What is absent adds nothing, so that the runs without it keep their fingerprints.
        if (w.grid) add(*w.grid);
        if (w.swirl) add(*w.swirl);
        if (w.shelter) add_named(3, {w.shelter->cell});
        if (w.period) add_named(4, {*w.period});
    }
    void add_named(std::uint64_t name, const std::vector<double>& values) {
        add(name);
        add(std::uint64_t(values.size()));
        for (const double value : values) add(value);
    }
    void add(const WindGrid& g) {
        add_named(1, {g.x, g.z, g.cell, double(g.columns), double(g.rows), g.frequency});
        add(std::uint64_t(g.velocity.size()));
        for (const Vec3& v : g.velocity) add(v);
        add_named(0, std::vector<double>(g.octaves.begin(), g.octaves.end()));
        add_named(0, g.persistence);
        add_named(0, g.phase);
    }
    void add(const WindSwirl& s) {
        add_named(2, {s.x, s.z, s.period, s.wavelength.value_or(0)});
        add_named(0, s.radius);
        add_named(0, s.angle);
    }
    void add(const Selector& on) {
        for (const std::int64_t value :
             {std::int64_t(on.by), std::int64_t(on.tree), on.body, std::int64_t(on.branch), std::int64_t(on.level)})
            add(std::uint64_t(value));
        add(on.at);
        add(on.nearest);
        if (on.point) add(*on.point);
    }
    void add(const Pull& pull) {
        add(pull.on);
        add(std::uint64_t(pull.time.size()));
        for (const double t : pull.time) add(t);
        for (const Vec3& f : pull.force) add(f);
        if (pull.in_body) add_named(11, {});
    }
    void add(const Attachment& held) {
        add(held.on);
        add_named(8, {held.stiffness, held.damping, held.from, held.to, double(held.target.has_value())});
        if (held.with) {
            add_named(10, {});
            add(*held.with);
        }
        if (held.target) add(*held.target);
        add_named(0, held.time);
        for (const Vec3& p : held.position) add(p);
    }
    void add(const RootMotion& motion) {
        for (const std::int64_t value : {std::int64_t(motion.tree), std::int64_t(motion.time.size()),
                                         std::int64_t(motion.position.size()), std::int64_t(motion.rotation.size())})
            add(std::uint64_t(value));
        for (const double t : motion.time) add(t);
        for (const Vec3& p : motion.position) add(p);
        for (const Quat& q : motion.rotation)
            for (int k = 0; k < 4; ++k) add(q.coeffs()[k]);
    }
    void add(const Scene& s) {
        add(s.gravity);
        for (std::size_t k = 0; k < s.trees.size(); ++k)
            if (s.trees[k].start != 0) add_named(6, {double(k), s.trees[k].start});
        add(std::uint64_t(s.wind.has_value()));
        if (s.wind) add(*s.wind);
        add(std::uint64_t(s.pulls.size()));
        for (const Pull& pull : s.pulls) add(pull);
        add(std::uint64_t(s.root_motion.size()));
        for (const RootMotion& motion : s.root_motion) add(motion);
        for (const double value : {s.air_density, s.stiffness_scale, s.damping_scale}) add(value);
        add(std::uint64_t(s.pose));
        add(std::uint64_t(s.joint_inertia));
        if (s.joint_limit)
            for (const Vec3& most : {s.joint_limit->branch, s.joint_limit->leaf, s.joint_limit->fruit}) add(most);
        // Parts that came later add nothing where they are absent: older states stay good.
        if (s.fracture) add(*s.fracture);
        for (const Ball& ball : s.balls) add(ball);
        if (s.contact) add(*s.contact);
        for (const Walker& walker : s.walkers) add(walker);
        for (const Attachment& held : s.attachments) add(held);
        if (s.leaves)
            for (const double value :
                 {s.leaves->kappa, s.leaves->air_resistance, s.leaves->drag_ratio, s.leaves->offset})
                add(value);
        if (s.fictitious) // /wood and /load are in the tree
            add_named(5, {s.fictitious->acceleration, s.fictitious->turning, s.fictitious->gyroscopic});
    }
    void add(const Walker& walker) {
        add_named(7, {walker.mass, walker.push}); // its radius is only seen
        add(std::uint64_t(walker.stops.size()));
        for (const Walker::Stop& stop : walker.stops) {
            add(stop.on);
            add(stop.time);
            add(std::uint64_t(stop.leap));
        }
    }
    void add(const Fracture& f) {
        for (const double value : {f.branch, f.leaf, f.petal, f.fruit, f.strength, f.spread}) add(value);
        add(f.seed);
        for (const Fracture::Joint& joint : f.joints) {
            add(joint.on);
            add(joint.torque);
        }
    }
    void add(const Ball& ball) {
        for (const Vec3& v : {ball.position, ball.velocity, ball.angular_velocity}) add(v);
        for (const double value : {ball.radius, ball.mass}) add(value);
    }
    void add(const Contact& c) {
        for (const double value : {c.restitution, c.friction, c.rolling, c.penalty, c.ground_height}) add(value);
        for (const bool flag : {c.model == ContactModel::penalty, c.trees, c.leaves, c.ground})
            add(std::uint64_t(flag));
    }
};

} // namespace

std::uint64_t fingerprint(const Tree& joined, const Scene& scene) {
    Fingerprint f;
    f.add(joined);
    f.add(scene);
    return f.hash.value();
}

} // namespace bough

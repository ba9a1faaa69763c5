// rigid_error.h: what holding joints rigid (reduce.h) moves the ends of a tree by: the tips of its branches (trajectory.h) as the whole tree has them
// and as its reduced one takes them, compared frame by frame. Leaves and fruit are not compared: what flutters is chaotic.
#pragma once
#include "../plan/expand.h"
#include <vector>

namespace bough {

struct RigidError {
    double rms = 0, worst = 0; // [m] over tips and frames
    double deflection = 0;     // [m] RMS of the whole tree's tips from where they are drawn
    double height = 0;         // [m] of the drawn tree above its lowest root
    std::int64_t frames = 0;
    std::size_t tips = 0;
};

class RigidComparison {
public:
    // Keeps a reference to the tree.
    explicit RigidComparison(const Tree& whole);
    const std::vector<std::size_t>& tips() const { return tips_; }

    // [m] The tips of a state, into `to`, its poses up to date: of the whole tree, or of the reduced one.
    template <class T> void tips_of(const State<T>& whole, std::vector<Vector3<float>>& to) const;
    template <class T>
    void tips_of(const Reduced&, const Plan<T>&, const State<T>&, std::vector<Vector3<float>>& to) const;

    // One frame. Returns its largest distance [m].
    double compare(const std::vector<Vector3<float>>& whole, const std::vector<Vector3<float>>& reduced);
    RigidError result() const;
    // [m^2] Largest squared distance of each tip.
    const std::vector<double>& worst_of_tips() const { return worst_; }

private:
    const Tree& tree_;
    std::vector<std::size_t> tips_;
    std::vector<Vec3> drawn_;   // [m] the tips
    std::vector<double> worst_; // [m^2]
    double squares_ = 0, deflection_squares_ = 0;
    RigidError found_;
};

} // namespace bough

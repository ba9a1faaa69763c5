#include "tip_position.h"
#include "ground.h"

namespace bough {

template <class T> Vec3 tip_position(const Plan<T>& plan, const State<T>& state, const Tree& tree, std::size_t body) {
    const Vec3 x = end_position(state, tree, body);
    const Ground* ground = plan.root_motion ? ground_of(plan, state, body) : nullptr;
    return ground ? Vec3(ground->R.transpose() * (x - ground->x)) : x;
}

template Vec3 tip_position(const Plan<float>&, const State<float>&, const Tree&, std::size_t);
template Vec3 tip_position(const Plan<double>&, const State<double>&, const Tree&, std::size_t);

} // namespace bough

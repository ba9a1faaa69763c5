// math.cpp: what is not a template, and out of the header for the compiler's time: Eigen's turn of two vectors brings a
// singular value decomposition, several seconds in each source that includes it.
#include "math.h"

namespace bough {

Quat shortest_turn(const Vec3& from, const Vec3& to) {
    return Quat(Eigen::Quaterniond::FromTwoVectors(from, to));
}

Quat least_turn(const Quat& near, const Vec3& axis) {
    const Vec3 z = near * Vec3::UnitZ();
    const Eigen::Quaterniond turn(shortest_turn(z, axis));
    return Quat((turn * Eigen::Quaterniond(near)).normalized());
}

} // namespace bough

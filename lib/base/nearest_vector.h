// nearest_vector.h: finds, of the many rotation vectors of one rotation, the one nearest to another, so that whole turns are kept.
#pragma once
#include "math.h"

namespace bough {

// Returns the rotation vector [rad] of a unit quaternion that is nearest to `before`. It lies along the quaternion's axis or, where it has none
// (within 1e-6 rad of a whole turn), along before's.
Vec3 nearest_vector(const Quat&, const Vec3& before);

} // namespace bough

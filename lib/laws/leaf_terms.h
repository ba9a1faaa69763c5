// leaf_terms.h: the numbers that (23) and (24) take from a scene's LeafAir, in the precision of a run. They have a header of their own, so that code
// that knows nothing of Eigen can carry them.
#pragma once

namespace bough {

template <class T> struct LeafTerms {
    bool on = false;
    T across = 0, along = 0; // [1/s] nu, nu / xi
    T most = 0;              // [1/s] the larger of the two
    T torque = 0;            // [m^3/2/kg^1/2] k over (kappa rho A)^3/2
    T cos_offset = 1, sin_offset = 0;
};

} // namespace bough

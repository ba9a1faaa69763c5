// field_shape.h: where the cells and rings of a wind over the ground stand (wind_field.h), in the precision of a run. It is a header of its own, so
// that code that knows nothing of Eigen can carry it.
#pragma once
#include <cstdint>

namespace bough {

template <class T> struct FieldShape {
    // Grid
    T x = 0, z = 0, per_metre = 0;                 // [m] least corner; [1/m] cells a metre
    std::int32_t columns = 1, rows = 1, cells = 1; // cells: of one clock
    // Swirl
    T center_x = 0, center_z = 0, rings_per_metre = 0; // [m]; [1/m] entries a metre
    std::int32_t rings = 0;                            // of one clock
};

} // namespace bough

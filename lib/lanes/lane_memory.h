// lane_memory.h: rows and records (layout.h) as the steps in lanes fill them from outside the sweeps.
#pragma once
#include "../base/math.h"
#include "row.h"
#include "sweep_rows.h"

namespace bough::fast {

template <class T> T* data(RowVector<T>& rows) {
    return rows.empty() ? nullptr : rows.front().lane;
}

// One value of one record.
template <class T> T& entry(RowVector<T>& rows, std::size_t joint, int count, int quantity) {
    return data(rows)[joint * record(count, Row<T>::lanes) + std::size_t(quantity)];
}

// Returns an element of a state's array in document order; zero where the array is left out.
template <class T> Vector3<T> entry(const std::vector<Vector3<T>>& array, std::size_t body) {
    return array.empty() ? Vector3<T>(Vector3<T>::Zero()) : array[body];
}

template <class T> void put(T (&to)[3], const Vec3& v) {
    for (int k = 0; k < 3; ++k) to[k] = T(v[k]);
}

// One body's lane in rows of `count` quantities.
template <class T> class Slot {
public:
    Slot(RowVector<T>& rows, int count, std::size_t slot)
        : at(&rows[slot / lanes * std::size_t(count)].lane[slot % lanes]) {}
    T& operator[](int quantity) const { return at[std::size_t(quantity) * lanes]; }
    void put(int quantity, T value) const { (*this)[quantity] = value; }
    void put(int quantity, const Vector3<T>& v) const {
        for (int k = 0; k < 3; ++k) put(quantity + k, v[k]);
    }
    void put(int quantity, const Matrix3<T>& m) const { // symmetric
        constexpr int place[6][2] = {{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}};
        for (int k = 0; k < 6; ++k) put(quantity + k, m(place[k][0], place[k][1]));
    }
    Vector3<T> vector(int quantity) const { return {(*this)[quantity], (*this)[quantity + 1], (*this)[quantity + 2]}; }

private:
    static constexpr std::size_t lanes = Row<T>::lanes;
    T* at;
};

} // namespace bough::fast

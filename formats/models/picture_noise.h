// picture_noise.h: noise that repeats, for pictures that tile.
#pragma once
#include "lib/growth/random.h"
#include <algorithm>
#include <cmath>
#include <cstdint>

namespace bough {

inline int wrapped(int k, int period) {
    const int r = k % period;
    return r < 0 ? r + period : r;
}

// 0..1, of a lattice's point.
inline double lattice_value(int x, int y, int seed) {
    return double(mix_bits((std::uint64_t(std::uint32_t(x)) << 32 | std::uint32_t(y)) ^
                           mix_bits(std::uint64_t(std::uint32_t(seed)) * 0x9e3779b97f4a7c15u)) >>
                  11) *
           0x1p-53;
}

// Gradient noise, about -1..1, at (x, y) of a lattice that repeats after `px` and `py` points.
inline double gradient_noise(double x, double y, int px, int py, int seed) {
    const double fx = std::floor(x), fy = std::floor(y);
    const int ix = int(fx), iy = int(fy);
    const double tx = x - fx, ty = y - fy;
    const auto corner = [&](int dx, int dy) {
        const int kx = wrapped(ix + dx, px), ky = wrapped(iy + dy, py);
        const double gx = 2 * lattice_value(kx, ky, seed) - 1, gy = 2 * lattice_value(kx, ky, seed + 7919) - 1;
        return gx * (tx - dx) + gy * (ty - dy);
    };
    const auto fade = [](double t) { return t * t * t * (t * (6 * t - 15) + 10); };
    const double wx = fade(tx), wy = fade(ty);
    const double low = corner(0, 0) + wx * (corner(1, 0) - corner(0, 0));
    const double high = corner(0, 1) + wx * (corner(1, 1) - corner(0, 1));
    return 1.5 * (low + wy * (high - low));
}

// Octaves of it over the unit square, which repeat with it: frequencies fx, fy and their doubles, each half as strong.
inline double octaves(double u, double v, int fx, int fy, int count, int seed) {
    double sum = 0, weight = 1;
    for (int k = 0; k < count; ++k, fx *= 2, fy *= 2, weight /= 2)
        sum += weight * gradient_noise(u * fx, v * fy, fx, fy, seed + 101 * k);
    return sum;
}

inline double smooth_step(double from, double to, double x) {
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

} // namespace bough

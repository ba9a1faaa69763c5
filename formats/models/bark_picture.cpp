#include "lib/base/parallel.h"
#include "picture.h"
#include "picture_noise.h"
#include <array>

namespace bough {
namespace {

int whole(double x) {
    return std::max(1, int(std::lround(x)));
}

// The distances to a jittered lattice's two nearest points, and the nearest's number; repeats with the unit square.
struct Cell {
    double first, second, number;
};
Cell cell_of(double u, double v, int nx, int ny, double jitter, int seed) {
    const double x = u * nx, y = v * ny;
    const int ix = int(std::floor(x)), iy = int(std::floor(y));
    Cell cell{9, 9, 0};
    for (int dy = -2; dy <= 2; ++dy)
        for (int dx = -2; dx <= 2; ++dx) {
            const int kx = wrapped(ix + dx, nx), ky = wrapped(iy + dy, ny);
            const double ox = ix + dx + 0.5 + jitter * (lattice_value(kx, ky, seed) - 0.5);
            const double oy = iy + dy + 0.5 + jitter * (lattice_value(kx, ky, seed + 1) - 0.5);
            const double d = std::hypot(x - ox, y - oy);
            if (d < cell.first)
                cell = {d, cell.first, lattice_value(kx, ky, seed + 2)};
            else
                cell.second = std::min(cell.second, d);
        }
    return cell;
}

// Height 0..1, and by how much the colour there differs from what the height gives.
struct Relief {
    double height, tint;
};

// Ridges that run up the stem, part and meet, with furrows between.
Relief furrowed(const BarkForm& f, double u, double v) {
    const int nx = whole(f.cells), ny = whole(f.cells / f.stretch);
    const double warp = 0.35 / nx * octaves(u, v, nx / 2 + 1, 2 * ny, 3, 11);
    const double n = octaves(u + warp, v, nx, ny, 3, 3);
    const double ridge = smooth_step(0.0, 0.26, std::abs(n));
    // The ridges' own grain, fissures across them, and crumbs.
    const double grain = octaves(u + warp, v, 5 * nx, 3 * ny, 3, 29);
    const double across = smooth_step(0.02, 0.10, std::abs(octaves(u + 2 * warp, v, nx, 5 * ny, 3, 47)));
    const double crumbs = octaves(u, v, 12 * nx, 10 * ny, 2, 61);
    const double height = ridge * (0.62 + 0.22 * across + 0.16 * smooth_step(0.1, 0.6, std::abs(n)));
    return {std::clamp(height + 0.10 * grain + 0.07 * crumbs, 0.0, 1.0), 0.10 * grain + 0.05 * crumbs};
}

// Plates with cracks between, each of its own height and shade, flaking in layers.
Relief plated(const BarkForm& f, double u, double v) {
    const int nx = whole(f.cells), ny = whole(f.cells / f.stretch);
    const double wu = 0.30 / nx * octaves(u, v, 2 * nx, 2 * ny, 3, 13),
                 wv = 0.30 / ny * octaves(u, v, 2 * nx, 2 * ny, 3, 17);
    const Cell cell = cell_of(u + wu, v + wv, nx, ny, 0.9, 5);
    const double plate = smooth_step(0.02, 0.20, cell.second - cell.first);
    const double layers = octaves(u, v, 2 * nx, 5 * ny, 3, 31);
    const double flake = std::floor(3 * (layers + 1)) / 6;
    return {std::clamp(plate * (0.55 + 0.25 * cell.number + 0.25 * flake) + 0.06 * octaves(u, v, 8 * nx, 8 * ny, 2, 41),
                       0.0, 1.0),
            0.22 * (cell.number - 0.5) + 0.08 * layers};
}

// Marks that lie across the stem: how deep one is here, 0..1.
double marks(double u, double v, int nx, int ny, double length, double share, int seed) {
    const double y = v * ny;
    const int iy = int(std::floor(y));
    double deep = 0;
    for (int dy = -1; dy <= 1; ++dy) {
        const int ky = wrapped(iy + dy, ny);
        const double shift = lattice_value(0, ky, seed + 9), x = (u + shift) * nx;
        const int ix = int(std::floor(x));
        for (int dx = -1; dx <= 1; ++dx) {
            const int kx = wrapped(ix + dx, nx);
            if (lattice_value(kx, ky, seed) > share) continue;
            const double l = length * (0.4 + lattice_value(kx, ky, seed + 1));
            const double ox = ix + dx + 0.5 + 0.6 * (lattice_value(kx, ky, seed + 2) - 0.5);
            const double oy = iy + dy + 0.5 + 0.7 * (lattice_value(kx, ky, seed + 3) - 0.5);
            const double d = std::hypot((x - ox) / (0.5 * l), (y - oy) / 0.22);
            deep = std::max(deep, 1 - smooth_step(0.6, 1.0, d));
        }
    }
    return deep;
}

// Thin bark that peels across the stem, with dark lenticels and scars.
Relief papery(const BarkForm& f, double u, double v) {
    const int n = whole(f.cells);
    const double streaks = octaves(u, v, 3, 6 * n, 3, 7);
    const double lenticels = marks(u, v, n, 6 * n, 0.9, 0.45, 19);
    const double place = octaves(u, v, 3, 2, 2, 53);
    const double scar = smooth_step(0.34, 0.52, place + 0.25 * octaves(u, v, 2 * n, 3 * n, 3, 59));
    const double peel = smooth_step(0.25, 0.3, octaves(u, v, 2, n, 3, 67));
    const double height =
        0.86 + 0.10 * streaks - 0.05 * peel - 0.72 * std::max(lenticels, scar * (0.75 + 0.3 * streaks));
    return {std::clamp(height, 0.0, 1.0), 0.04 * streaks + 0.03 * peel};
}

// Smooth bark that shines, ringed by bands of lenticels.
Relief banded(const BarkForm& f, double u, double v) {
    const int n = whole(f.cells);
    const double streaks = octaves(u, v, 3, 10 * n, 3, 7);
    const double wide = marks(u, v, whole(n / 2.0), 3 * n, 1.3, 0.55, 23),
                 small = marks(u, v, 2 * n, 7 * n, 0.9, 0.3, 31);
    const double band = std::max(wide, 0.6 * small);
    const double crack = smooth_step(0.35, 0.6, octaves(u, v, 3, 3, 4, 71));
    return {std::clamp(0.62 + 0.12 * streaks + 0.30 * band - 0.45 * crack, 0.0, 1.0), 0.06 * streaks + 0.16 * band};
}

// Scars of fallen leaves around the stem, fibres between.
Relief ringed(const BarkForm& f, double u, double v) {
    const int n = whole(f.cells);
    const double y = n * v + 0.18 * octaves(u, v, 4, n, 2, 3);
    const double t = y - std::floor(y), row = lattice_value(wrapped(int(std::floor(y)), n), 0, 5);
    const double fibre = octaves(u, v, 40, 3 * n, 3, 13);
    const double edge = smooth_step(0, 0.10, t) * (1 - 0.55 * smooth_step(0.12, 0.95, t));
    return {std::clamp(0.15 + 0.65 * edge + 0.12 * fibre + 0.12 * (row - 0.5), 0.0, 1.0),
            0.07 * fibre + 0.10 * (row - 0.5)};
}

Relief relief(const BarkForm& f, double u, double v) {
    if (f.pattern == "plated") return plated(f, u, v);
    if (f.pattern == "papery") return papery(f, u, v);
    if (f.pattern == "banded") return banded(f, u, v);
    if (f.pattern == "ringed") return ringed(f, u, v);
    return furrowed(f, u, v);
}

std::uint8_t shade(double x) {
    return std::uint8_t(
        std::clamp(std::lround(x * 255 / 4) * 4, 0L, 255L)); // 64 steps, which compress to half of what 256 do
}

// The relief over the unit square, as pixels.
struct ReliefField {
    int size;
    std::vector<Relief> pixel;
    const Relief& at(int x, int y) const {
        return pixel[std::size_t(wrapped(y, size)) * std::size_t(size) + std::size_t(wrapped(x, size))];
    }
    // The mean height of a block of them.
    double height(int x, int y, int block) const {
        double sum = 0;
        for (int dy = 0; dy < block; ++dy)
            for (int dx = 0; dx < block; ++dx) sum += at(block * x + dx, block * y + dy).height;
        return sum / (block * block);
    }
};

Picture colors(const ReliefField& field, const BarkForm& form, const Vec3& bark) {
    Picture made{field.size, 3, {}};
    for (const Relief& here : field.pixel) {
        const double dark = 1 - form.depth * (1 - here.height), light = (0.20 + 0.92 * dark) * (1 + here.tint);
        for (int c = 0; c < 3; ++c) made.pixel.push_back(shade(bark[c] * light));
    }
    return made;
}

// One for each block of so many pixels on a side.
Picture normals(const ReliefField& field, const BarkForm& form, int block) {
    Picture made{field.size / block, 3, {}};
    const double steep =
        0.05 * form.depth * made.size / std::sqrt(form.cells / 4); // of a height of 1, in the picture's pixels
    for (int y = 0; y < made.size; ++y)
        for (int x = 0; x < made.size; ++x) {
            const Vec3 normal(-steep * (field.height(x + 1, y, block) - field.height(x - 1, y, block)) / 2,
                              -steep * (field.height(x, y - 1, block) - field.height(x, y + 1, block)) / 2, 1);
            for (int c = 0; c < 3; ++c) made.pixel.push_back(shade((normal.normalized()[c] + 1) / 2));
        }
    return made;
}

} // namespace

BarkPictures bark_pictures(const BarkForm& form, const Vec3& bark, int size) {
    ReliefField field{size, std::vector<Relief>(std::size_t(size) * std::size_t(size))};
    constexpr double pixel_ns = 500;
    parallel_for(std::size_t(size), pixel_ns * size, [&](std::size_t y) {
        for (int x = 0; x < size; ++x)
            field.pixel[y * std::size_t(size) + std::size_t(x)] =
                relief(form, (x + 0.5) / size, 1 - (double(y) + 0.5) / size);
    });
    return {colors(field, form, bark), normals(field, form, size > 256 ? 2 : 1)};
}

} // namespace bough

#include "weld.h"
#include <limits>

namespace bough {
namespace {

// Cells are larger than the tolerance, so that few points lie so close to an edge that a neighbour must be asked, and
// small enough that one holds no more than some thousand points which are not welded.
constexpr double cell_per_tolerance = 16;
constexpr std::size_t ahead = 16; // points whose cells are fetched from memory while others are looked at

// Cells by their three numbers, each a list of points.
class Cells {
public:
    Cells(std::size_t points, double edge) : edge_(edge), next_(points, -1) {
        while (std::size_t(1) << (64 - shift_) < points + points / 2) --shift_;
        head_.assign(std::size_t(1) << (64 - shift_), -1);
    }
    // The number of a cell along an axis.
    std::int64_t number(double x) const {
        const double n = x / edge_;
        const auto cut = std::int64_t(n);
        return cut - (double(cut) > n);
    }
    std::int32_t& head(std::int64_t x, std::int64_t y, std::int64_t z) {
        const std::uint64_t h = std::uint64_t(x) * 0x9E3779B97F4A7C15u ^ std::uint64_t(y) * 0xC2B2AE3D27D4EB4Fu ^
                                std::uint64_t(z) * 0x165667B19E3779F9u;
        return head_[((h ^ h >> 29) * 0xBF58476D1CE4E5B9u) >> shift_];
    }
    std::int32_t& head(const Vec3& p) { return head(number(p.x()), number(p.y()), number(p.z())); }
    std::int32_t next(std::int32_t i) const { return next_[i]; }
    void add(std::int32_t i, const Vec3& p) {
        std::int32_t& first = head(p);
        next_[i] = first;
        first = i;
    }

private:
    double edge_;
    int shift_ = 60; // of a hash, so that as many bits are left as the table has
    std::vector<std::int32_t> head_, next_;
};

} // namespace

double weld_tolerance(const std::vector<Vec3>& point) {
    if (point.empty()) return 0;
    Vec3 low = point.front(), high = low;
    for (const Vec3& p : point) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    const double extent = (high - low).maxCoeff();
    const double far = std::max(low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff());
    return std::max(1e-6 * extent, double(std::numeric_limits<float>::epsilon()) * far);
}

std::vector<std::int32_t> weld(std::vector<Vec3>& point, double tolerance) {
    std::vector<std::int32_t> index(point.size());
    // An edge of at least this keeps cell numbers within 64 bits.
    Cells cells(point.size(), std::max(cell_per_tolerance * tolerance, std::numeric_limits<double>::min()));
    std::int32_t kept = 0;
    for (std::size_t i = 0; i < point.size(); ++i) {
        if (i + ahead < point.size()) __builtin_prefetch(&cells.head(point[i + ahead]));
        const Vec3 p = point[i];
        std::int64_t low[3], high[3];
        for (int axis = 0; axis < 3; ++axis) {
            low[axis] = cells.number(p[axis] - tolerance);
            high[axis] = cells.number(p[axis] + tolerance);
        }
        std::int32_t found = -1;
        for (std::int64_t x = low[0]; x <= high[0]; ++x)
            for (std::int64_t y = low[1]; y <= high[1]; ++y)
                for (std::int64_t z = low[2]; z <= high[2]; ++z)
                    for (std::int32_t k = cells.head(x, y, z); k >= 0; k = cells.next(k))
                        if ((found < 0 || k < found) && (point[k] - p).squaredNorm() <= tolerance * tolerance)
                            found = k;
        if (found < 0) {
            found = kept++;
            point[found] = p;
            cells.add(found, p);
        }
        index[i] = found;
    }
    point.resize(kept);
    return index;
}

} // namespace bough

#include "weld.h"
#include <array>
#include <limits>

namespace bough {
namespace {

// Cells are larger than the tolerance, so that few points lie so close to an edge that a neighbour must be asked, and
// small enough that one holds no more than some hundred points which are not welded.
constexpr double cell_per_tolerance = 8;

class Cells {
public:
    Cells(std::size_t points, double edge) : edge_(edge), next_(points, -1) {
        std::size_t size = 16;
        while (size < 2 * points) size *= 2;
        head_.assign(size, -1);
    }
    std::array<std::int64_t, 3> cell(const Vec3& p) const {
        return {std::int64_t(std::floor(p.x() / edge_)), std::int64_t(std::floor(p.y() / edge_)),
                std::int64_t(std::floor(p.z() / edge_))};
    }
    std::int32_t& head(const std::array<std::int64_t, 3>& c) {
        std::uint64_t h = std::uint64_t(c[0]) * 0x9E3779B97F4A7C15u ^ std::uint64_t(c[1]) * 0xC2B2AE3D27D4EB4Fu ^
                          std::uint64_t(c[2]) * 0x165667B19E3779F9u;
        h ^= h >> 29;
        h *= 0xBF58476D1CE4E5B9u;
        h ^= h >> 32;
        return head_[h & (head_.size() - 1)];
    }
    std::int32_t next(std::int32_t i) const { return next_[i]; }
    void add(std::int32_t i, const Vec3& p) {
        std::int32_t& first = head(cell(p));
        next_[i] = first;
        first = i;
    }

private:
    double edge_;
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
    const Vec3 reach = Vec3::Constant(tolerance);
    for (std::size_t i = 0; i < point.size(); ++i) {
        const Vec3 p = point[i];
        const auto low = cells.cell(p - reach), high = cells.cell(p + reach);
        std::int32_t found = -1;
        for (std::int64_t x = low[0]; x <= high[0]; ++x)
            for (std::int64_t y = low[1]; y <= high[1]; ++y)
                for (std::int64_t z = low[2]; z <= high[2]; ++z)
                    for (std::int32_t k = cells.head({x, y, z}); k >= 0; k = cells.next(k))
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

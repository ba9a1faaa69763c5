#include "stem.h"
namespace bough {
bool grow_sapling(const GrowthParameters&, std::uint64_t, const Items&, std::int64_t, Splines&) {
    return false;
}
} // namespace bough

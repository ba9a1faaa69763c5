#include "made_with.h"
#include "lib/lanes/target.h"

namespace bough {

const char* bough_version() {
    return BOUGH_VERSION;
}
const char* compiler_name() {
    return BOUGH_COMPILER;
}
const char* compiler_flags() {
    return BOUGH_FLAGS;
}
const char* simd_target() {
    const std::optional<fast::Target> best = fast::best_target();
    return best ? fast::target_name(*best) : "off";
}

} // namespace bough

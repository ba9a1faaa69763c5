#include "caches.h"
#include <algorithm>
#include <unistd.h>

namespace bough {
namespace {

#ifdef _SC_LEVEL3_CACHE_SIZE
std::size_t size_of(int name) {
    const long size = ::sysconf(name);
    return size > 0 ? std::size_t(size) : 0;
}
#endif

} // namespace

std::size_t last_cache() {
#ifdef _SC_LEVEL3_CACHE_SIZE
    return std::max({size_of(_SC_LEVEL4_CACHE_SIZE), size_of(_SC_LEVEL3_CACHE_SIZE), core_cache()});
#else
    return 0;
#endif
}

std::size_t core_cache() {
#ifdef _SC_LEVEL3_CACHE_SIZE
    return size_of(_SC_LEVEL2_CACHE_SIZE);
#else
    return 0;
#endif
}

} // namespace bough

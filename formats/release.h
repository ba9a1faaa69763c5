// release.h: memory of arrays given back before they go out of scope, where a large file has no room to hold them longer.
#pragma once
#include <vector>

namespace bough {

// `array = {}` and clear() would keep it.
template <class... T> void release(std::vector<T>&... array) {
    (std::vector<T>().swap(array), ...);
}

} // namespace bough

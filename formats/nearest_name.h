// nearest_name.h: which known name was meant by one that is unknown.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace bough {

// The one of `names` that is fewest edits from `word`, the first of several, if these are at most `most`; else "". An edit adds, takes or replaces
// a letter, or swaps two that stand side by side (optimal string alignment). Capital letters are small ones. O(letters^2) a name.
std::string nearest_name(std::string_view word, const std::vector<std::string>& names, std::size_t most);

} // namespace bough

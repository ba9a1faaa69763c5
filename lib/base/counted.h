// counted.h: a count with what it counts, in singular or plural: "1 point repeats", "3 points repeat".
#pragma once
#include <concepts>
#include <string>
#include <string_view>

namespace bough {

std::string counted(std::integral auto count, std::string_view one, std::string_view many) {
    return std::to_string(count) + " " + std::string(count == 1 ? one : many);
}

} // namespace bough

#include "document_parts.h"
#include <cstring>

namespace bough {

// An exponent of all ones is infinity or NaN. Without a branch a number, so that the compiler takes several at once.
bool all_finite(const double* values, std::size_t count) {
    constexpr std::uint64_t exponent = 0x7ff0000000000000u;
    std::uint64_t found = 0;
    for (std::size_t i = 0; i < count; ++i) {
        std::uint64_t bits;
        std::memcpy(&bits, values + i, sizeof bits);
        found |= std::uint64_t((bits & exponent) == exponent);
    }
    return found == 0;
}

void require_finite(const Output& output, const std::string& field, const std::vector<double>& values,
                    std::size_t first) {
    if (all_finite(values.data(), values.size())) return;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (!std::isfinite(values[i]))
            throw OutputError(output.name(), "/" + field + "/" + std::to_string(first + i) +
                                                 " is not finite, and documents hold finite numbers only");
}

} // namespace bough

#include "nearest_name.h"
#include "plain_text.h"
#include <algorithm>
#include <utility>

namespace bough {
namespace {

std::size_t edits(const std::string& a, const std::string& b) {
    std::vector<std::size_t> before(b.size() + 1), row(b.size() + 1), next(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        next[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            next[j] = std::min({row[j - 1] + (a[i - 1] != b[j - 1]), row[j] + 1, next[j - 1] + 1});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                next[j] = std::min(next[j], before[j - 2] + 1);
        }
        before.swap(row);
        row.swap(next);
    }
    return row[b.size()];
}

} // namespace

std::string nearest_name(std::string_view word, const std::vector<std::string>& names, std::size_t most) {
    const std::string meant = lower_case(word);
    std::size_t least = most;
    const std::string* nearest = nullptr;
    for (const std::string& name : names)
        if (const std::size_t count = edits(meant, lower_case(name)); count < least + !nearest) {
            least = count;
            nearest = &name;
        }
    return nearest ? *nearest : std::string();
}

} // namespace bough

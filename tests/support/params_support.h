// params_support.h: what the tests of other programs' parameters share.
#pragma once
#include "formats/parameters/growth_params.h"
#include "tests/support/grow_measure.h"
#include "tests/support/import_support.h"
#include <numeric>

namespace bough::test {

struct Read {
    GrowthParameters growth;
    std::string notes;
};

inline Read read_params(const std::string& content, const std::string& name) {
    ParameterNotes notes;
    Read result{read_growth_parameters(content, name, notes), {}};
    for (const std::string& line : notes.lines()) result.notes += line + "\n";
    return result;
}

inline Splines grown(const GrowthParameters& p, std::uint64_t seed, bool leaves = true) {
    Splines s = grow(p, seed, {leaves, leaves, false});
    const auto defect = check(s);
    INFO((defect ? defect->field + " " + defect->message : ""));
    REQUIRE_FALSE(defect);
    return s;
}

inline double mean(const std::vector<double>& v) {
    return std::accumulate(v.begin(), v.end(), 0.0) / double(v.size());
}

inline double variance(const std::vector<double>& v) {
    double sum = 0;
    for (const double x : v) sum += (x - mean(v)) * (x - mean(v));
    return sum / double(v.size() - 1);
}

// Four standard errors of the difference of two means.
inline void same_mean(const std::vector<double>& a, const std::vector<double>& b) {
    CAPTURE(mean(a), mean(b));
    CHECK(std::abs(mean(a) - mean(b)) <=
          4 * std::sqrt(variance(a) / double(a.size()) + variance(b) / double(b.size())));
}

// Stems that did not split off another of their level.
inline std::vector<std::size_t> whole_stems(const Splines& s, int level) {
    std::vector<std::size_t> result;
    for (const std::size_t b : measure::of_level(s, level))
        if (s.parent[b] < 0 || s.level[std::size_t(s.parent[b])] != level) result.push_back(b);
    return result;
}

} // namespace bough::test

#include "error_line.h"
#include "formatted.h"

namespace bough {
namespace {

// Two digits that count.
std::string rounded(double x) {
    return formatted(x >= 9.95 && x < 1e6 ? "%.0f" : "%.2g",
                     x >= 99.5 && x < 1e6 ? std::stod(formatted("%.1e", x)) : x);
}

std::string length(double metres) {
    return metres < 0.995 ? rounded(1000 * metres) + " mm" : rounded(metres) + " m";
}

} // namespace

std::string error_line(const TipError& e) {
    if (e.tips == 0) return "error unknown: there is no branch whose tip could be compared";
    if (!e.finite) return "error unknown: the same run at a quarter of the step became non-finite (--substeps)";
    if (e.samples == 0) return "error unknown: too few frames to compare";
    if (!(e.deflection > 1000 * e.rounding)) return "error none: no tip moves";
    if (!e.known())
        return "error unknown: at a quarter of the step the tips still swing to and fro by " + length(e.rough) +
               ", more than the two runs are apart: too coarse to tell (--substeps)";
    return "error up to about " + rounded(100 * e.rms / e.deflection) + " % of the tips' RMS deflection (" +
           length(e.rms) + "; worst " + length(e.worst) + "), estimated from the same run at a quarter of the step";
}

} // namespace bough

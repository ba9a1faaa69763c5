#include "error_line.h"
#include "formatted.h"
#include <limits>

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

std::string error_line(const TipError& e, bool in_float) {
    const double epsilon = in_float ? std::numeric_limits<float>::epsilon() : std::numeric_limits<double>::epsilon();
    if (e.tips == 0) return "error unknown: there is no branch whose tip could be compared";
    if (!e.finite) return "error unknown: the same run at twice the step became non-finite (--substeps)";
    if (e.samples == 0) return "error unknown: too few frames to compare";
    if (!(e.deflection > 1000 * epsilon * e.extent)) return "error none: no tip moves";
    const std::string found = rounded(100 * e.rms / e.deflection) + " % of the tips' RMS deflection (" + length(e.rms) +
                              "; worst " + length(e.worst) + ")";
    if (!e.resolved())
        return "error unknown: at twice the step the motion is another by " + found +
               ": too coarse to tell (--substeps), or chaotic";
    return "error up to about " + found + ", estimated from the same run at twice the step";
}

} // namespace bough

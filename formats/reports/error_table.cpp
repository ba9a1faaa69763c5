#include "error_report.h"
#include <array>
#include <charconv>
#include <cmath>

namespace bough {
namespace {

constexpr int wide = 9; // of a column of figures

std::string known(const std::string& text, double value) {
    return std::isfinite(value) ? text : "-";
}

std::string cell(double share) {
    std::string text = known(percent(share), share);
    if (text.size() > wide) { // as -1.62e-05%: one digit of it keeps the columns apart
        std::array<char, 32> digits;
        const auto end =
            std::to_chars(digits.data(), digits.data() + digits.size(), 100 * share, std::chars_format::scientific, 0);
        text = std::string(digits.data(), end.ptr) + "%";
    }
    return padded(text, wide + 1);
}

std::string summary(const ErrorReport& r) {
    return "bodies " + std::to_string(r.bodies) + ", tips " + std::to_string(r.tips) + ", height " + figure(r.height) +
           " m, tip deflection " + figure(r.rms_deflection) + " m RMS, " + figure(r.peak_deflection) +
           " m peak,\nfirst frequency " + known(figure(r.frequency) + " Hz", r.frequency) + ", decay " +
           known(figure(r.decay) + " /s", r.decay) + ", reference error " +
           known(percent(r.reference_error), r.reference_error) + " in " + figure(r.reference_seconds) +
           " s/s; frames " + std::to_string(r.frames) + " at " + figure(r.fps) + "/s\n";
}

std::string row(const ErrorRun& r, double reference_error) {
    std::string text = padded(steps_text(r.steps_per_frame), 6) +
                       padded(known(figure(r.seconds_per_simulated_second), r.seconds_per_simulated_second), wide + 1);
    if (!r.finite) return text + padded("non-finite", wide + 3) + "\n";
    const bool below = r.error_rms < reference_error; // it cannot be told how far
    text += padded(below ? "<" + percent(reference_error) : known(percent(r.error_rms), r.error_rms), wide + 1);
    for (const double share : {r.error_max, r.error_rms_peak, r.error_rms_height}) text += cell(share);
    const double degrees = r.error_angle * 180 / M_PI;
    text += padded(known(figure(degrees), degrees), wide);
    for (const double share : {r.error_frequency, r.error_decay, r.error_step, r.error_model, r.error_arithmetic})
        text += cell(share);
    return text + "\n";
}

} // namespace

std::string error_table(const ErrorReport& report) {
    std::string text = summary(report) + "\n steps" + padded("time", wide + 1);
    for (const char* name : {"rms", "max", "of peak", "of height"}) text += padded(name, wide + 1);
    text += padded("angle", wide);
    for (const char* name : {"frequency", "decay", "step", "model", "arithm."}) text += padded(name, wide + 1);
    text += "\n/frame" + padded("s/s", wide + 1) + padded("of RMS", wide + 1) + padded("of RMS", wide + 1) +
            padded("", 2 * (wide + 1)) + padded("deg", wide) + padded("", 2 * (wide + 1)) +
            padded("of RMS tip deflection", 3 * (wide + 1)) + "\n";
    for (const ErrorSeries& series : error_series(report)) {
        text += series.name + "\n";
        for (const ErrorRun* run : series.runs) text += row(*run, report.reference_error);
    }
    return text;
}

} // namespace bough

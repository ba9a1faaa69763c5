#include "error_report.h"
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <functional>

namespace bough {
namespace {

constexpr int wide = 9; // of a column of figures

std::string share_cell(double share) {
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
           " m peak,\nin these " + figure(double(r.frames) / r.fps) + " s from rest: first frequency " +
           known(figure(r.frequency) + " Hz", r.frequency) + ", decay " + known(figure(r.decay) + " /s", r.decay) +
           ", held against " + r.truth + ",\nits own error " + known(percent(r.reference_error), r.reference_error) +
           " rms, " + known(percent(r.reference_error_max), r.reference_error_max) + " max, in " +
           figure(r.reference_seconds) + " s/s; frames " + std::to_string(r.frames) + " at " + figure(r.fps) + "/s\n";
}

// One of the table's blocks: the same runs with other figures.
struct Block {
    std::string title;
    std::string names[2]; // two lines over the columns behind the steps
    std::string truth;    // a row of the truth itself, if it has one
    std::function<std::string(const ErrorRun&)> figures;
    std::function<bool(const ErrorRun&)> has = [](const ErrorRun&) { return true; };
};

std::string number_cell(double value) {
    return padded(known(figure(value), value), wide + 1);
}

std::string names_of(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += padded(name, wide + 1);
    return text;
}

double degrees(double angle) {
    return angle * 180 / M_PI;
}

Block tips_block(const ErrorReport& report) {
    Block b;
    b.names[0] = names_of({"time", "rms", "max", "rms", "max", "rms", "max", "angle", "frequency", "decay"});
    b.names[1] =
        names_of({"s/s", "of RMS", "of RMS", "of peak", "of peak", "of height", "of height", "deg rms", "", ""});
    b.figures = [&report](const ErrorRun& r) {
        std::string text = number_cell(r.seconds_per_simulated_second);
        if (!r.finite) return text + padded("non-finite", wide + 3);
        const bool below = r.error_rms < report.reference_error; // it cannot be told how far
        text +=
            padded(below ? "<" + percent(report.reference_error) : known(percent(r.error_rms), r.error_rms), wide + 1);
        for (const double share :
             {r.error_max, r.error_rms_peak, r.error_max_peak, r.error_rms_height, r.error_max_height})
            text += share_cell(share);
        return text + number_cell(degrees(r.error_angle)) + share_cell(r.error_frequency) + share_cell(r.error_decay);
    };
    return b;
}

Block parts_block() {
    Block b;
    b.title = "the tips' error in its parts, of their RMS deflection";
    b.names[0] = names_of({"step", "step", "model", "model", "arithm.", "arithm."});
    b.names[1] = names_of({"rms", "max", "rms", "max", "rms", "max"});
    b.figures = [](const ErrorRun& r) {
        std::string text;
        for (const double share : {r.error_step, r.error_step_max, r.error_model, r.error_model_max, r.error_arithmetic,
                                   r.error_arithmetic_max})
            text += share_cell(share);
        return text;
    };
    b.has = [](const ErrorRun& r) {
        return std::isfinite(r.error_step) || std::isfinite(r.error_model) || std::isfinite(r.error_arithmetic);
    };
    return b;
}

// As many levels as fit the width; the files have all.
Block wood_block(const ErrorReport& report) {
    const std::size_t levels = std::min<std::size_t>(4, report.level_deflection.size());
    Block b;
    b.title = "wood, point by point at its bodies' ends: of the peak of these ends' own deflection";
    std::vector<std::string> above = {"to 1", "to 1"}, below = {"rms", "max"};
    for (std::size_t k = 0; k < levels; ++k) {
        above.insert(above.end(), 2, "level " + std::to_string(k));
        below.insert(below.end(), {"rms", "max"});
    }
    b.names[0] = names_of(above);
    b.names[1] = names_of(below);
    b.figures = [levels](const ErrorRun& r) {
        std::string text = share_cell(r.error_wood.rms_peak) + share_cell(r.error_wood.max_peak);
        for (std::size_t k = 0; k < std::min(levels, r.error_level.size()); ++k)
            text += share_cell(r.error_level[k].rms_peak) + share_cell(r.error_level[k].max_peak);
        return text;
    };
    b.has = [](const ErrorRun& r) { return r.finite; };
    return b;
}

std::string motion_figures(const MotionSummary& m) {
    const LeafMotion& l = m.leaves;
    return number_cell(m.top.lean) + number_cell(m.top.spread) + number_cell(m.top.peak) +
           padded(std::to_string(m.still), wide - 2) + number_cell(degrees(l.spread.x())) +
           number_cell(degrees(l.spread.y())) + number_cell(degrees(l.spread.z())) + number_cell(degrees(l.turn)) +
           share_cell(l.fast);
}

Block motion_block(const ErrorReport& report) {
    Block b;
    b.title =
        "trunk's top: mean lean, standard deviation, peak; still frames; leaves: standard deviation, turn a frame";
    b.names[0] = names_of({"lean", "std", "peak"}) + padded("still", wide - 2) +
                 names_of({"flap", "sway", "twist", "turn", "above", "spectrum"});
    b.names[1] = names_of({"m", "m", "m"}) + padded("", wide - 2) +
                 names_of({"deg std", "deg std", "deg std", "deg", "30 deg", "off by"});
    b.truth = motion_figures(report.motion);
    b.figures = [](const ErrorRun& r) { return motion_figures(r.motion) + share_cell(r.error_spectrum); };
    b.has = [](const ErrorRun& r) { return r.motion.frames > 0; };
    return b;
}

std::string block_text(const Block& block, const std::vector<ErrorSeries>& series) {
    std::string text = "\n" + (block.title.empty() ? "" : block.title + "\n") + " steps" + block.names[0] + "\n/frame" +
                       block.names[1] + "\n";
    if (!block.truth.empty()) text += " truth" + block.truth + "\n";
    for (const ErrorSeries& s : series) {
        std::string rows;
        for (const ErrorRun* run : s.runs)
            if (block.has(*run)) rows += padded(steps_text(run->steps_per_frame), 6) + block.figures(*run) + "\n";
        if (!rows.empty()) text += s.name + "\n" + rows;
    }
    return text;
}

} // namespace

std::string error_table(const ErrorReport& report) {
    const std::vector<ErrorSeries> series = error_series(report);
    std::string text = summary(report) + block_text(tips_block(report), series);
    const auto any = [&](const Block& block) { return std::any_of(report.runs.begin(), report.runs.end(), block.has); };
    for (const Block& block : {parts_block(), wood_block(report), motion_block(report)})
        if (any(block)) text += block_text(block, series);
    for (std::size_t at; (at = text.find(" \n")) != std::string::npos;) text.erase(at, 1);
    return text;
}

} // namespace bough

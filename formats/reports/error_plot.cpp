#include "error_plot.h"
#include "error_motion_panel.h"
#include "gnuplot.h"
#include "lib/base/shortest_text.h"
#include "log_plot.h"
#include <algorithm>
#include <array>
#include <cmath>

namespace bough {
namespace {

// Hollow marks are points below the reference's error.
constexpr std::array<int, 5> full_marks = {7, 5, 9, 11, 13};
constexpr std::array<const char*, 3> part_colours = {"#0072b2", "#e69f00", "#888888"};

struct Style {
    const char* colour;
    int mark;
    int dash; // 1 solid for double, 2 for float
};

struct Point {
    double time, error;
    bool hollow;
    const ErrorRun* run;
};

struct Line {
    const ErrorSeries* series;
    Style style;
    std::vector<Point> points;
    std::string title; // with what could not be drawn
};

// The run's error, or the reference's where the run is below it.
bool make_point(const ErrorRun& run, double reference, Point& point) {
    if (!run.finite || !drawable(run.seconds_per_simulated_second) || !std::isfinite(run.error_rms)) return false;
    const bool below = std::isfinite(reference) && run.error_rms < reference;
    point = {run.seconds_per_simulated_second, below ? reference : run.error_rms, below, &run};
    return drawable(point.error);
}

std::string listed(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
    return text;
}

// What is drawn: every series of the report's first solver, of each other one its first alone. The rest are named.
std::vector<ErrorSeries> drawn(const std::vector<ErrorSeries>& all, std::string& left_out) {
    std::vector<ErrorSeries> some;
    std::vector<std::string> rest;
    const auto solver = [](const ErrorSeries& s) { return s.runs.front()->solver; };
    for (const ErrorSeries& series : all) {
        const bool first =
            std::none_of(some.begin(), some.end(), [&](const ErrorSeries& s) { return solver(s) == solver(series); });
        if (first || solver(series) == solver(all.front()))
            some.push_back(series);
        else
            rest.push_back(series.name);
    }
    for (const std::string& name : rest) left_out += (left_out.empty() ? "not drawn: " : "; ") + name;
    return some;
}

std::vector<Line> make_lines(const std::vector<ErrorSeries>& all, double reference) {
    std::vector<Line> lines;
    std::vector<std::string> methods;
    for (const ErrorSeries& series : all) {
        const std::size_t k = std::size_t(std::find(methods.begin(), methods.end(), series.method) - methods.begin());
        if (k == methods.size()) methods.push_back(series.method);
        Line line{&series, {colours[k % colours.size()], full_marks[k % full_marks.size()], 1}, {}, series.name};
        if (series.precision == "float") line.style.dash = 2;
        std::vector<std::string> broken, missing;
        for (const ErrorRun* run : series.runs) {
            Point point;
            if (make_point(*run, reference, point))
                line.points.push_back(point);
            else
                (run->finite ? missing : broken).push_back(steps_text(run->steps_per_frame));
        }
        if (!broken.empty()) line.title += "; non-finite at " + listed(broken);
        if (!missing.empty()) line.title += "; not measured at " + listed(missing);
        lines.push_back(std::move(line));
    }
    return lines;
}

// For gnuplot, which reads a decimal point.
struct Range {
    double low, high;
};

// Around the values, with a margin.
Range around(std::vector<double> values, Range empty) {
    values.erase(std::remove_if(values.begin(), values.end(), [](double v) { return !drawable(v); }), values.end());
    if (values.empty()) return empty;
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    return {*least / 1.8, *most * 1.8};
}

std::string range_text(Range r) {
    return "[" + shortest_text(r.low) + ":" + shortest_text(r.high) + "]";
}

// A block of points "$name" of the line: full or hollow ones; all of them as the line itself.
std::string block(const std::string& name, const Line& line, int which) {
    std::string text = "$" + name + " << END\n";
    for (const Point& p : line.points)
        if (which == 2 || p.hollow == (which == 1)) text += shortest_text(p.time) + " " + shortest_text(p.error) + "\n";
    return text + "END\n";
}

// Steps a frame beside the points of one step, which are ringed, and at both ends of a line (of the solid one of a
// method: the dashed one runs beside it).
std::string labels(const Line& line) {
    std::string text;
    for (const Point& p : line.points) {
        const bool one = p.run->steps_per_frame == 1, first = &p == &line.points.front();
        const bool end = line.style.dash == 1 && (first || &p == &line.points.back());
        if (!one && !end) continue;
        const std::string at = " at " + shortest_text(p.time) + "," + shortest_text(p.error) + " ";
        const std::string colour = std::string("rgb '") + line.style.colour + "' front\n";
        const char* place = one ? "center offset 0,1.1" : first ? "center offset 0,0.8" : "left offset 1,0";
        text += "set label " + gnuplot_text(steps_text(p.run->steps_per_frame)) + at + place +
                " font ',11' textcolor " + colour;
        if (one) text += "set label ''" + at + "point pt 6 ps 2.2 lw 1.5 lc " + colour;
    }
    return text;
}

std::string title(const ErrorReport& r) {
    return "Error against run time: " + std::to_string(r.bodies) + " bodies, " + std::to_string(r.tips) +
           " tips, first frequency " + (std::isfinite(r.frequency) ? figure(r.frequency) + " Hz" : "unknown") +
           "\\nrings: 1 step a frame of 1/" + figure(r.fps) + " s; figures: steps a frame; RMS tip deflection " +
           figure(r.rms_deflection) + " m of " + figure(r.height) + " m height";
}

std::string plot_panel(const ErrorReport& report, const std::vector<Line>& lines, const std::string& left_out,
                       int height) {
    std::vector<double> times, errors = {report.reference_error};
    for (const Line& line : lines)
        for (const Point& p : line.points) times.push_back(p.time), errors.push_back(p.error);
    const Range x = around(times, {1e-4, 1}), y = around(errors, {1e-4, 1});
    const bool reference = drawable(report.reference_error);
    const auto at = [&](double from_top) { return shortest_text(1 - from_top / height); };
    std::string text;
    for (std::size_t k = 0; k < lines.size(); ++k)
        for (int which = 0; which < 3; ++which)
            text += block("line" + std::to_string(k) + "_" + std::to_string(which), lines[k], which) +
                    (which == 0 ? labels(lines[k]) : "");
    text += "set title \"" + title(report) + "\"\n";
    text += "set lmargin at screen 0.09\nset rmargin at screen 0.965\nset tmargin at screen " + at(66) +
            "\nset bmargin at screen " + at(plot_height - 76) + "\n";
    text += "set logscale xy\nset format xy '%g'\nset xrange " + range_text(x) + "\nset yrange " + range_text(y) + "\n";
    text += "set xlabel 'run time [s] of one simulated second'\nset ylabel 'RMS error of tips / RMS tip deflection'\n";
    text += "set grid xtics ytics lc rgb '#c8c8c8' lw 0.6\nset border 3 lc rgb '#707070'\nset tics nomirror textcolor "
            "rgb 'black'\n";
    text += "set key at screen 0.09,screen " + at(plot_height - 8) + " left top Left reverse samplen 4 spacing 1.25\n";
    std::vector<std::string> plots;
    if (reference)
        plots.push_back(shortest_text(report.reference_error) + " with lines lw 2 dt 3 lc rgb '#707070' title " +
                        gnuplot_text("the reference's own error, " + percent(report.reference_error) +
                                     ": nothing below it is claimed"));
    for (std::size_t k = 0; k < lines.size(); ++k) {
        const Style& s = lines[k].style;
        const std::string name = "$line" + std::to_string(k) + "_", colour = std::string(" lc rgb '") + s.colour + "'";
        const bool any = !lines[k].points.empty();
        const std::string look =
            "dt " + std::to_string(s.dash) + " lw 2" + colour + " pt " + std::to_string(s.mark) + " ps 0.9";
        plots.push_back((any ? name + "2 with lines " : "NaN with lines ") + "dt " + std::to_string(s.dash) + " lw 2" +
                        colour + " notitle");
        plots.push_back("NaN with linespoints " + look + " title " + gnuplot_text(lines[k].title));
        const auto marks = [&](bool hollow) {
            if (std::none_of(lines[k].points.begin(), lines[k].points.end(),
                             [&](const Point& p) { return p.hollow == hollow; }))
                return;
            plots.push_back(name + (hollow ? "1" : "0") + " with points pt " +
                            std::to_string(s.mark - (hollow ? 1 : 0)) + (hollow ? " ps 1.1" : " ps 0.9") + colour +
                            " notitle");
        };
        marks(false);
        marks(true);
    }
    if (!left_out.empty()) plots.push_back("NaN with lines lc rgb 'white' title " + gnuplot_text(left_out));
    if (plots.empty()) plots.push_back("NaN notitle");
    text += "plot ";
    for (std::size_t k = 0; k < plots.size(); ++k) text += (k == 0 ? "" : ", \\\n  ") + plots[k];
    return text + "\n";
}

// The three parts at one step a frame, a group of bars a line.
std::string split_panel(const std::vector<Line>& lines, int height, int top, int bottom) {
    std::vector<const ErrorRun*> runs;
    std::vector<std::string> names;
    std::vector<double> parts;
    for (const Line& line : lines)
        for (const ErrorRun* run : line.series->runs)
            if (run->steps_per_frame == 1) {
                runs.push_back(run);
                names.push_back(line.series->name);
                for (const double part : {run->error_step, run->error_model, run->error_arithmetic})
                    parts.push_back(part);
            }
    Range x = around(parts, {1e-4, 1});
    x.low /= 3; // so that the least bar is seen
    std::string text =
        "unset label\nunset logscale y\nset logscale x\nset format x '%g'\nset format y '%g'\nunset ylabel\n";
    text += "unset title\nset label 'The error at 1 step a frame, in its parts' at screen 0.09,screen " +
            shortest_text(1 - double(top + 24) / height) + " left\nset key default\nset key at screen 0.965,screen " +
            shortest_text(1 - double(top + 16) / height) + " right top horizontal Left reverse samplen 1.5\n";
    text += "set lmargin at screen 0.33\nset tmargin at screen " + shortest_text(1 - double(top + 48) / height) +
            "\nset bmargin at screen " + shortest_text(1 - double(bottom - 58) / height) + "\n";
    text += "set xrange " + range_text(x) + "\nset yrange [" +
            shortest_text(double(std::max<std::size_t>(runs.size(), 1)) - 0.4) + ":-0.6]\n";
    text += "set xlabel 'RMS of tips / RMS tip deflection'\nset style fill solid 1.0 noborder\nunset ytics\n";
    std::string tics;
    for (std::size_t k = 0; k < runs.size(); ++k)
        tics += (k ? ", " : "") + gnuplot_text(names[k] + (runs[k]->finite ? "" : " (non-finite)")) + " " +
                std::to_string(k);
    if (!tics.empty()) text += "set ytics (" + tics + ") nomirror textcolor rgb 'black'\n";
    constexpr std::array<const char*, 3> part_names = {"time step", "model", "arithmetic"};
    std::string plots;
    for (std::size_t part = 0; part < 3; ++part) {
        const std::string name = "$part" + std::to_string(part);
        text += name + " << END\n";
        bool any = false;
        for (std::size_t k = 0; k < runs.size(); ++k) {
            const double value = parts[3 * k + part];
            if (!drawable(value)) continue;
            const double middle = double(k) + 0.25 * (double(part) - 1);
            text += shortest_text(x.low) + " " + shortest_text(middle) + " " + shortest_text(x.low) + " " +
                    shortest_text(value) + " " + shortest_text(middle - 0.1) + " " + shortest_text(middle + 0.1) + "\n";
            any = true;
        }
        text += "END\n";
        const std::string look =
            std::string(" lc rgb '") + part_colours[part] + "' title " + gnuplot_text(part_names[part]);
        plots += (plots.empty() ? "plot " : ", \\\n  ") +
                 (any ? name + " with boxxyerror" : std::string("NaN with boxes")) + look;
    }
    return text + plots + "\n";
}

} // namespace

std::string error_svg(const ErrorReport& report, const std::string& name) {
    std::string left_out;
    const std::vector<ErrorSeries> series = drawn(error_series(report), left_out);
    const std::vector<Line> lines = make_lines(series, report.reference_error);
    const int top = plot_height + key_line * (int(lines.size()) + (left_out.empty() ? 1 : 2)) + 20;
    const int bottom = top + 48 + 58 + std::max(70, 46 * int(lines.size()));
    const int height = bottom + motion_panel_height(report);
    std::vector<MotionMarks> marks;
    for (const Line& line : lines)
        for (const ErrorRun* run : line.series->runs)
            if (run->steps_per_frame == 1)
                marks.push_back({run, line.style.colour, line.style.mark - (line.style.dash == 2 ? 1 : 0)});
    return gnuplot_svg(
        "set multiplot\n" + plot_panel(report, lines, left_out, height) + split_panel(lines, height, top, bottom) +
            (height > bottom ? motion_panel(report, marks, height, bottom) : std::string()) + "unset multiplot\n",
        picture_width, height, name);
}

} // namespace bough

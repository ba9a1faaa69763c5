#include "gnuplot.h"
#include "lib/base/shortest_text.h"
#include "log_plot.h"
#include "scaling_report.h"
#include <algorithm>
#include <array>

namespace bough {
namespace {

constexpr std::array<int, 5> marks = {7, 5, 9, 11, 13};

// "$name": bodies, ns, of the runs that have such a figure. False where none has.
bool block(std::string& text, const std::string& name, const ScalingSeries& series, double ScalingRun::*figure) {
    std::string points;
    for (const ScalingRun* run : series.runs)
        if (drawable(run->*figure)) points += std::to_string(run->bodies) + " " + shortest_text(run->*figure) + "\n";
    if (!points.empty()) text += "$" + name + " << END\n" + points + "END\n";
    return !points.empty();
}

} // namespace

std::string scaling_svg(const ScalingReport& report, const std::string& name) {
    const std::vector<ScalingSeries> all = scaling_series(report);
    const int height = plot_height + key_line * int(all.size() + 1) + 20;
    const auto at = [&](double from_top) { return shortest_text(1 - from_top / height); };
    std::string text, plots;
    const auto plot = [&](const std::string& what) { plots += (plots.empty() ? "plot " : ", \\\n  ") + what; };
    for (std::size_t k = 0; k < all.size(); ++k) {
        const std::string colour = std::string(" lc rgb '") + colours[k % colours.size()] + "'";
        const std::string line = "measured" + std::to_string(k), limit = "limit" + std::to_string(k);
        const bool any = block(text, line, all[k], &ScalingRun::ns);
        plot((any ? "$" + line : std::string("NaN")) + " with linespoints lw 2 pt " +
             std::to_string(marks[k % marks.size()]) + " ps 0.9" + colour + " title " + gnuplot_text(all[k].name));
        if (block(text, limit, all[k], &ScalingRun::limit_ns))
            plot("$" + limit + " with lines lw 1 dt 3" + colour + " notitle");
    }
    plot("NaN with lines lw 1 dt 3 lc rgb '#707070' title 'dotted: what the machine needs at least for what is "
         "computed and moved'");
    std::string script = text;
    script += "set title \"Time a body and frame over the number of bodies\"\nset lmargin at screen 0.09\n"
              "set rmargin at screen 0.965\nset tmargin at screen " +
              at(46) + "\nset bmargin at screen " + at(plot_height - 76) + "\nset logscale xy\nset format xy '%g'\n";
    std::vector<double> x, y;
    for (const ScalingRun& run : report.runs) {
        x.push_back(double(run.bodies));
        for (const double value : {run.ns, run.limit_ns})
            if (drawable(value)) y.push_back(value);
    }
    const auto range = [](const std::vector<double>& values, double low, double high) {
        if (values.empty()) return "[" + shortest_text(low) + ":" + shortest_text(high) + "]";
        const auto [least, most] = std::minmax_element(values.begin(), values.end());
        return "[" + shortest_text(*least / 1.5) + ":" + shortest_text(*most * 1.5) + "]";
    };
    script += "set xrange " + range(x, 1000, 1e6) + "\nset yrange " + range(y, 1, 1000) +
              "\nset xlabel 'bodies'\nset ylabel 'ns a body and frame'\n"
              "set grid xtics ytics lc rgb '#c8c8c8' lw 0.6\nset border 3 lc rgb '#707070'\nset tics nomirror "
              "textcolor rgb 'black'\n"
              "set key at screen 0.09,screen " +
              at(plot_height - 8) + " left top Left reverse samplen 4 spacing 1.25\n";
    return gnuplot_svg(script + plots + "\n", picture_width, height, name);
}

} // namespace bough

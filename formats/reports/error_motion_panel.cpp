#include "error_motion_panel.h"
#include "gnuplot.h"
#include "lib/base/shortest_text.h"
#include "report_rows.h"
#include <algorithm>
#include <array>

namespace bough {
namespace {

constexpr int row_height = 22, head = 48, foot = 58; // pixels

struct Statistic {
    std::string name;
    double (*of)(const MotionSummary&, std::size_t level);
    std::size_t level = 0;
};

// Those that the truth has.
std::vector<Statistic> statistics_of(const MotionSummary& truth) {
    std::vector<Statistic> all = {{"trunk's top, mean lean", [](const auto& m, std::size_t) { return m.top.lean; }},
                                  {"its standard deviation", [](const auto& m, std::size_t) { return m.top.spread; }},
                                  {"its peak", [](const auto& m, std::size_t) { return m.top.peak; }}};
    for (std::size_t k = 0; k < truth.level_spread.size(); ++k)
        all.push_back({"wood of level " + std::to_string(k) + ", std",
                       [](const auto& m, std::size_t level) {
                           return level < m.level_spread.size() ? m.level_spread[level] : NAN;
                       },
                       k});
    all.push_back({"leaves' flap, std", [](const auto& m, std::size_t) { return m.leaves.spread.x(); }});
    all.push_back({"their sway, std", [](const auto& m, std::size_t) { return m.leaves.spread.y(); }});
    all.push_back({"their twist, std", [](const auto& m, std::size_t) { return m.leaves.spread.z(); }});
    all.push_back({"their turn a frame", [](const auto& m, std::size_t) { return m.leaves.turn; }});
    std::erase_if(all, [&](const Statistic& s) { return !(s.of(truth, s.level) > 0); });
    return all;
}

// For gnuplot, which reads a decimal point.
} // namespace

int motion_panel_height(const ErrorReport& report) {
    const std::size_t rows = statistics_of(report.motion).size();
    return rows == 0 ? 0 : head + foot + row_height * int(rows);
}

std::string motion_panel(const ErrorReport& report, const std::vector<MotionMarks>& marks, int height, int top) {
    const std::vector<Statistic> rows = statistics_of(report.motion);
    const auto from_top = [&](int pixels) { return shortest_text(1 - double(pixels) / height); };
    double low = 0.5, high = 2;
    std::string blocks, plots, tics;
    for (std::size_t k = 0; k < marks.size(); ++k) {
        const std::string name = "$motion" + std::to_string(k);
        std::string block;
        for (std::size_t row = 0; row < rows.size(); ++row) {
            const double share =
                rows[row].of(marks[k].run->motion, rows[row].level) / rows[row].of(report.motion, rows[row].level);
            if (!(share > 0) || !std::isfinite(share)) continue;
            low = std::min(low, share / 1.2);
            high = std::max(high, share * 1.2);
            block += shortest_text(share) + " " + std::to_string(row) + "\n";
        }
        if (block.empty()) continue;
        blocks += name + " << END\n" + block + "END\n";
        plots += ", \\\n  " + name + " with points pt " + std::to_string(marks[k].mark) + " ps 1 lc rgb '" +
                 marks[k].colour + "' notitle";
    }
    for (std::size_t row = 0; row < rows.size(); ++row)
        tics += (row ? ", " : "") + gnuplot_text(rows[row].name) + " " + std::to_string(row);
    return blocks +
           "unset label\nunset key\nset label 'Statistics at 1 step a frame, over those of the truth' at screen "
           "0.09,screen " +
           from_top(top + 24) +
           " left\nset lmargin at screen 0.33\nset rmargin at screen 0.965\nset tmargin at screen " +
           from_top(top + head) + "\nset bmargin at screen " + from_top(top + head + row_height * int(rows.size())) +
           "\nunset ytics\nset ytics (" + tics + ") nomirror textcolor rgb 'black'\nset yrange [" +
           shortest_text(double(rows.size()) - 0.4) + ":-0.6]\nset logscale x\nset xrange [" + shortest_text(low) +
           ":" + shortest_text(high) + "]\nset xlabel 'of the truth'\nset grid xtics ytics lc rgb '#c8c8c8' lw 0.6\n" +
           "set arrow 1 from 1,graph 0 to 1,graph 1 nohead lw 2 dt 3 lc rgb '#707070'\nplot NaN notitle" + plots +
           "\nunset arrow 1\n";
}

} // namespace bough

#include "modes_report.h"
#include "gnuplot.h"
#include "lib/base/counted.h"
#include "lib/base/shortest_text.h"
#include <algorithm>
#include <cmath>

namespace bough {
namespace {

constexpr double least_share = 1e-8; // of the tree's mass

std::string moves_name(std::size_t k, std::size_t count) {
    return k + 1 == count ? "hanging" : "level_" + std::to_string(k);
}

ReportRow row_of(const ModesReport& report, std::size_t k) {
    const NaturalMode& mode = report.modes[k];
    ReportRow row = {{"mode", std::int64_t(k + 1)},
                     {"frequency", mode.frequency},
                     {"damping", mode.damping},
                     {"damping_wood", mode.wood},
                     {"mass_x", mode.effective_mass.x()},
                     {"mass_y", mode.effective_mass.y()},
                     {"mass_z", mode.effective_mass.z()},
                     {"branch", std::int64_t(report.branch[k])},
                     {"level", std::int64_t(report.level[k])}};
    for (std::size_t l = 0; l < mode.share.size(); ++l)
        row.emplace_back("share_" + moves_name(l, mode.share.size()), mode.share[l]);
    return row;
}

ReportRow row_of(const BranchMotion& b) {
    return {{"branch", std::int64_t(b.branch)},
            {"level", std::int64_t(b.level)},
            {"x", b.way.x()},
            {"y", b.way.y()},
            {"z", b.way.z()},
            {"amplitude", b.way.norm()},
            {"share", b.share}};
}

std::vector<ReportRow> shapes_of(const ModesReport& report) {
    std::vector<ReportRow> rows;
    for (std::size_t k = 0; k < report.moves.size(); ++k)
        for (const BranchMotion& b : report.moves[k]) {
            rows.push_back({{"mode", std::int64_t(k + 1)}});
            for (auto& cell : row_of(b)) rows.back().push_back(std::move(cell));
        }
    return rows;
}

// CSV has one row a mode, so that its shape stands in columns.
ReportRow with_shape(const ModesReport& report, std::size_t k) {
    ReportRow row = row_of(report, k);
    for (std::size_t j = 0; j < report.moves[k].size(); ++j)
        for (auto& [name, value] : row_of(report.moves[k][j]))
            row.emplace_back("shape_" + std::to_string(j + 1) + "_" + name, std::move(value));
    return row;
}

std::vector<ReportRow> rows_of(const ModesReport& report) {
    std::vector<ReportRow> rows;
    for (std::size_t k = 0; k < report.modes.size(); ++k) rows.push_back(row_of(report, k));
    return rows;
}

// Masses far below the last digit of the greatest are rounding.
std::string mass_text(double share) {
    return std::abs(share) < least_share ? "0%" : percent(share);
}

} // namespace

std::string modes_table(const ModesReport& report) {
    std::string text = padded("mode", 4) + padded("Hz", 10) + padded("damping", 10) + padded("mass x", 12) +
                       padded("y", 12) + padded("z", 12) + "   who moves (kinetic energy)\n";
    for (std::size_t k = 0; k < report.modes.size(); ++k) {
        const NaturalMode& mode = report.modes[k];
        text +=
            padded(std::to_string(k + 1), 4) + padded(figure(mode.frequency), 10) + padded(percent(mode.damping), 10);
        for (int axis = 0; axis < 3; ++axis) text += padded(mass_text(mode.effective_mass[axis] / report.mass), 12);
        text += "   ";
        std::vector<std::size_t> order(mode.share.size());
        for (std::size_t l = 0; l < order.size(); ++l) order[l] = l;
        std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return mode.share[a] > mode.share[b]; });
        bool first = true;
        for (const std::size_t l : order) {
            if (mode.share[l] < 0.05 && !first) break;
            const std::string who = l + 1 == mode.share.size() ? "leaves and fruit"
                                    : l == 0                   ? "trunk"
                                                               : "level " + std::to_string(l);
            text += (first ? "" : ", ") + who + " " + percent(mode.share[l]);
            first = false;
        }
        text += "; farthest: branch " + std::to_string(report.branch[k]) + "\n";
    }
    text += "\n" + report.name + ": " + counted(report.bodies, "body", "bodies") + ", " + figure(report.mass) +
            " kg, " + figure(report.height) + " m; " + (report.wind.empty() ? "still air" : "wind " + report.wind) +
            "; damping is a share of the critical, masses of the tree's\n";
    return text;
}

void write_modes_json(Output& output, const ModesReport& report, const ReportMeta& meta) {
    const ReportRow head = {{"name", report.name},
                            {"wind", report.wind},
                            {"bodies", report.bodies},
                            {"mass", report.mass},
                            {"height", report.height},
                            {"branches", report.branches},
                            {"listed", std::int64_t(report.moves.empty() ? 0 : report.moves.front().size())}};
    write_lists_json(output, "bough-modes-report", meta, head,
                     {{"modes", rows_of(report)}, {"shapes", shapes_of(report)}});
}

void write_modes_csv(Output& output, const ModesReport& report) {
    std::vector<ReportRow> rows;
    for (std::size_t k = 0; k < report.modes.size(); ++k) rows.push_back(with_shape(report, k));
    write_rows_csv(output, rows.empty() ? ReportRow() : rows.front(), rows);
}

std::string modes_svg(const std::vector<DrawnShape>& shapes, const std::string& name) {
    constexpr int across = 3, side = 360;
    const int rows = int((shapes.size() + across - 1) / across);
    double left = 1e300, right = -1e300, low = 1e300, high = -1e300;
    std::string script;
    const auto block = [&](const std::string& label, const std::vector<DrawnShape::Line>& lines) {
        script += "$" + label + " << END\n";
        for (const DrawnShape::Line& l : lines) {
            script += shortest_text(l.x0) + " " + shortest_text(l.y0) + "\n" + shortest_text(l.x1) + " " +
                      shortest_text(l.y1) + "\n\n";
            left = std::min({left, l.x0, l.x1}), right = std::max({right, l.x0, l.x1});
            low = std::min({low, l.y0, l.y1}), high = std::max({high, l.y0, l.y1});
        }
        script += "END\n";
    };
    for (std::size_t k = 0; k < shapes.size(); ++k) {
        block("standing" + std::to_string(k), shapes[k].standing);
        block("swung" + std::to_string(k), shapes[k].swung);
    }
    script += "set multiplot layout " + std::to_string(rows) + "," + std::to_string(across) +
              "\nunset border\nunset tics\nunset key\nset size ratio -1\nset xrange [" + shortest_text(left) + ":" +
              shortest_text(right) + "]\nset yrange [" + shortest_text(low) + ":" + shortest_text(high) + "]\n";
    for (std::size_t k = 0; k < shapes.size(); ++k)
        script += "set title " + gnuplot_text(shapes[k].title) + "\nplot $standing" + std::to_string(k) +
                  " with lines lw 0.6 lc rgb '#b0b0b0', $swung" + std::to_string(k) +
                  " with lines lw 0.8 lc rgb '#0072b2'\n";
    script += "unset multiplot\n";
    return gnuplot_svg(script, across * side, rows * side, name);
}

} // namespace bough

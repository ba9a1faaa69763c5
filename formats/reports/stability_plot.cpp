#include "stability_plot.h"
#include "gnuplot.h"
#include <algorithm>
#include <array>

namespace bough {
namespace {

// Colours that differ for people of any colour vision; light ones, so that words can stand on them.
constexpr const char* colour_of(CellState state) {
    constexpr std::array<const char*, 4> colours = {"#8fd1b9", "#f2c14e", "#e0704a", "#c9c9c9"};
    return colours[std::size_t(state)];
}

constexpr int cell_height = 24, cell_width = 150, top_margin = 118, bottom_margin = 20, right_margin = 24;

struct Column {
    std::string solver, precision;
};

struct Row {
    std::string name; // of a group if it heads one
    bool heading;
    std::vector<const StabilityCell*> cells; // by column; none: not in the report
};

std::vector<Column> columns_of(const StabilityReport& report) {
    std::vector<Column> columns;
    for (const StabilityCell& c : report.cells)
        if (std::none_of(columns.begin(), columns.end(),
                         [&](const Column& k) { return k.solver == c.solver && k.precision == c.precision; }))
            columns.push_back({c.solver, c.precision});
    return columns;
}

std::vector<Row> rows_of(const StabilityReport& report, const std::vector<Column>& columns) {
    std::vector<Row> rows;
    for (const std::string& group : stability_groups(report)) {
        rows.push_back({group, true, {}});
        const std::ptrdiff_t first = std::ptrdiff_t(rows.size());
        for (const StabilityCell& c : report.cells) {
            if (c.group != group) continue;
            const std::size_t column = std::size_t(
                std::find_if(columns.begin(), columns.end(),
                             [&](const Column& k) { return k.solver == c.solver && k.precision == c.precision; }) -
                columns.begin());
            auto row = std::find_if(rows.begin() + first, rows.end(), [&](const Row& r) { return r.name == c.name; });
            if (row == rows.end())
                row = rows.insert(row, {c.name, false, std::vector<const StabilityCell*>(columns.size())});
            row->cells[column] = &c;
        }
    }
    return rows;
}

// Coordinates are pixels from the picture's left and top: the axes span the whole picture.
struct Canvas {
    std::string script;

    void box(int left, int top, int right, int bottom, const char* colour, bool framed) {
        const std::string at = std::to_string(left) + "," + std::to_string(top) + " to " + std::to_string(right) + "," +
                               std::to_string(bottom);
        script += "set object rectangle from " + at + " fc rgb '" + colour + "' fs solid 1.0 " +
                  (framed ? "border lc rgb '#1b1b1b' lw 2.2" : "noborder") + " front\n";
    }
    void text(int x, int y, const std::string& words, const std::string& look) {
        script += "set label " + gnuplot_text(words) + " at " + std::to_string(x) + "," + std::to_string(y) + " " +
                  look + " front\n";
    }
};

std::string words_of(const StabilityCell& c) {
    std::string text = cell_verdict(c);
    if (c.guards > 0 && c.frames > 0) text += ", " + std::to_string(c.guards) + (c.guards == 1 ? " guard" : " guards");
    return text;
}

constexpr const char* on_colour = "center font ',11' textcolor rgb '#1b1b1b'";

void legend(Canvas& canvas, int left) {
    constexpr std::array<std::pair<CellState, const char*>, 4> entries = {
        {{CellState::held, "held"},
         {CellState::outside, "outside the assumption"},
         {CellState::failed, "failed"},
         {CellState::not_run, "not run"}}};
    int x = left;
    for (const auto& [state, words] : entries) {
        canvas.box(x, 48, x + 16, 64, colour_of(state), false);
        canvas.text(x + 22, 56, words, "left font ',11'");
        x += 42 + int(6.3 * double(std::string(words).size()));
    }
    canvas.box(x, 48, x + 16, 64, colour_of(CellState::held), true);
    canvas.text(x + 22, 56, "promised", "left font ',11'");
}

} // namespace

std::string stability_svg(const StabilityReport& report, const std::string& name) {
    const std::vector<Column> columns = columns_of(report);
    const std::vector<Row> rows = rows_of(report, columns);
    std::size_t longest = 10;
    for (const Row& row : rows) longest = std::max(longest, row.name.size());
    const int left = 30 + int(7.4 * double(longest));
    const int width = std::max(760, left + cell_width * int(columns.size()) + right_margin);
    const int height = top_margin + cell_height * int(rows.size()) + bottom_margin;
    Canvas canvas;
    canvas.text(16, 22,
                "Stability: " + std::to_string(report.bodies) + " bodies, frames at " + figure(report.fps) + "/s; " +
                    promise_text(report),
                "left font ',15'");
    legend(canvas, 16);
    for (std::size_t k = 0; k < columns.size(); ++k) {
        const int middle = left + cell_width * int(k) + cell_width / 2;
        canvas.text(middle, top_margin - 28, columns[k].solver, "center font ',12'");
        canvas.text(middle, top_margin - 12, columns[k].precision, "center font ',11'");
    }
    int y = top_margin;
    for (const Row& row : rows) {
        canvas.text(row.heading ? 16 : 26, y + cell_height / 2, row.name,
                    row.heading ? "left font ',13'" : "left font ',12'");
        for (std::size_t k = 0; k < row.cells.size(); ++k) {
            const StabilityCell* cell = row.cells[k];
            const int x = left + cell_width * int(k);
            const CellState state = cell ? cell_state(*cell) : CellState::not_run;
            canvas.box(x + 2, y + 2, x + cell_width - 2, y + cell_height - 2, colour_of(state), cell && cell->promised);
            canvas.text(x + cell_width / 2, y + cell_height / 2, cell ? words_of(*cell) : "not run", on_colour);
        }
        y += cell_height;
    }
    const std::string axes = "set lmargin at screen 0\nset rmargin at screen 1\nset tmargin at screen 1\n"
                             "set bmargin at screen 0\nunset border\nunset tics\nunset key\nset xrange [0:" +
                             std::to_string(width) + "]\nset yrange [" + std::to_string(height) + ":0]\n";
    return gnuplot_svg(axes + canvas.script + "plot NaN notitle\n", width, height, name);
}

} // namespace bough

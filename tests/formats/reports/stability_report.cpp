#include "formats/reports/stability_report.h"
#include "formats/reports/stability_plot.h"
#include "tests/support/report_support.h"
#include "tools/report_file.h"
#include <nlohmann/json.hpp>
#include <pugixml.hpp>

using namespace bough;

namespace {

StabilityCell make_cell(const char* group, const char* name, const char* precision) {
    StabilityCell cell;
    cell.group = group;
    cell.name = name;
    cell.solver = "analytic";
    cell.precision = precision;
    cell.finite = cell.bounded = cell.promised = true;
    cell.energy_drift = 0.0005;
    cell.ringing = 0.125;
    cell.max_angle = M_PI / 6;
    cell.rms_growth = 0.75;
    cell.frames = 100;
    return cell;
}

// Held, failed though promised, outside, unbounded, not run; held; bounded but not as the truth moves.
StabilityReport stability_report() {
    StabilityReport report;
    report.bodies = 21;
    report.fps = 30;
    for (const char* name : {"K x 1", "K x 1e6", "K = 0", "K x 1e15", "K x <&>"})
        report.cells.push_back(make_cell("stiffness", name, "double"));
    report.cells[1].finite = report.cells[1].bounded = false;
    report.cells[1].energy_drift = INFINITY;
    report.cells[1].note = "non-finite after frame 3, \"spring\", body 7";
    report.cells[2].promised = report.cells[2].bounded = false;
    report.cells[2].outside = true;
    report.cells[3].promised = report.cells[3].bounded = false;
    report.cells[3].guards = 12;
    report.cells[4].promised = false;
    report.cells[4].frames = 0;
    report.cells.push_back(make_cell("damping", "beta = 0", "float"));
    report.cells.push_back(make_cell("wind", "storm", "double"));
    StabilityCell& storm = report.cells.back();
    storm.compared = true;
    storm.moves = false;
    storm.lean_error = -0.0625;
    storm.spread_error = -0.75;
    storm.still = 31;
    storm.note = "trunk's std 0.05 m, truth 0.2; 31 still frames";
    return report;
}

const ReportMeta stability_meta = {"treeprofile", "0.1.0", "GNU 12.2", "-O3", 1, "treeprofile stability <a>.json"};

} // namespace

TEST_CASE("every figure of a stability report is in its JSON, what is not finite as null") {
    const StabilityReport report = stability_report();
    const auto j = nlohmann::json::parse(written([&](Output& o) { write_stability_json(o, report, stability_meta); }));
    CHECK(j.at("format") == "bough-stability-report");
    CHECK(j.at("version") == 1);
    CHECK(j.at("tool_version") == "0.1.0");
    CHECK(j.at("bodies") == 21);
    CHECK(j.at("fps") == 30);
    CHECK(j.at("promised") == 4);
    CHECK(j.at("promised_held") == 2);
    CHECK(j.at("source") == stability_meta.source);
    REQUIRE(j.at("cells").size() == report.cells.size());
    for (std::size_t k = 0; k < report.cells.size(); ++k) {
        const StabilityCell& cell = report.cells[k];
        const auto& row = j["cells"][k];
        CHECK(row.size() == 20);
        CHECK(row.at("group") == cell.group);
        CHECK(row.at("case") == cell.name);
        CHECK(row.at("solver") == cell.solver);
        CHECK(row.at("precision") == cell.precision);
        CHECK(row.at("finite") == cell.finite);
        CHECK(row.at("bounded") == cell.bounded);
        CHECK(row.at("promised") == cell.promised);
        CHECK(row.at("outside") == cell.outside);
        CHECK(row.at("ringing") == cell.ringing);
        CHECK(row.at("max_angle").get<double>() == cell.max_angle);
        CHECK(row.at("rms_growth") == cell.rms_growth);
        CHECK(row.at("guards") == cell.guards);
        CHECK(row.at("frames") == cell.frames);
        CHECK(row.at("note") == cell.note);
        CHECK(row.at("energy_drift").is_null() == (k == 1));
        CHECK(row.at("compared") == cell.compared);
        CHECK(row.at("moves") == cell.moves);
        for (const char* name : {"lean_error", "std_error", "still_frames"})
            CHECK(row.at(name).is_null() == !cell.compared);
    }
    CHECK(j["cells"].back().at("lean_error") == -0.0625);
    CHECK(j["cells"].back().at("std_error") == -0.75);
    CHECK(j["cells"].back().at("still_frames") == 31);
}

TEST_CASE("CSV of a stability report has a line a cell, quoted where it must be") {
    const auto lines = lines_of(written([](Output& o) { write_stability_csv(o, stability_report()); }));
    REQUIRE(lines.size() == 8);
    CHECK(lines[0] == "group,case,solver,precision,finite,bounded,compared,moves,energy_drift,ringing,max_angle,"
                      "rms_growth,lean_error,std_error,still_frames,guards,promised,outside,frames,note");
    CHECK(lines[2].find("stiffness,K x 1e6,analytic,double,false,false,false,true,,0.125,") == 0);
    CHECK(lines[2].find(",\"non-finite after frame 3, \"\"spring\"\", body 7\"") != std::string::npos);
}

TEST_CASE("a cell is judged by what it did, what is promised and what is assumed") {
    StabilityReport report = stability_report();
    CHECK(cell_state(report.cells[0]) == CellState::held);
    CHECK(cell_state(report.cells[1]) == CellState::failed);
    CHECK(cell_state(report.cells[2]) == CellState::outside);
    CHECK(cell_verdict(report.cells[2]) == "outside, unbounded");
    CHECK(cell_state(report.cells[3]) == CellState::failed);
    CHECK(cell_verdict(report.cells[3]) == "unbounded");
    CHECK(cell_state(report.cells[4]) == CellState::not_run);
    CHECK(cell_state(report.cells[6]) == CellState::failed);
    CHECK(cell_verdict(report.cells[6]) == "moves wrongly");
    report.cells[2].promised = true; // what is promised cannot be excused
    CHECK(cell_state(report.cells[2]) == CellState::failed);
    report.cells[4].promised = true; // nor by not running it
    CHECK(promise_count(report).promised == 6);
    CHECK(promise_count(report).held == 2);
}

TEST_CASE("the stability table groups the cells and ends with the count of the promised ones") {
    const auto lines = lines_of(stability_table(stability_report()));
    for (const std::string& line : lines) CHECK(line.size() <= 120);
    CHECK(lines.front().find("bodies 21") == 0);
    CHECK(lines.back() == "promised 2 of 4 hold");
    const auto group = std::find(lines.begin(), lines.end(), "stiffness");
    REQUIRE(lines.end() - group > 8);
    CHECK(group[1].find("held") != std::string::npos);
    CHECK(group[1].find("0.05%    0.125       30     0.75       0") != std::string::npos);
    CHECK(group[2].find("non-finite") != std::string::npos);
    CHECK(group[3].find("non-finite after frame 3") != std::string::npos);
    CHECK(group[7] == "damping");
    CHECK(group[10].find("moves wrongly") != std::string::npos);
    CHECK(group[10].find("0.75       0   -6.25%     -75%") != std::string::npos);
    CHECK(group[11] == "      trunk's std 0.05 m, truth 0.2; 31 still frames");
}

TEST_CASE("the grid is well-formed SVG with each case, column and verdict in words") {
    if (!has_gnuplot()) return;
    const std::string svg = stability_svg(stability_report(), "grid.svg");
    pugi::xml_document xml;
    REQUIRE(xml.load_string(svg.c_str()));
    std::vector<std::string> texts;
    for (const auto& node : xml.select_nodes("//text")) {
        std::string text;
        for (const auto& part : node.node().select_nodes(".//text()")) text += part.node().value();
        texts.push_back(
            text.substr(text.find_first_not_of("\n\t ") == std::string::npos ? 0 : text.find_first_not_of("\n\t ")));
    }
    for (const char* word :
         {"stiffness", "damping", "K x 1e6", "K x <&>", "beta = 0", "analytic", "double", "float", "held", "non-finite",
          "outside, unbounded", "unbounded, 12 guards", "not run", "promised", "moves wrongly"}) {
        INFO(word);
        CHECK(
            std::any_of(texts.begin(), texts.end(), [&](const std::string& text) { return text.rfind(word, 0) == 0; }));
    }
    CHECK(xml.load_string(stability_svg({}, "grid.svg").c_str()));
}

TEST_CASE("the stability page holds grid and figures, escaped, and loads nothing") {
    if (!has_gnuplot()) return;
    const std::string page = written([](Output& o) { write_stability_html(o, stability_report(), stability_meta); });
    for (const char* part : {"<svg", "K x &lt;&amp;&gt;", "class=\"failed\"", "class=\"outside\"", "class=\"not-run\"",
                             "2 of 4", "&lt;a&gt;.json", "<td>-75%</td>", "<td>31</td>"})
        CHECK(page.find(part) != std::string::npos);
    for (const char* part : {"src=", "<link", "@import", "url(http", "<script", "<?xml"})
        CHECK(page.find(part) == std::string::npos);
}

TEST_CASE("a stability report is written in the form of its name") {
    const ReportFolder folder;
    CHECK_THROWS_AS(write_stability_report(folder.file("a.pdf"), stability_report(), stability_meta), UsageError);
    CHECK(folder.files() == 0);
    write_stability_report(folder.file("a.json"), stability_report(), stability_meta);
    CHECK(nlohmann::json::parse(read_input(folder.file("a.json")))["cells"].size() == 7);
    write_stability_report(folder.file("a.csv"), stability_report(), stability_meta);
    CHECK(read_input(folder.file("a.csv")).rfind("group,", 0) == 0);
    if (!has_gnuplot()) return;
    write_stability_report(folder.file("a.svg"), stability_report(), stability_meta);
    pugi::xml_document xml;
    CHECK(xml.load_file(folder.file("a.svg").c_str()));
}

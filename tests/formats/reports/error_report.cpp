#include "formats/reports/error_report.h"
#include "formats/reports/error_plot.h"
#include "tests/support/report_support.h"
#include "tools/report_file.h"
#include <nlohmann/json.hpp>
#include <pugixml.hpp>

using namespace bough;

namespace {

// What differs in each figure from all others, scaled.
MotionSummary make_motion(double scale) {
    MotionSummary m;
    m.frames = 300;
    m.top = {0.25 * scale, 0.125 * scale, 0.5 * scale};
    m.level_spread = {0.0625 * scale, 0.375 * scale};
    m.leaves.spread = M_PI / 180 * Vec3(8, 12, 5) * scale;
    m.leaves.turn = M_PI / 180 * 7 * scale;
    m.leaves.fast = 0.02 * scale;
    m.leaves.spectrum = {0.01 * scale, 0.04 * scale, 0.005 * scale};
    m.still = 3;
    m.last_rate = 2.5 * scale;
    return m;
}

ErrorRun make_run(const char* solver, const char* scheme, const char* precision, double steps, double error) {
    ErrorRun run;
    run.solver = solver;
    run.scheme = scheme;
    run.precision = precision;
    run.steps_per_frame = steps;
    run.finite = std::isfinite(error);
    run.seconds_per_simulated_second = 0.01 * steps;
    run.error_rms = error;
    run.error_max = 4 * error;
    run.error_rms_peak = error / 3;
    run.error_max_peak = 4 * error / 3;
    run.error_rms_height = error / 30;
    run.error_max_height = 4 * error / 30;
    run.error_angle = error / 10;
    run.error_frequency = error / 2;
    run.error_step = error * 0.75;
    run.error_model = error / 4;
    run.error_arithmetic = 1e-12;
    run.error_step_max = error * 1.5;
    run.error_model_max = error / 2;
    run.error_arithmetic_max = 2e-12;
    if (run.finite) {
        run.error_level = {{0.1 * error, 0.2 * error, 0.03 * error, 0.06 * error},
                           {0.5 * error, error, 0.125 * error, 0.25 * error}};
        run.error_wood = {0.3 * error, 0.9 * error, 0.075 * error, 0.225 * error};
    }
    if (run.finite && steps >= 1) {
        run.motion = make_motion(1 - error / 2);
        run.error_spectrum = error / 2;
    }
    run.hash = "0123456789abcdef";
    return run;
}

ErrorReport error_report() {
    ErrorReport report;
    report.runs = {
        make_run("analytic", "branch", "double", 4, 0.05),     make_run("analytic", "branch", "double", 1, 0.2),
        make_run("analytic", "branch", "double", 0.25, 0.8),   make_run("analytic", "branch", "float", 1, 0.2),
        make_run("explicit <&'\"", "euler", "double", 1, NAN), make_run("implicit", "linear", "double", 1, 1e-9)};
    report.reference_error = 1e-6;
    report.reference_error_max = 5e-6;
    report.level_deflection = {{0.3, 0.9}, {0.6, 1.8}};
    report.wood_deflection = {0.55, 1.7};
    report.motion = make_motion(1);
    report.bodies = 1003;
    report.tips = 214;
    report.frames = 301;
    report.height = 6.25;
    report.rms_deflection = 0.5;
    report.peak_deflection = 1.5;
    report.frequency = 1.75;
    report.reference_seconds = 12;
    return report;
}

const ReportMeta error_meta = {"treeprofile", "0.1.0", "GNU 12.2",
                               "-O3",         2,       "treegen <a>\ntreeprofile error 'a & b.json'"};

} // namespace

TEST_CASE("every figure of an error report is in its JSON, what is not finite as null") {
    const ErrorReport report = error_report();
    const auto j = nlohmann::json::parse(written([&](Output& o) { write_error_json(o, report, error_meta); }));
    CHECK(j.at("format") == "bough-error-report");
    CHECK(j.at("version") == 1);
    CHECK(j.at("tool") == "treeprofile");
    CHECK(j.at("tool_version") == "0.1.0");
    CHECK(j.at("compiler") == "GNU 12.2");
    CHECK(j.at("flags") == "-O3");
    CHECK(j.at("threads") == 2);
    CHECK(j.at("source") == error_meta.source);
    CHECK(j.at("bodies") == 1003);
    CHECK(j.at("tips") == 214);
    CHECK(j.at("frames") == 301);
    CHECK(j.at("fps") == 30);
    CHECK(j.at("height") == 6.25);
    CHECK(j.at("rms_deflection") == 0.5);
    CHECK(j.at("peak_deflection") == 1.5);
    CHECK(j.at("frequency") == 1.75);
    CHECK(j.at("decay").is_null());
    CHECK(j.at("reference_seconds") == 12);
    CHECK(j.at("reference_error") == 1e-6);
    CHECK(j.at("reference_error_max") == 5e-6);
    CHECK(j.at("truth") == "articulated-reference");
    CHECK(j.at("level0_rms_deflection") == 0.3);
    CHECK(j.at("level1_peak_deflection") == 1.8);
    CHECK(j.at("wood_rms_deflection") == 0.55);
    CHECK(j.at("wood_peak_deflection") == 1.7);
    const auto check = [](const nlohmann::json& row, const std::string& prefix, const MotionSummary& m) {
        const std::vector<std::pair<const char*, double>> figures = {{"top_lean", m.top.lean},
                                                                     {"top_std", m.top.spread},
                                                                     {"top_peak", m.top.peak},
                                                                     {"still_frames", 3},
                                                                     {"last_rate", m.last_rate},
                                                                     {"level0_std", m.level_spread[0]},
                                                                     {"level1_std", m.level_spread[1]},
                                                                     {"leaf_flap_std", m.leaves.spread.x()},
                                                                     {"leaf_sway_std", m.leaves.spread.y()},
                                                                     {"leaf_twist_std", m.leaves.spread.z()},
                                                                     {"leaf_turn", m.leaves.turn},
                                                                     {"leaf_fast", m.leaves.fast},
                                                                     {"leaf_spectrum0", m.leaves.spectrum[0]},
                                                                     {"leaf_spectrum1", m.leaves.spectrum[1]},
                                                                     {"leaf_spectrum2", m.leaves.spectrum[2]}};
        for (const auto& [name, value] : figures) {
            INFO(name);
            CHECK(row.at(prefix + name).get<double>() == value);
        }
    };
    check(j, "truth_", report.motion);
    check(j["runs"][1], "", report.runs[1].motion);
    for (const char* name : {"top_std", "still_frames", "leaf_turn", "leaf_spectrum2", "level1_std"})
        CHECK(j["runs"][2].at(name).is_null()); // a step spans four frames
    REQUIRE(j.at("runs").size() == report.runs.size());
    for (std::size_t k = 0; k < report.runs.size(); ++k) {
        const ErrorRun& run = report.runs[k];
        const auto& row = j["runs"][k];
        CHECK(row.size() == 22 + 12 + 1 + 15);
        CHECK(row.at("solver") == run.solver);
        CHECK(row.at("scheme") == run.scheme);
        CHECK(row.at("precision") == run.precision);
        CHECK(row.at("steps_per_frame") == run.steps_per_frame);
        CHECK(row.at("finite") == run.finite);
        CHECK(row.at("hash") == run.hash);
        const std::vector<std::pair<const char*, double>> figures = {
            {"seconds_per_simulated_second", run.seconds_per_simulated_second},
            {"error_rms", run.error_rms},
            {"error_max", run.error_max},
            {"error_rms_peak", run.error_rms_peak},
            {"error_max_peak", run.error_max_peak},
            {"error_rms_height", run.error_rms_height},
            {"error_angle", run.error_angle},
            {"error_frequency", run.error_frequency},
            {"error_decay", run.error_decay},
            {"error_step", run.error_step},
            {"error_model", run.error_model},
            {"error_arithmetic", run.error_arithmetic},
            {"error_max_height", run.error_max_height},
            {"error_step_max", run.error_step_max},
            {"error_model_max", run.error_model_max},
            {"error_arithmetic_max", run.error_arithmetic_max},
            {"error_wood_rms", run.error_wood.rms},
            {"error_wood_max", run.error_wood.max},
            {"error_wood_rms_peak", run.error_wood.rms_peak},
            {"error_wood_max_peak", run.error_wood.max_peak},
            {"error_level0_rms", run.finite ? run.error_level[0].rms : NAN},
            {"error_level0_max_peak", run.finite ? run.error_level[0].max_peak : NAN},
            {"error_level1_max", run.finite ? run.error_level[1].max : NAN},
            {"error_level1_rms_peak", run.finite ? run.error_level[1].rms_peak : NAN},
            {"error_spectrum", run.error_spectrum}};
        for (const auto& [name, value] : figures) {
            INFO(name);
            if (std::isfinite(value))
                CHECK(row.at(name).get<double>() == value);
            else
                CHECK(row.at(name).is_null());
        }
    }
}

TEST_CASE("infinity is null, a source is left out, texts that are no UTF-8 are made so") {
    ErrorReport report;
    report.runs = {make_run("a\xff\n", "", "double", 1, INFINITY)};
    ReportMeta none = error_meta;
    none.source.clear();
    const auto j = nlohmann::json::parse(written([&](Output& o) { write_error_json(o, report, none); }));
    CHECK(j["runs"][0]["error_rms"].is_null());
    CHECK(j["runs"][0]["solver"] == "a?\n");
    CHECK(!j.contains("source"));
    CHECK(nlohmann::json::parse(written([&](Output& o) { write_error_json(o, {}, none); }))["runs"].empty());
}

TEST_CASE("CSV has a line a run under the names of the JSON") {
    const auto lines = lines_of(written([](Output& o) { write_error_csv(o, error_report()); }));
    REQUIRE(lines.size() == 7);
    const std::string names =
        "solver,scheme,steps_per_frame,precision,finite,seconds_per_simulated_second,error_rms,error_max,"
        "error_rms_peak,error_max_peak,error_rms_height,error_max_height,error_angle,error_frequency,error_decay,"
        "error_step,error_step_max,error_model,error_model_max,error_arithmetic,error_arithmetic_max,hash,"
        "error_wood_rms,error_wood_max,error_wood_rms_peak,error_wood_max_peak,error_level0_rms,error_level0_max,"
        "error_level0_rms_peak,error_level0_max_peak,error_level1_rms,error_level1_max,error_level1_rms_peak,"
        "error_level1_max_peak,error_spectrum,top_lean,top_std,top_peak,still_frames,last_rate,level0_std,level1_std,"
        "leaf_flap_std,leaf_sway_std,leaf_twist_std,leaf_turn,leaf_fast,leaf_spectrum0,leaf_spectrum1,leaf_spectrum2";
    CHECK(lines[0] == names);
    CHECK(lines[3].rfind("analytic,branch,0.25,double,true,0.0025,0.8,3.2,", 0) == 0);
    CHECK(lines[5].rfind("\"explicit <&'\"\"\",euler,1,double,false,0.01,,,,,,,,,,,,,,1e-12,2e-12,0123456789abcdef,,,",
                         0) == 0);
    for (const std::string& line : lines)
        CHECK(std::count(line.begin(), line.end(), ',') == std::count(names.begin(), names.end(), ','));
}

TEST_CASE("the error table summarises, has a row a run by steps, and fits 120 columns") {
    const auto lines = lines_of(error_table(error_report()));
    for (const std::string& line : lines) CHECK(line.size() <= 120);
    const auto find = [&](const std::string& text) {
        const auto found = std::find_if(lines.begin(), lines.end(),
                                        [&](const std::string& line) { return line.find(text) != std::string::npos; });
        REQUIRE(found != lines.end());
        return found;
    };
    CHECK(lines[0].find("bodies 1003, tips 214, height 6.25 m, tip deflection 0.5 m RMS, 1.5 m peak") == 0);
    CHECK(find("first frequency 1.75 Hz")->find("held against articulated-reference") != std::string::npos);
    CHECK(find("its own error 0.0001% rms, 0.0005% max") != lines.end());
    const auto head = find("analytic, branch, double");
    CHECK((head + 1)->find("1/4    0.0025       80%      320%") != std::string::npos);
    CHECK((head + 2)->find("  1      0.01       20%") != std::string::npos);
    CHECK((head + 3)->find("  4      0.04        5%") != std::string::npos);
    CHECK((find("explicit") + 1)->find("non-finite") != std::string::npos);
    // Of the peak, of the height; then the error's parts, the wood, the statistics.
    CHECK((head + 2)->find("6.67%     26.7%    0.667%     2.67%") != std::string::npos);
    const auto after = [&](const std::string& title) {
        const auto found = std::find(find(title), lines.end(), "analytic, branch, double");
        REQUIRE(found != lines.end());
        return found;
    };
    CHECK((after("the tips' error in its parts") + 2)->find("  1       15%       30%        5%       10%") == 3);
    CHECK(
        (after("wood, point by point") + 2)->find("  1      1.5%      4.5%      0.6%      1.2%      2.5%        5%") ==
        3);
    const auto truth = find(" truth ");
    CHECK(*truth == " truth      0.25     0.125       0.5      3         8        12         5         7        2%");
    // A step over four frames has no turn a frame: the first run is that of one step.
    CHECK(after("trunk's top")[1] ==
          "     1     0.225     0.113      0.45      3       7.2      10.8       4.5       6.3      1.8%       10%");
    CHECK((find("implicit, linear") + 1)->find("<0.0001%") != std::string::npos); // nothing below the reference
}

TEST_CASE("a figure wider than its column keeps one digit, and the columns stay apart") {
    ErrorReport report = error_report();
    report.runs = {make_run("coupled", "P12", "double", 1, 0.2)};
    report.runs[0].error_frequency = -1.62e-7;
    report.runs[0].error_decay = -1.23e-6;
    const std::string table = error_table(report);
    CHECK(table.find("   -2e-05%   -1e-04%\n") != std::string::npos);
}

TEST_CASE("the plot is well-formed SVG that names each line and what could not be drawn") {
    if (!has_gnuplot()) return;
    ErrorReport report = error_report();
    const std::string svg = error_svg(report, "plot.svg");
    pugi::xml_document xml;
    REQUIRE(xml.load_string(svg.c_str()));
    std::string text;
    for (const auto& node : xml.select_nodes("//text")) {
        for (const auto& part : node.node().select_nodes(".//text()")) text += part.node().value();
        text += "\n";
    }
    for (const char* name :
         {"analytic, branch, double\n", "analytic, branch, float\n", "implicit, linear, double\n",
          "explicit <&'\", euler, double; non-finite at 1\n", "1003 bodies, 214 tips", "nothing below it is claimed",
          "time step", "1/4\n", "Statistics at 1 step a frame", "wood of level 1, std\n", "leaves' flap, std\n"}) {
        INFO(name);
        CHECK(text.find(name) != std::string::npos);
    }
    // Of another solver than the first one line is drawn, its first; what is left out is named.
    CHECK(text.find("not drawn") == std::string::npos);
    ErrorReport more = report;
    more.runs.push_back(make_run("coupled", "P12", "double", 1, 0.01));
    more.runs.push_back(make_run("coupled", "P12", "float", 1, 0.01));
    more.runs.push_back(make_run("coupled", "P34", "double", 1, 0.01));
    REQUIRE(xml.load_string(error_svg(more, "plot.svg").c_str()));
    std::string legend;
    for (const auto& node : xml.select_nodes("//text()")) legend += std::string(node.node().value()) + "\n";
    CHECK(legend.find("coupled, P12, double\n") != std::string::npos);
    CHECK(legend.find("analytic, branch, float\n") != std::string::npos);
    CHECK(legend.find("not drawn: coupled, P12, float; coupled, P34, double\n") != std::string::npos);
    // Commands in a name are text; so is an empty report, and one of which nothing can be drawn.
    for (const char* hostile : {"'; print system('true'); ", "\"; exit status 3 #", "`false` @x $x \\n \\042 ä {^2}"}) {
        report.runs[0].solver = hostile;
        REQUIRE(xml.load_string(error_svg(report, "plot.svg").c_str()));
        std::string all;
        for (const auto& node : xml.select_nodes("//text()")) all += node.node().value();
        CHECK(all.find(hostile) != std::string::npos);
    }
    CHECK(xml.load_string(error_svg({}, "plot.svg").c_str()));
    report.runs = {make_run("explicit", "euler", "double", 1, NAN)};
    report.reference_error = 0;
    CHECK(xml.load_string(error_svg(report, "plot.svg").c_str()));
}

TEST_CASE("the page holds plot and figures, escaped, and loads nothing") {
    if (!has_gnuplot()) return;
    const std::string page = written([](Output& o) { write_error_html(o, error_report(), error_meta); });
    for (const char* part : {"<svg", "analytic, branch, float", "explicit &lt;&amp;&#39;&quot;, euler", "320%",
                             "Wood by branch level", "level 1 max of peak", "Motion", "flap std deg", "<td>10.8</td>",
                             "treegen &lt;a&gt;\ntreeprofile error &#39;a &amp; b.json&#39;", "GNU 12.2"})
        CHECK(page.find(part) != std::string::npos);
    for (const char* part : {"src=", "<link", "@import", "url(http", "<script", "<a>", "<?xml"})
        CHECK(page.find(part) == std::string::npos);
}

TEST_CASE("the ending of a report's name chooses its form; another is refused and names the four") {
    const ReportFolder folder;
    for (const char* name : {"a.txt", "a", "-", ".json.gz"}) {
        CHECK_THROWS_AS(require_report(name), UsageError);
        CHECK_THROWS_WITH(write_error_report(name, error_report(), error_meta),
                          Catch::Contains(".json") && Catch::Contains(".csv") && Catch::Contains(".svg") &&
                              Catch::Contains(".html"));
    }
    CHECK_NOTHROW(require_report(""));
    write_error_report(folder.file("a.JSON"), error_report(), error_meta);
    CHECK(nlohmann::json::parse(read_input(folder.file("a.JSON")))["runs"].size() == 6);
    write_error_report(folder.file("a.csv"), error_report(), error_meta);
    CHECK(read_input(folder.file("a.csv")).rfind("solver,", 0) == 0);
    if (!has_gnuplot()) return;
    write_error_report(folder.file("a.svg"), error_report(), error_meta);
    pugi::xml_document xml;
    CHECK(xml.load_file(folder.file("a.svg").c_str()));
    write_error_report(folder.file("a.html"), error_report(), error_meta);
    CHECK(read_input(folder.file("a.html")).rfind("<!DOCTYPE html>", 0) == 0);
}

TEST_CASE("without gnuplot a picture is an output error that says what to do, and no file is left") {
    const ReportFolder folder;
    const NoPrograms none;
    for (const char* name : {"a.svg", "a.html"}) {
        CHECK_THROWS_AS(require_report(folder.file(name)), OutputError);
        CHECK_THROWS_WITH(write_error_report(folder.file(name), error_report(), error_meta),
                          folder.file(name) + ": gnuplot was not found: install gnuplot, or ask for .json or .csv");
    }
    CHECK_NOTHROW(require_report(folder.file("a.json")));
    CHECK(folder.files() == 0);
}

TEST_CASE("a script that gnuplot refuses is an output error with its reason") {
    if (!has_gnuplot()) return;
    CHECK_THROWS_WITH(gnuplot_svg("plot nonsense nonsense\n", 100, 100, "a.svg"),
                      Catch::Contains("a.svg: gnuplot failed"));
    // More than a pipe holds, both ways.
    std::string much;
    for (int k = 0; k < 30000; ++k) much += "set label '" + std::to_string(k) + "' at 0.5,0.5\n";
    CHECK(gnuplot_svg(much + "set xrange [0:1]\nset yrange [0:1]\nplot x\n", 100, 100, "a.svg").size() > 1000000);
    CHECK_THROWS_AS(gnuplot_svg("exit status 3\n" + much, 100, 100, "a.svg"), OutputError);
}

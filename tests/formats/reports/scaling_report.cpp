#include "formats/reports/scaling_report.h"
#include "tests/support/report_support.h"
#include "tools/report_file.h"
#include <nlohmann/json.hpp>
#include <pugixml.hpp>

using namespace bough;

namespace {

ScalingRun make_run(const char* shape, std::int64_t bodies, int threads, double ns) {
    ScalingRun run;
    run.shape = shape;
    run.solver = "coupled";
    run.scheme = "P12";
    run.precision = "float";
    run.simd = "avx512";
    run.threads = threads;
    run.bodies = bodies;
    run.frames = 40;
    run.ns = ns;
    run.ns_least = ns * 0.75;
    run.ns_most = ns * 1.5;
    run.memory = 1e6 + 500.0 * double(bodies);
    run.hash = "0123456789abcdef";
    return run;
}

ScalingCost make_cost(double tables) {
    ScalingCost cost;
    cost.shape = "bushy";
    cost.solver = "coupled";
    cost.precision = "float";
    cost.simd = "avx512";
    cost.bodies = 1000;
    cost.slots = 1.25;
    cost.additions = 1000;
    cost.multiplications = 980;
    cost.divisions = 15;
    cost.roots = 5;
    cost.constants_in = 100;
    cost.now_in = 96;
    cost.next_in = cost.next_out = 48;
    cost.solved_in = cost.solved_out = 216;
    cost.records_in = cost.records_out = 30;
    cost.indices_in = 16;
    cost.tables = tables;
    return cost;
}

ScalingLimits make_limits() {
    ScalingLimits limits;
    limits.simd = "avx512";
    limits.threads = 2;
    limits.read = 20e9;
    limits.write = 10e9;
    limits.copy = 16e9;
    limits.peak_float = 200e9;
    limits.peak_double = 100e9;
    return limits;
}

ScalingReport scaling_report() {
    ScalingReport report;
    report.wind = "gusty";
    report.repeat = 3;
    report.array = 268435456;
    report.last_cache = 33554432;
    report.core_cache = 2097152;
    report.limits = {make_limits()};
    report.costs = {make_cost(3e6), ScalingCost()};
    report.runs = {make_run("bushy", 1000, 1, 80), make_run("bushy", 1000, 2, 50), make_run("bushy", 10000, 1, 90),
                   make_run("bushy", 10000, 2, 45), make_run("a, \"tree\"", 300, 1, 70)};
    find_memory_slopes(report);
    hold_against_limits(report.runs[2], report.costs[0], report.limits[0], report.core_cache);
    return report;
}

const ReportMeta scaling_meta = {"treeprofile", "0.1.0", "GNU 12.2",
                                 "-O3",         2,       "treeprofile scaling --wind 'a & b.json'"};

} // namespace

TEST_CASE("the limit is the longer of the time for bytes and the time for operations") {
    const ScalingLimits limits = make_limits();
    ScalingRun run = make_run("bushy", 1000, 1, 80);
    hold_against_limits(run, make_cost(3e6), limits, 2e6);
    CHECK(run.limit_ns == Approx(800.0 / 20)); // 800 B at 20 GB/s; 2000 operations at 200 Gop/s are 10 ns
    CHECK(run.limited_by == "memory");
    CHECK(run.over_limit() == Approx(2));
    hold_against_limits(run, make_cost(1e6), limits, 2e6); // fits the core's cache
    CHECK(run.limit_ns == Approx(10));
    CHECK(run.limited_by == "arithmetic");
    run.precision = "double";
    hold_against_limits(run, make_cost(1e6), limits, 2e6);
    CHECK(run.limit_ns == Approx(20));
    run.threads = 2; // two caches
    hold_against_limits(run, make_cost(3e6), limits, 2e6);
    CHECK(run.limited_by == "arithmetic");
    hold_against_limits(run, ScalingCost(), limits, 2e6); // nothing known
    CHECK(std::isnan(run.limit_ns));
    CHECK(run.limited_by.empty());
}

TEST_CASE("memory a body is the slope from the next smaller size of the same series") {
    const ScalingReport report = scaling_report();
    CHECK(std::isnan(report.runs[0].memory_slope));
    CHECK(report.runs[2].memory_slope == Approx(500));
    CHECK(report.runs[3].memory_slope == Approx(500));
    CHECK(std::isnan(report.runs[4].memory_slope));
}

TEST_CASE("every figure of a scaling report is in its JSON, what is not known as null") {
    const ScalingReport report = scaling_report();
    const auto j = nlohmann::json::parse(written([&](Output& o) { write_scaling_json(o, report, scaling_meta); }));
    CHECK(j.at("format") == "bough-scaling-report");
    CHECK(j.at("version") == 1);
    CHECK(j.at("tool") == "treeprofile");
    CHECK(j.at("threads") == 2);
    CHECK(j.at("source") == scaling_meta.source);
    CHECK(j.at("wind") == "gusty");
    CHECK(j.at("repeat") == 3);
    CHECK(j.at("array") == 268435456);
    CHECK(j.at("last_cache") == 33554432);
    CHECK(j.at("core_cache") == 2097152);
    REQUIRE(j.at("limits").size() == 1);
    const auto& limits = j["limits"][0];
    CHECK(limits.size() == 7);
    CHECK(limits.at("simd") == "avx512");
    CHECK(limits.at("threads") == 2);
    CHECK(limits.at("read") == 20e9);
    CHECK(limits.at("write") == 10e9);
    CHECK(limits.at("copy") == 16e9);
    CHECK(limits.at("peak_float") == 200e9);
    CHECK(limits.at("peak_double") == 100e9);
    REQUIRE(j.at("costs").size() == 2);
    const auto& cost = j["costs"][0];
    CHECK(cost.size() == 22);
    CHECK(cost.at("shape") == "bushy");
    CHECK(cost.at("solver") == "coupled");
    CHECK(cost.at("precision") == "float");
    CHECK(cost.at("simd") == "avx512");
    CHECK(cost.at("bodies") == 1000);
    const std::vector<std::pair<const char*, double>> figures = {
        {"slots", 1.25},       {"additions", 1000}, {"multiplications", 980}, {"divisions", 15},  {"roots", 5},
        {"constants_in", 100}, {"now_in", 96},      {"next_in", 48},          {"next_out", 48},   {"solved_in", 216},
        {"solved_out", 216},   {"records_in", 30},  {"records_out", 30},      {"indices_in", 16}, {"tables", 3e6},
        {"operations", 2000},  {"bytes", 800}};
    for (const auto& [name, value] : figures) {
        INFO(name);
        CHECK(cost.at(name).get<double>() == value);
        CHECK(j["costs"][1].at(name).is_null());
    }
    REQUIRE(j.at("runs").size() == report.runs.size());
    for (std::size_t k = 0; k < report.runs.size(); ++k) {
        const ScalingRun& run = report.runs[k];
        const auto& row = j["runs"][k];
        CHECK(row.size() == 17);
        CHECK(row.at("shape") == run.shape);
        CHECK(row.at("bodies") == run.bodies);
        CHECK(row.at("solver") == "coupled");
        CHECK(row.at("scheme") == "P12");
        CHECK(row.at("precision") == "float");
        CHECK(row.at("simd") == "avx512");
        CHECK(row.at("threads") == run.threads);
        CHECK(row.at("frames") == 40);
        CHECK(row.at("ns_per_body_frame") == run.ns);
        CHECK(row.at("ns_least") == run.ns_least);
        CHECK(row.at("ns_most") == run.ns_most);
        CHECK(row.at("memory") == run.memory);
        CHECK(row.at("hash") == run.hash);
        CHECK(row.at("limited_by") == run.limited_by);
        CHECK(row.at("limit_ns").is_null() == (k != 2));
        CHECK(row.at("over_limit").is_null() == (k != 2));
        CHECK(row.at("memory_per_body").is_null() == (k < 2 || k == 4));
    }
    CHECK(j["runs"][2].at("over_limit") == 90.0 / 40);
    ReportMeta none = scaling_meta;
    none.source.clear();
    CHECK(nlohmann::json::parse(written([&](Output& o) { write_scaling_json(o, {}, none); }))["runs"].empty());
}

TEST_CASE("CSV of scaling has a line a run under the names of the JSON") {
    const auto lines = lines_of(written([](Output& o) { write_scaling_csv(o, scaling_report()); }));
    REQUIRE(lines.size() == 6);
    CHECK(lines[0] == "shape,bodies,solver,scheme,precision,simd,threads,frames,ns_per_body_frame,ns_least,ns_most,"
                      "limit_ns,limited_by,over_limit,memory,memory_per_body,hash");
    CHECK(lines[1] == "bushy,1000,coupled,P12,float,avx512,1,40,80,60,120,,,,1500000,,0123456789abcdef");
    CHECK(lines[5].rfind("\"a, \"\"tree\"\"\",300,", 0) == 0);
}

TEST_CASE("the scaling table has limits, counts and a row a run by size, and fits 120 columns") {
    const std::string table = scaling_table(scaling_report());
    const auto lines = lines_of(table);
    for (const std::string& line : lines) CHECK(line.size() <= 120);
    for (const char* part : {"memory over 256 MB (last cache 32 MB, a core's 2 MB)", "median of 3 runs; wind gusty",
                             "bushy, coupled, P12, float, avx512, 2 threads\n", "0123456789abcdef"})
        CHECK(table.find(part) != std::string::npos);
    const auto head = std::find(lines.begin(), lines.end(), "bushy, coupled, P12, float, avx512, 1 thread");
    REQUIRE(head != lines.end());
    CHECK((head + 1)->find("      1000        40        80") == 0);
    CHECK((head + 2)->find("     10000        40        90") == 0);
    CHECK((head + 2)->find("        40      2.25  memory") != std::string::npos);
    CHECK(scaling_table({}).find("wind none") != std::string::npos);
}

TEST_CASE("the plot of scaling is well-formed SVG that names each line; the page holds it") {
    if (!has_gnuplot()) return;
    ScalingReport report = scaling_report();
    pugi::xml_document xml;
    REQUIRE(xml.load_string(scaling_svg(report, "plot.svg").c_str()));
    std::string text;
    for (const auto& node : xml.select_nodes("//text()")) text += std::string(node.node().value()) + "\n";
    for (const char* name : {"bushy, coupled, P12, float, avx512, 1 thread\n", "avx512, 2 threads\n",
                             "a, \"tree\", coupled, P12, float, avx512, 1 thread\n", "ns a body and frame\n"}) {
        INFO(name);
        CHECK(text.find(name) != std::string::npos);
    }
    CHECK(xml.load_string(scaling_svg({}, "plot.svg").c_str()));
    const std::string page = written([&](Output& o) { write_scaling_html(o, report, scaling_meta); });
    for (const char* part : {"<svg", "avx512, 2 threads", "20, 10, 16 GB/s", "&#39;a &amp; b.json&#39;", "2.25"})
        CHECK(page.find(part) != std::string::npos);
    for (const char* part : {"src=", "<link", "<script", "<?xml"}) CHECK(page.find(part) == std::string::npos);
}

TEST_CASE("the ending of a scaling report's name chooses its form") {
    const ReportFolder folder;
    CHECK_THROWS_AS(write_scaling_report(folder.file("a.txt"), scaling_report(), scaling_meta), UsageError);
    write_scaling_report(folder.file("a.json"), scaling_report(), scaling_meta);
    CHECK(nlohmann::json::parse(read_input(folder.file("a.json")))["runs"].size() == 5);
    write_scaling_report(folder.file("a.csv"), scaling_report(), scaling_meta);
    CHECK(read_input(folder.file("a.csv")).rfind("shape,", 0) == 0);
    if (!has_gnuplot()) return;
    write_scaling_report(folder.file("a.svg"), scaling_report(), scaling_meta);
    pugi::xml_document xml;
    CHECK(xml.load_file(folder.file("a.svg").c_str()));
    write_scaling_report(folder.file("a.html"), scaling_report(), scaling_meta);
    CHECK(read_input(folder.file("a.html")).rfind("<!DOCTYPE html>", 0) == 0);
}

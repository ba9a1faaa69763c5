#include "report.h"
#include "formats/json_shape.h"
#include "lib/base/shortest_text.h"
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

namespace bough {
namespace {

using Json = nlohmann::ordered_json;

struct Reader {
    const std::string& name;

    const Json& field(const Json& object, const std::string& pointer, const char* key) const {
        const auto found = object.find(key);
        if (found == object.end()) throw InputError(name, pointer + "/" + key + ": is missing");
        return *found;
    }
    std::string text(const Json& object, const std::string& pointer, const char* key) const {
        const Json& value = field(object, pointer, key);
        if (!value.is_string()) throw InputError(name, pointer + "/" + key + ": expected text");
        return value.get<std::string>();
    }
    double positive(const Json& object, const std::string& pointer, const char* key) const {
        const Json& value = field(object, pointer, key);
        const double number = value.is_number() ? value.get<double>() : -1;
        if (!std::isfinite(number) || number < 0)
            throw InputError(name, pointer + "/" + key + ": expected a number, 0 or more");
        return number;
    }
    std::int64_t count(const Json& object, const std::string& pointer, const char* key) const {
        const Json& value = field(object, pointer, key);
        if (!value.is_number_integer() || value.get<std::int64_t>() < 0)
            throw InputError(name, pointer + "/" + key + ": expected a whole number, 0 or more");
        return value.get<std::int64_t>();
    }
};

} // namespace

void write_report_json(Output& output, const Report& report) {
    Json j;
    j["format"] = "bough-report";
    j["tool"] = report.tool;
    j["version"] = report.version;
    j["compiler"] = report.compiler;
    j["flags"] = report.flags;
    j["bodies"] = report.bodies;
    j["frames"] = report.frames;
    j["substeps"] = report.substeps;
    j["threads"] = report.threads;
    j["simd"] = report.simd;
    j["solver"] = report.solver;
    if (!report.scheme.empty()) j["scheme"] = report.scheme;
    j["precision"] = report.precision;
    j["hash"] = report.hash;
    j["total_ns_per_body_frame"] = report.total_ns_per_body_frame;
    j["stages"] = Json::array();
    for (const ReportStage& stage : report.stages)
        j["stages"].push_back({{"name", stage.name},
                               {"calls", stage.calls},
                               {"seconds", stage.seconds},
                               {"ns_per_body_frame", stage.ns_per_body_frame},
                               {"share", stage.share}});
    if (!report.source.empty()) j["source"] = report.source;
    output.write(j.dump(2, ' ', false, Json::error_handler_t::replace));
    output.write("\n");
}

void write_report_csv(Output& output, const Report& report) {
    output.write("name,calls,seconds,ns_per_body_frame,share,bodies,frames,threads,precision,hash\n");
    const std::string run = std::to_string(report.bodies) + "," + std::to_string(report.frames) + "," +
                            std::to_string(report.threads) + "," + report.precision + "," + report.hash + "\n";
    for (const ReportStage& stage : report.stages)
        output.write(stage.name + "," + std::to_string(stage.calls) + "," + shortest_text(stage.seconds) + "," +
                     shortest_text(stage.ns_per_body_frame) + "," + shortest_text(stage.share) + "," + run);
}

Report read_report(std::string_view content, const std::string& name) {
    if (json_shape(content).depth > deepest_json) throw InputError(name, nested_too_deep);
    Json j;
    try {
        j = Json::parse(content);
    } catch (const Json::parse_error& error) {
        throw InputError(name,
                         "is not JSON at byte " + std::to_string(error.byte) + ", expected a report of treeprofile");
    } catch (const Json::out_of_range&) {
        throw InputError(name, "has a number beyond any double, expected a report of treeprofile");
    }
    if (!j.is_object()) throw InputError(name, "expected a report of treeprofile (an object)");
    const Reader read{name};
    Report report;
    if (const auto format = j.find("format"); format != j.end() && *format != "bough-report")
        throw InputError(name, "/format: expected bough-report");
    report.tool = read.text(j, "", "tool");
    report.version = read.text(j, "", "version");
    report.compiler = j.contains("compiler") ? read.text(j, "", "compiler") : "";
    report.flags = j.contains("flags") ? read.text(j, "", "flags") : "";
    report.solver = j.contains("solver") ? read.text(j, "", "solver") : "";
    report.scheme = j.contains("scheme") ? read.text(j, "", "scheme") : "";
    report.simd = read.text(j, "", "simd");
    report.precision = read.text(j, "", "precision");
    report.hash = read.text(j, "", "hash");
    report.bodies = read.count(j, "", "bodies");
    report.frames = read.count(j, "", "frames");
    report.threads = int(read.count(j, "", "threads"));
    report.substeps = j.contains("substeps") ? int(read.count(j, "", "substeps")) : 1;
    report.total_ns_per_body_frame = read.positive(j, "", "total_ns_per_body_frame");
    const Json& stages = read.field(j, "", "stages");
    if (!stages.is_array()) throw InputError(name, "/stages: expected an array");
    for (std::size_t k = 0; k < stages.size(); ++k) {
        const std::string at = "/stages/" + std::to_string(k);
        if (!stages[k].is_object()) throw InputError(name, at + ": expected an object");
        report.stages.push_back({read.text(stages[k], at, "name"), read.count(stages[k], at, "calls"),
                                 read.positive(stages[k], at, "seconds"),
                                 read.positive(stages[k], at, "ns_per_body_frame"),
                                 read.positive(stages[k], at, "share")});
    }
    return report;
}

} // namespace bough

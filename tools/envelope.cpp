#include "envelope.h"
#include "formats/models/envelope_mesh.h"
#include "formats/plain_text.h"
#include "lib/base/counted.h"
#include "lib/growth/colonize.h"
#include <algorithm>

namespace bough {
namespace {

constexpr double kBare = 0.3; // default height of a closed form's lower end over its own height

std::optional<EnvelopeShape> shape_named(const std::string& name) {
    if (name == "sphere") return EnvelopeShape::sphere;
    if (name == "cone") return EnvelopeShape::cone;
    if (name == "box") return EnvelopeShape::box;
    return {};
}

Vec3 default_size(EnvelopeShape shape) {
    if (shape == EnvelopeShape::cone) return {4.5, 8, 4.5};
    return shape == EnvelopeShape::box ? Vec3(5, 5, 5) : Vec3(6, 6, 6);
}

Vec3 vector_of(const std::string& option, const std::string& text) {
    const std::vector<double> v = number_list(option, text, 3);
    return {v[0], v[1], v[2]};
}

// What was expected of a volume in which no tree grows, "" of others.
std::string absurd(const Vec3& size) {
    constexpr double least = 1e-3, most = 1e5; // [m]
    if (size.maxCoeff() <= most && size.maxCoeff() >= least) return "";
    return "its longest side to be " + shown(least) + " to " + shown(most) + " m";
}

Vec3 size_of(const std::string& text) {
    const Vec3 size = vector_of("--envelope-size", text);
    if (!(size.minCoeff() > 0)) throw UsageError("--envelope-size is '" + text + "', expected three lengths above 0 m");
    if (const std::string wrong = absurd(size); !wrong.empty())
        throw UsageError("--envelope-size is '" + text + "', expected " + wrong);
    return size;
}

// The file's mesh, scaled to --envelope-size about the middle of its lower face, that face put at --crown-base.
void place_mesh(EnvelopeMesh& mesh, const EnvelopeOptions& o, const std::string& name) {
    Vec3 lower = mesh.vertex[static_cast<std::size_t>(mesh.triangle[0][0])], upper = lower;
    for (const Triangle& t : mesh.triangle)
        for (const std::int32_t c : t) {
            lower = lower.cwiseMin(mesh.vertex[static_cast<std::size_t>(c)]);
            upper = upper.cwiseMax(mesh.vertex[static_cast<std::size_t>(c)]);
        }
    const Vec3 base((lower.x() + upper.x()) / 2, lower.y(), (lower.z() + upper.z()) / 2);
    if (!((upper - lower).minCoeff() > 0))
        throw InputError(name, "is flat and encloses no volume, expected a closed mesh");
    if (const std::string wrong = absurd(upper - lower); o.size.empty() && !wrong.empty())
        throw InputError(name, "is " + shown((upper - lower).maxCoeff()) + " m large, expected " + wrong +
                                   "; are its coordinates, or --units, right?");
    const Vec3 scale = o.size.empty() ? Vec3(1, 1, 1) : Vec3(size_of(o.size).cwiseQuotient(upper - lower));
    const Vec3 at(base.x(), o.crown_base.value_or(base.y()), base.z());
    for (Vec3& p : mesh.vertex) p = at + (p - base).cwiseProduct(scale);
}

Envelope mesh_envelope(const EnvelopeOptions& o, const ImportChoice& choice, CommonOptions& common) {
    ImportOptions options;
    options.unit = unit_in_metres(choice.units);
    if (!choice.up.empty()) options.up = lower_case(choice.up[0]);
    options.name = input_name(o.envelope);
    ImportNotes notes;
    const std::string content = read_input(o.envelope);
    EnvelopeMesh mesh = read_envelope_mesh(content, o.envelope, options, notes);
    place_mesh(mesh, o, options.name);
    Envelope e;
    e.shape = EnvelopeShape::mesh;
    try {
        e.mesh = std::make_shared<MeshInterior>(mesh.vertex, mesh.triangle);
    } catch (const std::invalid_argument& error) {
        throw InputError(options.name, error.what());
    }
    e.space = volume(e);
    if (!(e.space > 0)) throw InputError(options.name, "encloses no volume, expected a closed mesh");
    const MeshClosure& c = e.mesh->closure();
    if (c.open_edges > 0)
        notes.lines.push_back("warning: the mesh is not closed (" + counted(c.open_edges, "open edge", "open edges") +
                              "); a point counts as inside where four of six rays along the axes cross it "
                              "an odd number of times");
    else if (!c.alike)
        notes.lines.push_back("warning: the mesh's faces do not all face alike; a point counts as inside where rays "
                              "along the axes cross it an odd number of times, so that overlapping parts are outside");
    for (const std::string& line : notes.lines) common.notes.push_back(options.name + ": " + line);
    return e;
}

Envelope closed_form(EnvelopeShape shape, const EnvelopeOptions& o, const ImportChoice& choice) {
    if (!choice.units.empty()) throw UsageError("--units: only with --import or a mesh file as --envelope");
    if (!choice.up.empty()) throw UsageError("--up: only with --import or a mesh file as --envelope");
    Envelope e;
    e.shape = shape;
    e.size = o.size.empty() ? default_size(shape) : size_of(o.size);
    e.base = Vec3(0, o.crown_base.value_or(kBare * e.size.y()), 0);
    return e;
}

ColonizeParameters parameters(const EnvelopeOptions& o, const ImportChoice& choice, CommonOptions& common) {
    ColonizeParameters p;
    const auto shape = shape_named(o.envelope);
    p.envelope = shape ? closed_form(*shape, o, choice) : mesh_envelope(o, choice, common);
    p.name = shape ? o.envelope : "envelope";
    p.points = o.attractors.value_or(p.points);
    p.influence = o.influence.value_or(0);
    p.kill = o.kill.value_or(0);
    p.step = o.step.value_or(0);
    p.leader = o.leader.value_or(-1);
    p.tip_radius = o.tip_radius.value_or(0);
    if (!o.tropism.empty()) p.tropism = vector_of("--tropism", o.tropism);
    return p;
}

// The library's complaint, "name: is ...", by the option of that name where there is one ("tip radius": --tip-radius). A length that was not
// given follows from the others and the volume.
std::string by_option(const std::string& error, const EnvelopeOptions& o) {
    std::string option = "--" + error.substr(0, error.find(':'));
    std::replace(option.begin(), option.end(), ' ', '-');
    std::vector<std::pair<std::string, bool>> options = o.given();
    options.emplace_back("--envelope", true);
    for (const auto& [name, is_given] : options)
        if (name == option)
            return (is_given ? option + ":"
                             : "--envelope: the " + option.substr(2) + " that follows from what is given") +
                   error.substr(option.size() - 1);
    return error;
}

} // namespace

std::vector<std::pair<std::string, bool>> EnvelopeOptions::given() const {
    return {{"--envelope-size", !size.empty()},
            {"--crown-base", crown_base.has_value()},
            {"--attractors", attractors.has_value()},
            {"--influence", influence.has_value()},
            {"--kill", kill.has_value()},
            {"--step", step.has_value()},
            {"--tropism", !tropism.empty()},
            {"--leader", leader.has_value()},
            {"--tip-radius", tip_radius.has_value()}};
}

void add_envelope_options(OptionList& list, EnvelopeOptions& o) {
    list.group("Volume");
    list.add("--envelope", o.envelope,
             "Grow a tree that fills this volume (space colonization): sphere, cone, box, or a closed mesh from an "
             "OBJ, FBX, glTF or COLLADA file (- for stdin)")
        .takes("SHAPE|FILE");
    list.add("--envelope-size", o.size, "Its width, height and depth in m (sphere 6,6,6; a file's own)").takes("X,Y,Z");
    list.add("--crown-base", o.crown_base, "Height of its lower end in m (0.3 of its height; a file's own)")
        .takes("M")
        .check(not_negative_number());
    list.add("--attractors", o.attractors, "Number of attraction points in it (8000)")
        .takes("N")
        .check(whole_number(1, 20'000'000));
    list.add("--influence", o.influence, "Distance in m at which they pull (6 of their mean spacings)")
        .takes("M")
        .check(positive_number());
    list.add("--kill", o.kill, "Distance in m at which they count as reached (0.8 of their mean spacing)")
        .takes("M")
        .check(positive_number());
    list.add("--step", o.step, "Length in m that a branch grows at a time (half the kill distance)")
        .takes("M")
        .check(positive_number());
    list.add("--tropism", o.tropism, "Added to the unit direction of growth (0,0.1,0)").takes("X,Y,Z");
    list.add("--leader", o.leader,
             "Share of the envelope's height that the trunk rises straight through (0.25; cone 0.8)")
        .takes("F")
        .check(not_negative_number());
    list.add("--tip-radius", o.tip_radius, "Radius of twigs in m (such that the trunk's is 1/60 of the height)")
        .takes("M")
        .check(positive_number());
}

Splines grow_in_envelope(const EnvelopeOptions& o, const ImportChoice& choice, const EnvelopeRun& run,
                         CommonOptions& common) {
    const ColonizeParameters p = parameters(o, choice, common);
    ColonizeReport report;
    Splines tree;
    try {
        tree = colonize(p, run.seed, run.leaves, run.fruit, &report);
    } catch (const std::invalid_argument& error) {
        throw UsageError(by_option(error.what(), o));
    }
    if (const std::int64_t missed = report.blocked + report.out_of_reach; missed > 0)
        common.notes.push_back(std::to_string(missed) + " of " + std::to_string(report.points) +
                               " attraction points were not reached: " + std::to_string(report.out_of_reach) +
                               " out of the influence distance, " + std::to_string(report.blocked) +
                               " behind the envelope's surface");
    return tree;
}

} // namespace bough

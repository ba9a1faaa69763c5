// live_trees.cpp: trees: grown, read from files of any program, kept as they stand.
#include "formats/documents/tree.h"
#include "formats/imports/import.h"
#include "lib/base/counted.h"
#include "lib/base/monotone.h"
#include "lib/model/wood.h"
#include "live.h"
#include <numbers>

using namespace bough;
using namespace bough::c;
using namespace bough::live;

namespace bough::live {

const char* given_out(std::string text) {
    static std::string kept;
    kept = std::move(text);
    return kept.c_str();
}

} // namespace bough::live

namespace {

std::string listed(const std::vector<std::string>& lines) {
    std::string all;
    for (const std::string& line : lines) all += (all.empty() ? "" : "\n") + line;
    return all;
}

bough_tree* converted(bough_splines* splines, const char* material, double segment_length, double max_bodies) {
    bough_conversion how = bough_default_conversion();
    if (material && *material) how.material = material;
    how.segment_length = segment_length;
    how.max_bodies = std::int64_t(max_bodies);
    bough_tree* tree = nullptr;
    const bough_result result = bough_convert(splines, &how, &tree);
    bough_free(splines);
    return result == BOUGH_OK ? tree : nullptr;
}

} // namespace

// Names, one a line.
LIVE const char* live_species() {
    std::vector<std::string> names;
    for (std::size_t k = 0; const char* name = bough_species(k); ++k) names.push_back(name);
    return given_out(listed(names));
}
LIVE const char* live_materials() {
    std::vector<std::string> names;
    for (const Material& wood : wood_presets()) names.push_back(wood.name);
    return given_out(listed(names));
}

LIVE bough_tree* live_grow(const char* species, double age, double bodies, double seed, int leaves, int petals,
                           int fruit) {
    bough_growth growth = bough_default_growth();
    growth.species = species;
    growth.age = age;
    growth.bodies = std::int64_t(bodies);
    growth.seed = std::uint64_t(seed);
    growth.leaves = leaves, growth.petals = petals, growth.fruit = fruit;
    bough_splines* splines = nullptr;
    if (bough_grow(&growth, &splines) != BOUGH_OK) return nullptr;
    return converted(splines, nullptr, 0, 0);
}

// A tree of any file that holds one: given[0] its handle, given[1] that of its own mesh or NULL. material "", segment_length and max_bodies 0:
// what the file says. unit [m] of a file that states none, 0: guessed. Notes by live_notes, a line each.
namespace {
std::vector<std::string> notes;
}
LIVE const char* live_notes() {
    return given_out(listed(notes));
}
LIVE bough_result live_read_tree(const char* bytes, std::size_t size, const char* name, const char* material,
                                 double segment_length, double max_bodies, double unit, void** given) {
    return call([&] {
        notes.clear();
        given[0] = given[1] = nullptr;
        const std::string_view text = content(bytes, size);
        const auto failed = [] { throw WrongCall(bough_error()); };
        if (is_tree(text)) {
            bough_tree* tree = nullptr;
            if (bough_read_tree(bytes, size, name, &tree) != BOUGH_OK) failed();
            given[0] = tree;
            return;
        }
        ImportOptions options;
        options.name = name;
        if (unit > 0) options.unit = unit;
        ImportNotes found, of_mesh;
        auto splines = std::make_shared<SplinesObject>();
        splines->splines = import_splines(text, options, found);
        notes = found.lines;
        std::shared_ptr<ModelObject> mesh;
        if (has_speedtree_mesh(text)) {
            mesh = std::make_shared<ModelObject>();
            mesh->model = read_speedtree_model(text, name, found, of_mesh);
        }
        given[0] = converted(static_cast<bough_splines*>(give(splines)), material, segment_length, max_bodies);
        if (!given[0]) failed();
        notes.insert(notes.begin(), found.format);
        notes.insert(notes.end(), of_mesh.lines.begin(), of_mesh.lines.end());
        if (mesh) given[1] = give(mesh);
    });
}

// What a tree's bodies are, from the arrays of bough_bodies: 0 parent (i32), 1 kind (u8), 2 size (3 f64), 3 mass, 4 level (i32), of bodies; 5 each
// tree's first body and the end (u32). *count: entries.
LIVE const void* live_bodies(const bough_simulation* simulation, int which, std::size_t* count) {
    bough_bodies bodies;
    if (bough_simulation_bodies(simulation, &bodies) != BOUGH_OK) return nullptr;
    *count = which == 5 ? bodies.trees + 1 : bodies.count;
    const void* const arrays[] = {bodies.parent, bodies.kind,  bodies.size,
                                  bodies.mass,   bodies.level, bodies.first_body};
    return which >= 0 && which < 6 ? arrays[which] : nullptr;
}

// The tree of place k as it stands in a run: drawn so, it stays so by itself.
LIVE void* live_posed_tree(const bough_simulation* simulation, std::size_t place, const bough_tree* of, double yaw) {
    return handle_of([&] {
        const Use<SimulationObject> use(simulation);
        const auto from = find<TreeObject>(of);
        const std::vector<std::size_t>& first = use->first_body;
        if (place + 1 >= first.size() || first[place + 1] - first[place] != from->tree->size_bodies())
            throw WrongCall("place: is not where this tree stands");
        const Tree posed = [&] {
            try {
                return use->simulation.posed_tree();
            } catch (const SceneError& error) {
                throw WrongCall(std::string("the pose cannot be kept: ") + error.what());
            }
        }();
        Tree tree = *from->tree;
        const Quat back(Eigen::AngleAxisd(-yaw * std::numbers::pi / 180, Vec3::UnitY()));
        for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
            const Quat& turn = posed.joint_rotation[first[place] + i];
            tree.joint_rotation[i] = tree.parent[i] < 0 ? Quat((back * turn).normalized()) : turn;
        }
        auto object = std::make_shared<TreeObject>();
        object->first_body = {0, tree.size_bodies()};
        object->tree = std::make_shared<const Tree>(std::move(tree));
        return object;
    });
}

// A document of the tree, in safetensors: its bytes are the page's to free. NULL where it failed.
LIVE void* live_tree_document(const bough_tree* tree, std::size_t* size) {
    if (bough_write_tree(tree, nullptr, 0, size) != BOUGH_OK) return nullptr;
    void* const bytes = std::malloc(*size);
    if (bytes && bough_write_tree(tree, bytes, *size, size) == BOUGH_OK) return bytes;
    std::free(bytes);
    return nullptr;
}

// The curve through keys (x rising) at `samples` places from `from` to `to`.
LIVE bough_result live_curve(const double* x, const double* y, std::size_t keys, double from, double to,
                             std::size_t samples, double* out) {
    return call([&] {
        const std::vector<double> xs(x, x + keys), ys(y, y + keys);
        for (std::size_t k = 0; k < samples; ++k)
            out[k] = monotone_cubic(xs, ys, from + (to - from) * double(k) / double(samples > 1 ? samples - 1 : 1));
    });
}

#include "formats/documents/splines.h"
#include "formats/documents/tree.h"
#include "formats/files.h"
#include "handle.h"
#include "lib/base/shortest_text.h"
#include "write.h"

using namespace bough;
using namespace bough::c;

namespace {

void give_tree(Tree tree, bough_tree** to) {
    *to = static_cast<bough_tree*>(give(object_of(std::move(tree))));
}

void give_splines(Splines splines, bough_splines** to) {
    *to = static_cast<bough_splines*>(give(object_of(std::move(splines))));
}

const Material& wood_of(const Splines& splines, const char* asked) {
    if (const Material* const wood = find_wood(asked ? asked : splines.material)) return *wood;
    if (!asked) return wood_presets().front();
    std::string names;
    for (const Material& known : wood_presets()) names += (names.empty() ? "" : ", ") + known.name;
    throw WrongCall("material: is '" + std::string(asked) + "', expected one of " + names);
}

// segment() holds the others to the ranges that bough_c.h gives, and names the one that is out of its own.
SegmentOptions options_of(const bough_conversion& c) {
    if (!(c.max_bend >= 1e-3))
        throw WrongCall("max_bend: is " + shortest_text(c.max_bend) + ", expected radians, 0.001 or more");
    SegmentOptions options;
    options.segment_length = c.segment_length;
    options.max_bend = c.max_bend;
    options.max_bodies = c.max_bodies;
    return options;
}

} // namespace

namespace bough::c {

std::shared_ptr<SplinesObject> object_of(Splines splines) {
    auto object = std::make_shared<SplinesObject>();
    object->splines = std::move(splines);
    return object;
}

std::shared_ptr<TreeObject> object_of(Tree tree) {
    auto object = std::make_shared<TreeObject>();
    object->first_body = {0, tree.size_bodies()};
    object->tree = std::make_shared<const Tree>(std::move(tree));
    return object;
}

bough_bodies bodies_of(const Tree& tree, const std::vector<std::size_t>& first_body) {
    static_assert(sizeof(Vec3) == sizeof(double[3]) && sizeof(Kind) == 1);
    const auto triples = [](const std::vector<Vec3>& v) { return reinterpret_cast<const double(*)[3]>(v.data()); };
    bough_bodies b{};
    b.count = tree.size_bodies();
    b.parent = tree.parent.data();
    b.kind = reinterpret_cast<const std::uint8_t*>(tree.kind.data());
    b.size = triples(tree.size);
    b.mass = tree.mass.data();
    b.com = triples(tree.com);
    b.stiffness = triples(tree.stiffness);
    b.damping = tree.damping.data();
    b.branch = tree.branch.data();
    b.level = tree.level.data();
    b.trees = first_body.size() - 1;
    b.first_body = first_body.data();
    return b;
}

} // namespace bough::c

bough_growth bough_default_growth(void) {
    bough_growth growth{};
    growth.check = mark<bough_growth>(growth_mark);
    growth.species = bough_species(0);
    return growth;
}

const char* bough_species(size_t k) {
    static const std::vector<std::string>* const names = [] {
        try {
            return new std::vector<std::string>(species_names());
        } catch (...) {
            return new (std::nothrow) std::vector<std::string>;
        }
    }();
    return names && k < names->size() ? (*names)[k].c_str() : nullptr;
}

bough_result bough_grow(const bough_growth* growth, bough_splines** splines) {
    return call_of_running([&] {
        const bough_growth& g = marked(growth, growth_mark, "growth", "bough_default_growth()");
        required(splines, "splines");
        required(g.species, "species");
        give_splines(
            grow(std::string(g.species), {g.bodies, g.seed, g.age, g.leaves != 0, g.petals != 0, g.fruit != 0}),
            splines);
    });
}

bough_result bough_read_splines(const void* bytes, size_t size, const char* name, bough_splines** splines) {
    return call([&] {
        required(splines, "splines");
        give_splines(read_splines(content(bytes, size), name_or_memory(name)), splines);
    });
}

bough_conversion bough_default_conversion(void) {
    const SegmentOptions options;
    bough_conversion conversion{};
    conversion.check = mark<bough_conversion>(conversion_mark);
    conversion.segment_length = options.segment_length;
    conversion.max_bend = options.max_bend;
    conversion.max_bodies = options.max_bodies;
    return conversion;
}

bough_result bough_convert(const bough_splines* splines, const bough_conversion* conversion, bough_tree** tree) {
    return call_of_running([&] {
        const auto from = find<SplinesObject>(splines);
        const bough_conversion defaults = bough_default_conversion();
        const bough_conversion& c =
            conversion ? marked(conversion, conversion_mark, "conversion", "bough_default_conversion()") : defaults;
        required(tree, "tree");
        const SegmentOptions options = options_of(c);
        const Material& wood = wood_of(from->splines, c.material);
        try {
            Tree made = segment(from->splines, wood, options);
            if (made.size_bodies() == 0) throw WrongCall("splines: hold no branch with a length, expected a tree");
            give_tree(std::move(made), tree);
        } catch (const std::invalid_argument& error) {
            throw WrongCall(error.what());
        }
    });
}

bough_result bough_read_tree(const void* bytes, size_t size, const char* name, bough_tree** tree) {
    return call([&] {
        required(tree, "tree");
        give_tree(read_tree(content(bytes, size), name_or_memory(name)), tree);
    });
}

bough_result bough_write_tree(const bough_tree* tree, void* buffer, size_t capacity, size_t* size) {
    return call([&] {
        const auto from = find<TreeObject>(tree);
        write_to(buffer, capacity, size, [&](Output& to) { write_tree(to, *from->tree, Form::safetensors); });
    });
}

bough_result bough_tree_bodies(const bough_tree* tree, bough_bodies* bodies) {
    return call([&] {
        const auto from = find<TreeObject>(tree);
        required(bodies, "bodies") = bodies_of(*from->tree, from->first_body);
    });
}

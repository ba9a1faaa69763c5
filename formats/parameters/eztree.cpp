#include "eztree.h"
#include "formats/json_shape.h"
#include "lib/growth/eztree_check.h"
#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

namespace bough {
namespace {

using Json = nlohmann::json;

// One object of the file, its fields taken one by one; what nobody took is unknown.
class Fields {
public:
    Fields(const Json& object, std::string pointer, const std::string& name)
        : object_(object), pointer_(std::move(pointer)), name_(name) {
        if (!object.is_object()) wrong(pointer_, object, "an object");
    }
    bool has(const std::string& key) const { return object_.contains(key); }
    Fields child(const std::string& key) {
        taken_.insert(key);
        return Fields(object_.at(key), pointer_ + "/" + key, name_);
    }
    void number(const std::string& key, double& value) {
        if (const Json* found = take(key)) {
            if (!found->is_number()) wrong(pointer_ + "/" + key, *found, "a number");
            value = found->get<double>();
        }
    }
    template <class Whole> void whole(const std::string& key, Whole& value) {
        double real = static_cast<double>(value);
        number(key, real);
        if (!(std::abs(real) <= static_cast<double>(std::numeric_limits<Whole>::max()) / 2) || real != std::floor(real))
            wrong(pointer_ + "/" + key, object_.at(key), "a whole number");
        value = static_cast<Whole>(real);
    }
    void boolean(const std::string& key, bool& value) {
        if (const Json* found = take(key)) {
            if (!found->is_boolean()) wrong(pointer_ + "/" + key, *found, "true or false");
            value = found->get<bool>();
        }
    }
    void vector(const std::string& key, Vec3& value) {
        if (!has(key)) return;
        Fields parts = child(key);
        parts.number("x", value.x());
        parts.number("y", value.y());
        parts.number("z", value.z());
        parts.end();
    }
    // {"0": ..., "1": ...}, from level `first` on.
    template <class T>
    void levels(const std::string& key, std::size_t first, std::size_t last, std::array<T, kEzLevels>& value) {
        if (!has(key)) return;
        Fields parts = child(key);
        for (std::size_t n = first; n <= last; ++n)
            if constexpr (std::is_same_v<T, int>)
                parts.whole(std::to_string(n), value[n]);
            else
                parts.number(std::to_string(n), value[n]);
        parts.end();
    }
    const Json* take(const std::string& key) {
        taken_.insert(key);
        const auto found = object_.find(key);
        return found == object_.end() ? nullptr : &*found;
    }
    void leave(const std::string& key, std::vector<std::string>& left) {
        if (take(key)) left.push_back((pointer_ + "/" + key).substr(1));
    }
    void end() const {
        for (const auto& [key, value] : object_.items())
            if (!taken_.count(key)) throw InputError(name_, pointer_ + "/" + key + ": is no parameter of ez-tree");
    }
    [[noreturn]] void wrong(const std::string& pointer, const Json& found, const std::string& expected) const {
        std::string shown = found.dump(-1, ' ', true, Json::error_handler_t::replace);
        if (shown.size() > 40) shown = shown.substr(0, 40) + "...";
        throw InputError(name_, (pointer.empty() ? "/" : pointer) + ": is " + shown + ", expected " + expected);
    }

private:
    const Json& object_;
    std::string pointer_;
    const std::string& name_;
    std::set<std::string> taken_;
};

void read_branch(Fields f, EzTreeParameters& p, std::vector<std::string>& left) {
    f.whole("levels", p.levels);
    f.levels("angle", 1, 3, p.angle);
    f.levels("children", 0, 2, p.children);
    f.levels("gnarliness", 0, 3, p.gnarliness);
    f.levels("length", 0, 3, p.length);
    f.levels("radius", 0, 3, p.radius);
    f.levels("sections", 0, 3, p.sections);
    f.levels("start", 1, 3, p.start);
    f.levels("taper", 0, 3, p.taper);
    f.levels("twist", 0, 3, p.twist);
    f.leave("segments", left);
    if (f.has("force")) {
        Fields force = f.child("force");
        force.vector("direction", p.force_direction);
        force.number("strength", p.force_strength);
        force.end();
    }
    f.end();
}

void read_leaves(Fields f, EzTreeParameters& p, std::vector<std::string>& left) {
    f.number("angle", p.leaf_angle);
    f.whole("count", p.leaf_count);
    f.number("start", p.leaf_start);
    f.number("size", p.leaf_size);
    f.number("sizeVariance", p.leaf_size_variance);
    for (const char* key : {"type", "billboard", "tint", "alphaTest", "roundedNormals", "map"}) f.leave(key, left);
    f.end();
}

void read_trellis(Fields f, EzTreeParameters::Trellis& t, std::vector<std::string>& left) {
    std::vector<std::string> bars;
    f.boolean("enabled", t.enabled);
    f.vector("position", t.position);
    f.number("width", t.width);
    f.number("height", t.height);
    f.number("spacing", t.spacing);
    if (f.has("force")) {
        Fields force = f.child("force");
        force.number("strength", t.strength);
        force.number("maxDistance", t.most_distance);
        force.number("falloff", t.falloff);
        force.end();
    }
    for (const char* key : {"cylinderRadius", "visible", "color"}) f.leave(key, bars);
    f.end();
    if (t.enabled) left.insert(left.end(), bars.begin(), bars.end());
}

// ez-tree's own defaults (options.js).
EzTreeParameters defaults() {
    EzTreeParameters p;
    p.angle = {0, 70, 60, 60};
    p.children = {7, 7, 5, 0};
    p.force_strength = 0.01;
    p.gnarliness = {0.15, 0.2, 0.3, 0.02};
    p.length = {20, 20, 10, 1};
    p.radius = {1.5, 0.7, 0.7, 0.7};
    p.sections = {12, 10, 8, 6};
    p.start = {0, 0.4, 0.3, 0.3};
    p.taper = {0.7, 0.7, 0.7, 0.7};
    p.leaf_count = 1;
    p.leaf_size = 2.5;
    p.leaf_size_variance = 0.7;
    return p;
}

} // namespace

bool is_eztree(std::string_view content) {
    if (json_shape(content).depth > deepest_json) return false;
    const Json file = Json::parse(content, nullptr, false);
    if (!file.is_object()) return false;
    const auto branch = file.find("branch");
    if (branch == file.end() || !branch->is_object()) return false;
    return std::any_of(branch->items().begin(), branch->items().end(), [](const auto& item) {
        return item.key() == "gnarliness" || item.key() == "sections" || item.key() == "levels" ||
               item.key() == "children";
    });
}

EzTreeParameters read_eztree(std::string_view content, const std::string& name, std::vector<std::string>& notes) {
    if (json_shape(content).depth > deepest_json) throw InputError(name, nested_too_deep);
    Json file;
    try {
        file = Json::parse(content);
    } catch (const Json::parse_error& error) {
        throw InputError(name, "is no JSON at byte " + std::to_string(error.byte) + ", expected an ez-tree preset");
    }
    EzTreeParameters p = defaults();
    std::vector<std::string> left;
    Fields f(file, "", name);
    f.whole("seed", p.seed);
    if (const Json* type = f.take("type")) {
        if (*type != "deciduous" && *type != "evergreen") f.wrong("/type", *type, "\"deciduous\" or \"evergreen\"");
        p.evergreen = *type == "evergreen";
    }
    if (f.has("branch")) read_branch(f.child("branch"), p, left);
    if (f.has("leaves")) read_leaves(f.child("leaves"), p, left);
    if (f.has("trellis")) read_trellis(f.child("trellis"), p.trellis, left);
    f.leave("bark", left);
    f.end();
    try {
        check_eztree(p);
    } catch (const std::invalid_argument& error) {
        std::string what = error.what();
        std::replace(what.begin(), what.begin() + static_cast<std::ptrdiff_t>(what.find(':')), '.', '/');
        throw InputError(name, "/" + what);
    }
    if (!left.empty()) {
        std::string line = "not honoured:";
        for (const std::string& key : left) line += (&key == &left[0] ? " " : ", ") + key;
        notes.push_back(line);
    }
    return p;
}

} // namespace bough

#include "formats/inside.h"
#include "formats/open.h"
#include "scene_parts.h"
#include <filesystem>
#include <stdexcept>

namespace bough {

using nlohmann::json;
using nlohmann::ordered_json;

// One tree, or as many as there are places.
void read_placements(const json& value, const std::string& name, const std::string& at, std::vector<Placement>& trees) {
    Placement tree;
    const auto read_place = [](ObjectReader& object, Placement& to) {
        object.read("position", to.position);
        object.read("yaw", to.yaw);
        object.read("start", to.start);
    };
    ObjectReader object(value, name, at);
    object.need("file");
    object.read("file", tree.file);
    read_place(object, tree);
    const bool several = object.has("places");
    if (several)
        for (const char* key : {"position", "yaw", "start"})
            if (object.has(key)) object.fail(key, "stands beside 'places', expected it in each of those");
    std::size_t count = 0;
    for (const json& entry : object.list("places")) {
        ObjectReader place(entry, name, object.at("places") + "/" + std::to_string(count++));
        Placement& to = trees.emplace_back(tree);
        read_place(place, to);
        place.finish();
    }
    object.finish();
    if (!several) trees.push_back(tree);
    if (several && count == 0) object.fail("places", "is empty, expected at least one place");
}

ordered_json value_of(const Placement& tree) {
    ordered_json fields{{"file", tree.file}, {"position", numbers(tree.position)}, {"yaw", tree.yaw}};
    if (tree.start != 0) fields["start"] = tree.start;
    return fields;
}

Walker read_walker(const json& value, const std::string& name, const std::string& at) {
    Walker walker;
    ObjectReader object(value, name, at);
    object.read("mass", walker.mass);
    object.read("radius", walker.radius);
    object.read("push", walker.push);
    object.need("stops");
    for (const json& entry : object.list("stops")) {
        ObjectReader stop(entry, name, object.at("stops") + "/" + std::to_string(walker.stops.size()));
        Walker::Stop& to = walker.stops.emplace_back();
        to.on = read_selector(stop.need("on"), name, stop.at("on"));
        stop.need("time");
        stop.read("time", to.time);
        stop.read("leap", to.leap);
        stop.finish();
    }
    object.finish();
    return walker;
}

ordered_json value_of(const Walker& walker) {
    ordered_json fields{{"mass", walker.mass}, {"radius", walker.radius}, {"push", walker.push}};
    for (const Walker::Stop& stop : walker.stops) {
        ordered_json entry{{"on", value_of(stop.on)}, {"time", stop.time}};
        if (stop.leap) entry["leap"] = true;
        fields["stops"].push_back(entry);
    }
    return fields;
}

std::string tree_file(const std::string& scene_file, const Placement& place) {
    const std::filesystem::path folder = scene_file == "-" ? "." : std::filesystem::path(scene_file).parent_path();
    if (place.file.find('\0') != std::string::npos)
        throw InputError(input_name(scene_file) + ": /trees", "names a file by a text with a NUL in it");
    std::string path = (folder / place.file).string();
    if (path == "-") path = "./-"; // stdin is the user's to name, not a file's
    if (!within_reach(path, folder.string()))
        throw InputError(input_name(scene_file) + ": /trees", "names '" + place.file + "', which " + out_of_reach);
    if (!opens_at_once(path))
        throw InputError(input_name(scene_file) + ": /trees", "names '" + place.file + "', which " + no_regular_file);
    return path;
}

Tree with_material(Tree tree, const MaterialChange& change, const std::string& file) {
    try {
        change_material(tree, change);
    } catch (const std::domain_error& error) {
        throw InputError(input_name(file) + ": /material", error.what());
    }
    return tree;
}

} // namespace bough

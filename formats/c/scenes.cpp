#include "handle.h"
#include "lib/model/check_parts.h"
#include "wind.h"

using namespace bough;
using namespace bough::c;

namespace bough::c {

void change(Wind& wind, const bough_wind* to) {
    const bough_wind& w = marked(to, wind_mark, "wind", "bough_wind_preset()");
    wind.velocity = Vec3(w.velocity[0], w.velocity[1], w.velocity[2]);
    wind.reference_height = w.reference_height;
    wind.profile = w.profile;
    wind.turbulence = w.turbulence;
    wind.gust_factor = w.gust_factor;
    wind.gust_period = w.gust_period;
    wind.seed = w.seed;
    if (const std::optional<Defect> defect = check(wind)) throw WrongCall(defect->field + " " + defect->message);
}

} // namespace bough::c

bough_result bough_read_scene(const void* bytes, size_t size, const char* name, bough_scene** scene) {
    return call([&] {
        required(scene, "scene");
        auto object = std::make_shared<SceneObject>();
        const std::string_view text = content(bytes, size);
        if (bytes) object->document = read_scene_document(text, name_or_memory(name));
        *scene = static_cast<bough_scene*>(give(object));
    });
}

const char* bough_scene_file(const bough_scene* scene, size_t k) {
    const char* file = nullptr;
    call([&] {
        const Use<SceneObject> use(scene);
        const std::vector<Placement>& places = use->document.scene.trees;
        if (k < places.size()) file = places[k].file.c_str();
    });
    return file;
}

bough_result bough_scene_put(bough_scene* scene, size_t k, const bough_tree* tree) {
    return call([&] {
        const Use<SceneObject> use(scene);
        const auto from = find<TreeObject>(tree);
        std::vector<Placement>& places = use->document.scene.trees;
        if (k >= places.size())
            throw WrongCall("place: is " + std::to_string(k) + ", the scene has " + std::to_string(places.size()));
        const MaterialChange& material = use->document.material;
        places[k].tree = material.any()
                             ? std::make_shared<const Tree>(with_material(*from->tree, material, places[k].file))
                             : from->tree;
    });
}

bough_result bough_scene_add(bough_scene* scene, const bough_tree* tree, const double position[3], double yaw) {
    return call([&] {
        const Use<SceneObject> use(scene);
        const auto from = find<TreeObject>(tree);
        Vec3 at = Vec3::Zero();
        if (position) at = Vec3(required_vector(position, "position"));
        if (!std::isfinite(yaw)) throw WrongCall("yaw: is not finite, expected degrees");
        const MaterialChange& material = use->document.material;
        use->document.scene.add(
            material.any() ? std::make_shared<const Tree>(with_material(*from->tree, material, "tree")) : from->tree,
            at, yaw);
    });
}

bough_result bough_wind_preset(const char* name, bough_wind* wind) {
    return call([&] {
        required(wind, "wind");
        const std::optional<Wind> preset = name ? wind_preset(name) : Wind();
        if (!preset) throw WrongCall("wind: is '" + std::string(name) + "', expected calm, breeze, gusty or storm");
        wind->check = mark<bough_wind>(wind_mark);
        Eigen::Map<Vec3>(wind->velocity) = preset->velocity;
        wind->reference_height = preset->reference_height;
        wind->profile = preset->profile;
        wind->turbulence = preset->turbulence;
        wind->gust_factor = preset->gust_factor;
        wind->gust_period = preset->gust_period;
        wind->seed = preset->seed;
    });
}

bough_result bough_scene_set_wind(bough_scene* scene, const bough_wind* wind) {
    return call([&] {
        const Use<SceneObject> use(scene);
        std::optional<Wind>& own = use->document.scene.wind;
        if (!wind) return own.reset();
        Wind changed = own ? *own : Wind();
        change(changed, wind);
        own = changed;
    });
}

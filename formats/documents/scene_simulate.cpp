#include "scene_parts.h"

namespace bough {

using nlohmann::json;
using nlohmann::ordered_json;

Simulate read_simulate(const json& value, const std::string& name) {
    Simulate simulate;
    ObjectReader object(value, name, "/simulate");
    for (const auto& [key, level] :
         {std::pair{"first_level", &simulate.first_level}, {"last_level", &simulate.last_level}})
        if (object.has(key)) object.read(key, level->emplace());
    object.read("radius", simulate.radius);
    for (const json& entry : object.list("subtrees"))
        simulate.subtrees.push_back(
            read_selector(entry, name, object.at("subtrees") + "/" + std::to_string(simulate.subtrees.size())));
    if (object.has("box")) {
        ObjectReader box(object.need("box"), name, object.at("box"));
        Simulate::Box to;
        box.need("least");
        box.read("least", to.least);
        box.need("most");
        box.read("most", to.most);
        box.finish();
        simulate.box = to;
    }
    object.read("error", simulate.error);
    if (object.has("view")) {
        ObjectReader view(object.need("view"), name, object.at("view"));
        Simulate::View to;
        view.need("from");
        view.read("from", to.from);
        view.read("angle", to.angle);
        view.read("pixels", to.pixels);
        view.finish();
        simulate.view = to;
    }
    object.finish();
    return simulate;
}

ordered_json value_of(const Simulate& simulate) {
    ordered_json fields = ordered_json::object();
    if (simulate.first_level) fields["first_level"] = *simulate.first_level;
    if (simulate.last_level) fields["last_level"] = *simulate.last_level;
    fields["radius"] = simulate.radius;
    for (const Selector& on : simulate.subtrees) fields["subtrees"].push_back(value_of(on));
    if (simulate.box) fields["box"] = {{"least", numbers(simulate.box->least)}, {"most", numbers(simulate.box->most)}};
    fields["error"] = simulate.error;
    if (simulate.view)
        fields["view"] = {
            {"from", numbers(simulate.view->from)}, {"angle", simulate.view->angle}, {"pixels", simulate.view->pixels}};
    return fields;
}

} // namespace bough

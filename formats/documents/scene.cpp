#include "scene.h"
#include "scene_parts.h"
#include <map>

namespace bough {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr DocumentType scene_type{"bough-scene", 1};
constexpr DocumentType wind_type{"bough-wind", 1};
const std::vector<std::string> axes{"world", "body"};
const std::vector<std::string> poses{"drawn", "settled", "rest"};
const std::vector<std::string> inertias{"branch", "paper"};

// The document's fields as one object. In the binary form they all stand in __metadata__: what begins as an object, an
// array or a number does is JSON text, anything else a string.
json fields_of(std::string_view content, const std::string& name, const DocumentType& type) {
    if (!is_binary(content, name, type)) return parse_json(content, name);
    const Safetensors file = parse_safetensors(content, name);
    if (!file.tensors.empty()) unknown_field(name, "", file.tensors.begin()->first, {"__metadata__"});
    json fields = json::object();
    for (const auto& [key, text] : file.metadata) {
        const bool value = !text.empty() && std::string_view("{[-0123456789").find(text[0]) != std::string_view::npos;
        fields[key] =
            value ? parse_json(text, name + ": " + pointer("/__metadata__", key), pointer("", key)) : json(text);
    }
    return fields;
}

// Format and version first: what follows from a wrong one would only mislead.
void read_type(ObjectReader& object, const std::string& name, const DocumentType& type) {
    std::string format;
    std::int64_t version = 0;
    object.need("format");
    object.read("format", format);
    check_format(name, format, type);
    object.need("version");
    object.read("version", version);
    check_version(name, version, type);
}

Pull read_pull(const json& value, const std::string& name, const std::string& at) {
    Pull pull;
    ObjectReader object(value, name, at);
    pull.on = read_selector(object.need("on"), name, object.at("on"));
    object.need("time");
    object.read("time", pull.time);
    object.need("force");
    object.read("force", pull.force);
    pull.in_body = object.word("axes", axes, 0) == 1;
    object.finish();
    return pull;
}

RootMotion read_root_motion(const json& value, const std::string& name, const std::string& at) {
    RootMotion motion;
    ObjectReader object(value, name, at);
    object.read("tree", motion.tree);
    object.need("time");
    object.read("time", motion.time);
    object.read("position", motion.position);
    object.read("rotation", motion.rotation);
    object.finish();
    // A list that is there but empty is one key short for each time, not a list left out.
    for (const auto& [key, empty] :
         {std::pair{"position", motion.position.empty()}, {"rotation", motion.rotation.empty()}})
        if (empty && object.has(key))
            object.fail(key, "has 0 keys, expected " + std::to_string(motion.time.size()) + " (one for each time)");
    return motion;
}

// One number for all, or for each kind a number or one for each axis.
JointLimit read_joint_limit(const json& value, const std::string& name) {
    JointLimit limit;
    if (value.is_number()) {
        limit.branch = limit.leaf = limit.fruit = Vec3::Constant(value.get<double>());
        return limit;
    }
    if (!value.is_object())
        throw InputError(name + ": /joint_limit", "is " + text_of(value) +
                                                      ", expected a number of degrees or an object with branch, leaf, "
                                                      "fruit");
    ObjectReader object(value, name, "/joint_limit");
    for (const auto& [kind, most] :
         {std::pair{"branch", &limit.branch}, {"leaf", &limit.leaf}, {"fruit", &limit.fruit}}) {
        if (object.has(kind) && object.need(kind).is_number())
            most->setConstant(object.need(kind).get<double>());
        else
            object.read(kind, *most);
    }
    object.finish();
    return limit;
}

ordered_json value_of(const RootMotion& motion) {
    ordered_json fields{{"tree", motion.tree}, {"time", motion.time}};
    for (const Vec3& p : motion.position) fields["position"].push_back(numbers(p));
    for (const Quat& q : motion.rotation) fields["rotation"].push_back(ordered_json{q.x(), q.y(), q.z(), q.w()});
    return fields;
}

ordered_json value_of(const Scene& scene, const MaterialChange& material) {
    ordered_json fields{{"format", scene_type.format}, {"version", scene_type.version}};
    fields["trees"] = ordered_json::array();
    for (const Placement& tree : scene.trees) fields["trees"].push_back(value_of(tree));
    fields["gravity"] = numbers(scene.gravity);
    if (material.any()) fields["material"] = value_of(material);
    if (scene.wind) fields["wind"] = value_of(*scene.wind);
    fields["air_density"] = scene.air_density;
    fields["pulls"] = ordered_json::array();
    for (const Pull& pull : scene.pulls) {
        ordered_json force = ordered_json::array();
        for (const Vec3& f : pull.force) force.push_back(numbers(f));
        fields["pulls"].push_back({{"on", value_of(pull.on)}, {"time", pull.time}, {"force", force}});
        if (pull.in_body) fields["pulls"].back()["axes"] = axes[1];
    }
    for (const Attachment& held : scene.attachments) fields["attachments"].push_back(value_of(held));
    fields["root_motion"] = ordered_json::array();
    for (const RootMotion& motion : scene.root_motion) fields["root_motion"].push_back(value_of(motion));
    fields["pose"] = poses[std::size_t(scene.pose)];
    fields["joint_inertia"] = inertias[std::size_t(scene.joint_inertia)];
    if (scene.joint_limit)
        fields["joint_limit"] = {{"branch", numbers(scene.joint_limit->branch)},
                                 {"leaf", numbers(scene.joint_limit->leaf)},
                                 {"fruit", numbers(scene.joint_limit->fruit)}};
    if (scene.fracture) fields["fracture"] = value_of(*scene.fracture);
    for (const Ball& ball : scene.balls) fields["balls"].push_back(value_of(ball));
    for (const Walker& walker : scene.walkers) fields["walkers"].push_back(value_of(walker));
    if (scene.contact) fields["contact"] = value_of(*scene.contact);
    if (scene.leaves) fields["leaves"] = value_of(*scene.leaves);
    if (scene.wood) fields["wood"] = value_of(*scene.wood);
    if (scene.load) fields["load"] = value_of(*scene.load);
    if (scene.fictitious) fields["fictitious"] = value_of(*scene.fictitious);
    if (scene.simulate) fields["simulate"] = value_of(*scene.simulate);
    fields["stiffness_scale"] = scene.stiffness_scale;
    fields["damping_scale"] = scene.damping_scale;
    return fields;
}

SceneDocument read_fields(const json& fields, const std::string& name) {
    SceneDocument document;
    Scene& scene = document.scene;
    ObjectReader object(fields, name, "");
    read_type(object, name, scene_type);
    std::size_t tree = 0;
    for (const json& value : object.list("trees"))
        read_placements(value, name, "/trees/" + std::to_string(tree++), scene.trees);
    object.read("gravity", scene.gravity);
    if (object.has("material")) document.material = read_material_change(object.need("material"), name);
    if (object.has("wind")) scene.wind = read_wind_value(object.need("wind"), name);
    object.read("air_density", scene.air_density);
    for (const json& value : object.list("pulls"))
        scene.pulls.push_back(read_pull(value, name, "/pulls/" + std::to_string(scene.pulls.size())));
    for (const json& value : object.list("attachments"))
        scene.attachments.push_back(
            read_attachment(value, name, "/attachments/" + std::to_string(scene.attachments.size())));
    for (const json& value : object.list("root_motion"))
        scene.root_motion.push_back(
            read_root_motion(value, name, "/root_motion/" + std::to_string(scene.root_motion.size())));
    scene.pose = Pose(object.word("pose", poses, std::size_t(scene.pose)));
    scene.joint_inertia = JointInertia(object.word("joint_inertia", inertias, std::size_t(scene.joint_inertia)));
    if (object.has("joint_limit")) scene.joint_limit = read_joint_limit(object.need("joint_limit"), name);
    if (object.has("fracture")) scene.fracture = read_fracture(object.need("fracture"), name);
    for (const json& value : object.list("balls"))
        scene.balls.push_back(read_ball(value, name, "/balls/" + std::to_string(scene.balls.size())));
    for (const json& value : object.list("walkers"))
        scene.walkers.push_back(read_walker(value, name, "/walkers/" + std::to_string(scene.walkers.size())));
    if (object.has("contact")) scene.contact = read_contact(object.need("contact"), name);
    if (object.has("leaves")) scene.leaves = read_leaves(object.need("leaves"), name);
    if (object.has("wood")) scene.wood = read_wood(object.need("wood"), name);
    if (object.has("load")) scene.load = read_load(object.need("load"), name);
    if (object.has("fictitious")) scene.fictitious = read_fictitious(object.need("fictitious"), name);
    if (object.has("simulate")) scene.simulate = read_simulate(object.need("simulate"), name);
    object.read("stiffness_scale", scene.stiffness_scale);
    object.read("damping_scale", scene.damping_scale);
    object.finish();
    refuse(check(document.material), name, {});
    refuse(check(scene), name, {});
    return document;
}

// An error that the document has by itself stays its own; any other comes of an override.
SceneDocument read_overridden(const json& fields, const std::string& name, const std::vector<SceneOverride>& changes) {
    json result = fields;
    for (const SceneOverride& change : changes) override_field(result, change);
    try {
        return read_fields(result, name);
    } catch (const InputError& error) {
        const std::string what = error.what();
        std::string own;
        try {
            read_fields(fields, name);
        } catch (const InputError& before) {
            own = before.what();
        }
        if (own == what) throw;
        const std::string told = what.rfind(name + ": ", 0) == 0 ? what.substr(name.size() + 2) : what;
        const std::size_t end = told.find(": ");
        if (end == std::string::npos) throw;
        const std::string at = told.substr(0, end);
        throw InputError(nearest_override(changes, at).given + ": " + at, told.substr(end + 2));
    }
}

void require_files(const Scene& scene, const std::string& name) {
    std::map<std::string, std::size_t> known; // the first place with a tree in memory
    for (std::size_t k = 0; k < scene.trees.size(); ++k) {
        const Placement& place = scene.trees[k];
        const std::string at = "/trees/" + std::to_string(k) + "/file";
        if (place.file.empty()) // a tree that is only in memory could not be read again
            throw OutputError(name, at + " is empty, expected the name of a file that holds the tree");
        if (!place.tree) continue;
        const std::size_t first = known.try_emplace(place.file, k).first->second;
        if (scene.trees[first].tree != place.tree) // both would be read as the one that the file holds
            throw OutputError(name, at + " is '" + place.file + "', which /trees/" + std::to_string(first) +
                                        " names for another tree, expected a file for each tree in memory, or one "
                                        "tree that both places share");
    }
}

} // namespace

bool is_scene(std::string_view content) {
    return document_format(content) == scene_type.format;
}

SceneDocument read_scene_document(std::string_view content, const std::string& name,
                                  const std::vector<SceneOverride>& changes) {
    const json fields = fields_of(content, name, scene_type);
    return changes.empty() ? read_fields(fields, name) : read_overridden(fields, name, changes);
}

SceneDocument changed(const SceneDocument& document, const std::vector<SceneOverride>& changes) {
    return read_overridden(json(value_of(document.scene, document.material)), "the scene", changes);
}

std::string wind_text(const Wind& wind) {
    return text_of(value_of(wind));
}

Wind read_wind(std::string_view content, const std::string& name) {
    const json fields = fields_of(content, name, wind_type);
    Scene scene;
    scene.wind.emplace();
    ObjectReader object(fields, name, "");
    read_type(object, name, wind_type);
    read_wind_fields(object, *scene.wind, name, "");
    if (std::optional<Defect> defect = check(scene)) {
        defect->field.erase(0, std::string("wind/").size());
        refuse(defect, name, {});
    }
    return *scene.wind;
}

void write_scene(Output& output, const Scene& scene, Form form, const MaterialChange& material) {
    for (const std::optional<Defect>& defect : {check(scene), check(material)})
        if (defect) throw OutputError(output.name(), "/" + defect->field + " " + defect->message);
    require_files(scene, output.name());
    const ordered_json fields = value_of(scene, material);
    if (form == Form::safetensors) {
        std::vector<std::pair<std::string, std::string>> metadata;
        for (const auto& [key, value] : fields.items())
            metadata.emplace_back(key, value.is_string() ? value.get<std::string>() : text_of(value));
        output.write(safetensors_header(metadata, {}));
        return;
    }
    std::string text = "{";
    for (const auto& [key, value] : fields.items()) {
        text += (text.size() > 1 ? ",\n" : "\n") + text_of(key) + ": ";
        if (key == "trees" || key == "pulls" || key == "attachments" || key == "root_motion" || key == "balls" ||
            key == "walkers") { // one a line
            text += "[";
            for (const ordered_json& entry : value)
                text += (&entry == &value.front() ? "\n  " : ",\n  ") + text_of(entry);
            text += "]";
        } else {
            text += text_of(value);
        }
    }
    output.write(text + "\n}\n");
}

} // namespace bough

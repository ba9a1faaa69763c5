#include "scene.h"
#include "scene_fields.h"

namespace bough {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr DocumentType scene_type{"bough-scene", 1};
constexpr DocumentType wind_type{"bough-wind", 1};
const std::vector<std::string> poses{"drawn", "settled", "rest"};
const std::vector<std::string> inertias{"branch", "paper"};
const std::vector<std::string> contact_models{"impulse", "penalty"};

std::string text_of(const ordered_json& value) {
    return value.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

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

// One number, or a list of them.
void read_each(ObjectReader& object, const std::string& key, std::vector<double>& to) {
    if (!object.has(key)) return;
    const json& value = object.need(key);
    if (value.is_array()) return object.read(key, to);
    if (!value.is_number())
        object.fail(key, "is " + text_of(ordered_json(value)) + ", expected a number or a list of them");
    to = {value.get<double>()};
}

void read_each(ObjectReader& object, const std::string& name, const std::string& key, std::vector<std::int32_t>& to) {
    if (!object.has(key)) return;
    const json& value = object.need(key);
    if (!value.is_array()) {
        to.assign(1, 0);
        return object.read(key, to.front());
    }
    to.clear();
    for (const json& entry : value) {
        if (!entry.is_number_integer() || entry.get<double>() != entry.get<std::int32_t>())
            throw InputError(name + ": " + object.at(key) + "/" + std::to_string(to.size()),
                             "is " + text_of(ordered_json(entry)) + ", expected an integer of 32 bits");
        to.push_back(entry.get<std::int32_t>());
    }
}

// [x, z]
void read_point(ObjectReader& object, const std::string& key, double& x, double& z) {
    std::vector<double> numbers{x, z};
    object.read(key, numbers);
    if (numbers.size() != 2) object.fail(key, "has " + std::to_string(numbers.size()) + " numbers, expected 2 (x, z)");
    x = numbers[0];
    z = numbers[1];
}

WindGrid read_grid(const json& value, const std::string& name, const std::string& at) {
    WindGrid grid;
    ObjectReader object(value, name, at);
    object.need("origin");
    read_point(object, "origin", grid.x, grid.z);
    for (const auto& [key, number] : {std::pair{"columns", &grid.columns}, {"rows", &grid.rows}}) {
        object.need(key);
        object.read(key, *number);
    }
    object.need("cell");
    object.read("cell", grid.cell);
    object.read("velocity", grid.velocity);
    if (object.has("velocity") && grid.velocity.empty())
        object.fail("velocity", "is empty, expected one [x, y, z], or one for each cell");
    read_each(object, name, "octaves", grid.octaves);
    read_each(object, "persistence", grid.persistence);
    read_each(object, "phase", grid.phase);
    object.read("frequency", grid.frequency);
    object.finish();
    return grid;
}

WindSwirl read_swirl(const json& value, const std::string& name, const std::string& at) {
    WindSwirl swirl;
    ObjectReader object(value, name, at);
    read_point(object, "center", swirl.x, swirl.z);
    object.read("radius", swirl.radius);
    object.need("angle");
    read_each(object, "angle", swirl.angle);
    object.read("period", swirl.period);
    if (object.has("wavelength")) object.read("wavelength", swirl.wavelength.emplace());
    object.finish();
    return swirl;
}

// at: the wind's own JSON pointer.
void read_wind_fields(ObjectReader& object, Wind& wind, const std::string& name, const std::string& at) {
    object.need("velocity");
    object.read("velocity", wind.velocity);
    object.read("reference_height", wind.reference_height);
    object.read("profile", wind.profile);
    object.read("turbulence", wind.turbulence);
    object.read("gust_factor", wind.gust_factor);
    object.read("gust_period", wind.gust_period);
    object.read("seed", wind.seed);
    if (object.has("grid")) wind.grid = read_grid(object.need("grid"), name, at + "/grid");
    if (object.has("swirl")) wind.swirl = read_swirl(object.need("swirl"), name, at + "/swirl");
    if (object.has("shelter")) {
        ObjectReader shelter(object.need("shelter"), name, at + "/shelter");
        shelter.need("cell");
        shelter.read("cell", wind.shelter.emplace().cell);
        shelter.finish();
    }
    if (object.has("period")) object.read("period", wind.period.emplace());
    object.finish();
}

Wind read_wind_value(const json& value, const std::string& name) {
    if (value.is_string()) {
        const std::string preset = value.get<std::string>();
        if (const std::optional<Wind> wind = wind_preset(preset)) return *wind;
        throw InputError(name + ": /wind",
                         "is " + in_quotes(preset) + ", expected calm, breeze, gusty, storm or an object");
    }
    Wind wind;
    ObjectReader object(value, name, "/wind");
    read_wind_fields(object, wind, name, "/wind");
    return wind;
}

Placement read_placement(const json& value, const std::string& name, const std::string& at) {
    Placement tree;
    ObjectReader object(value, name, at);
    object.need("file");
    object.read("file", tree.file);
    object.read("position", tree.position);
    object.read("yaw", tree.yaw);
    object.finish();
    return tree;
}

Selector read_selector(const json& value, const std::string& name, const std::string& at) {
    const std::vector<std::string> ways{"body", "branch", "nearest", "level"};
    Selector on;
    ObjectReader object(value, name, at);
    std::vector<std::string> given;
    for (std::size_t i = 0; i < ways.size(); ++i)
        if (object.has(ways[i])) {
            given.push_back(ways[i]);
            on.by = Selector::By(i);
        }
    const auto only_for = [&](const char* key, bool allowed, const char* with) {
        if (object.has(key) && !allowed) object.fail(key, std::string("goes only with ") + with);
    };
    object.read("body", on.body);
    object.read("branch", on.branch);
    object.read("nearest", on.nearest);
    object.read("level", on.level);
    object.read("tree", on.tree);
    object.read("at", on.at);
    object.finish();
    if (given.empty()) throw InputError(name + ": " + at, "names no body, expected body, branch, nearest or level");
    if (given.size() > 1) object.fail(given[1], "stands beside " + in_quotes(given[0]) + ", expected only one of them");
    only_for("tree", on.by == Selector::By::body || on.by == Selector::By::branch, "body or branch");
    only_for("at", on.by == Selector::By::branch, "branch");
    return on;
}

Pull read_pull(const json& value, const std::string& name, const std::string& at) {
    Pull pull;
    ObjectReader object(value, name, at);
    pull.on = read_selector(object.need("on"), name, object.at("on"));
    object.need("time");
    object.read("time", pull.time);
    object.need("force");
    object.read("force", pull.force);
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

Fracture read_fracture(const json& value, const std::string& name) {
    Fracture fracture;
    ObjectReader object(value, name, "/fracture");
    for (const auto& [key, torque] : {std::pair{"branch", &fracture.branch},
                                      {"leaf", &fracture.leaf},
                                      {"petal", &fracture.petal},
                                      {"fruit", &fracture.fruit},
                                      {"strength", &fracture.strength},
                                      {"spread", &fracture.spread}})
        object.read(key, *torque);
    object.read("seed", fracture.seed);
    for (const json& entry : object.list("joints")) {
        const std::string at = object.at("joints") + "/" + std::to_string(fracture.joints.size());
        ObjectReader joint(entry, name, at);
        Fracture::Joint& to = fracture.joints.emplace_back();
        to.on = read_selector(joint.need("on"), name, joint.at("on"));
        joint.read("torque", to.torque);
        joint.finish();
    }
    object.finish();
    return fracture;
}

Ball read_ball(const json& value, const std::string& name, const std::string& at) {
    Ball ball;
    ObjectReader object(value, name, at);
    object.need("position");
    object.read("position", ball.position);
    object.read("velocity", ball.velocity);
    object.read("angular_velocity", ball.angular_velocity);
    object.need("radius");
    object.read("radius", ball.radius);
    object.need("mass");
    object.read("mass", ball.mass);
    object.finish();
    return ball;
}

Contact read_contact(const json& value, const std::string& name) {
    Contact contact;
    ObjectReader object(value, name, "/contact");
    contact.model = ContactModel(object.word("model", contact_models, std::size_t(contact.model)));
    object.read("restitution", contact.restitution);
    object.read("friction", contact.friction);
    object.read("penalty", contact.penalty);
    object.read("trees", contact.trees);
    object.read("leaves", contact.leaves);
    object.read("ground", contact.ground);
    object.read("ground_height", contact.ground_height);
    object.finish();
    return contact;
}

LeafAir read_leaves(const json& value, const std::string& name) {
    LeafAir leaves;
    ObjectReader object(value, name, "/leaves");
    object.read("kappa", leaves.kappa);
    object.read("air_resistance", leaves.air_resistance);
    object.read("drag_ratio", leaves.drag_ratio);
    object.read("offset", leaves.offset);
    object.finish();
    return leaves;
}

ordered_json numbers(const Vec3& v) {
    return {v.x(), v.y(), v.z()};
}

// One value by itself, more as a list.
template <class A> ordered_json each(const std::vector<A>& list) {
    return list.size() == 1 ? ordered_json(list.front()) : ordered_json(list);
}

ordered_json value_of(const WindGrid& grid) {
    ordered_json fields{
        {"origin", {grid.x, grid.z}}, {"cell", grid.cell}, {"columns", grid.columns}, {"rows", grid.rows}};
    if (grid.velocity.size() == 1)
        fields["velocity"] = numbers(grid.velocity.front());
    else
        for (const Vec3& v : grid.velocity) fields["velocity"].push_back(numbers(v));
    fields["octaves"] = each(grid.octaves);
    fields["persistence"] = each(grid.persistence);
    fields["phase"] = each(grid.phase);
    fields["frequency"] = grid.frequency;
    return fields;
}

ordered_json value_of(const WindSwirl& swirl) {
    ordered_json fields{{"center", {swirl.x, swirl.z}}};
    if (!swirl.radius.empty()) fields["radius"] = swirl.radius;
    fields["angle"] = swirl.radius.empty() ? each(swirl.angle) : ordered_json(swirl.angle);
    fields["period"] = swirl.period;
    if (swirl.wavelength) fields["wavelength"] = *swirl.wavelength;
    return fields;
}

ordered_json value_of(const Wind& wind) {
    ordered_json fields{{"velocity", numbers(wind.velocity)},
                        {"reference_height", wind.reference_height},
                        {"profile", wind.profile},
                        {"turbulence", wind.turbulence},
                        {"gust_factor", wind.gust_factor},
                        {"gust_period", wind.gust_period},
                        {"seed", wind.seed}};
    if (wind.grid) fields["grid"] = value_of(*wind.grid);
    if (wind.swirl) fields["swirl"] = value_of(*wind.swirl);
    if (wind.shelter) fields["shelter"] = {{"cell", wind.shelter->cell}};
    if (wind.period) fields["period"] = *wind.period;
    return fields;
}

ordered_json value_of(const Selector& on) {
    switch (on.by) {
    case Selector::By::body:
        return {{"tree", on.tree}, {"body", on.body}};
    case Selector::By::branch:
        return {{"tree", on.tree}, {"branch", on.branch}, {"at", on.at}};
    case Selector::By::nearest:
        return {{"nearest", numbers(on.nearest)}};
    case Selector::By::level:
        break;
    }
    return {{"level", on.level}};
}

ordered_json value_of(const RootMotion& motion) {
    ordered_json fields{{"tree", motion.tree}, {"time", motion.time}};
    for (const Vec3& p : motion.position) fields["position"].push_back(numbers(p));
    for (const Quat& q : motion.rotation) fields["rotation"].push_back(ordered_json{q.x(), q.y(), q.z(), q.w()});
    return fields;
}

// JSON has no infinity: what never breaks is left out.
ordered_json value_of(const Fracture& fracture) {
    ordered_json fields = ordered_json::object();
    for (const auto& [key, torque] : {std::pair{"branch", fracture.branch},
                                      {"leaf", fracture.leaf},
                                      {"petal", fracture.petal},
                                      {"fruit", fracture.fruit},
                                      {"strength", fracture.strength}})
        if (torque < Fracture::never) fields[key] = torque;
    fields["spread"] = fracture.spread;
    fields["seed"] = fracture.seed;
    for (const Fracture::Joint& joint : fracture.joints) {
        ordered_json entry{{"on", value_of(joint.on)}};
        if (joint.torque < Fracture::never) entry["torque"] = joint.torque;
        fields["joints"].push_back(entry);
    }
    return fields;
}

ordered_json value_of(const Ball& ball) {
    return {{"position", numbers(ball.position)},
            {"velocity", numbers(ball.velocity)},
            {"angular_velocity", numbers(ball.angular_velocity)},
            {"radius", ball.radius},
            {"mass", ball.mass}};
}

ordered_json value_of(const Contact& contact) {
    return {{"model", contact_models[std::size_t(contact.model)]},
            {"restitution", contact.restitution},
            {"friction", contact.friction},
            {"penalty", contact.penalty},
            {"trees", contact.trees},
            {"leaves", contact.leaves},
            {"ground", contact.ground},
            {"ground_height", contact.ground_height}};
}

ordered_json value_of(const Scene& scene) {
    ordered_json fields{{"format", scene_type.format}, {"version", scene_type.version}};
    fields["trees"] = ordered_json::array();
    for (const Placement& tree : scene.trees)
        fields["trees"].push_back({{"file", tree.file}, {"position", numbers(tree.position)}, {"yaw", tree.yaw}});
    fields["gravity"] = numbers(scene.gravity);
    if (scene.wind) fields["wind"] = value_of(*scene.wind);
    fields["air_density"] = scene.air_density;
    fields["pulls"] = ordered_json::array();
    for (const Pull& pull : scene.pulls) {
        ordered_json force = ordered_json::array();
        for (const Vec3& f : pull.force) force.push_back(numbers(f));
        fields["pulls"].push_back({{"on", value_of(pull.on)}, {"time", pull.time}, {"force", force}});
    }
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
    if (scene.contact) fields["contact"] = value_of(*scene.contact);
    if (scene.leaves)
        fields["leaves"] = {{"kappa", scene.leaves->kappa},
                            {"air_resistance", scene.leaves->air_resistance},
                            {"drag_ratio", scene.leaves->drag_ratio},
                            {"offset", scene.leaves->offset}};
    fields["stiffness_scale"] = scene.stiffness_scale;
    fields["damping_scale"] = scene.damping_scale;
    return fields;
}

} // namespace

bool is_scene(std::string_view content) {
    return document_format(content) == scene_type.format;
}

Scene read_scene(std::string_view content, const std::string& name) {
    const json fields = fields_of(content, name, scene_type);
    Scene scene;
    ObjectReader object(fields, name, "");
    read_type(object, name, scene_type);
    for (const json& value : object.list("trees"))
        scene.trees.push_back(read_placement(value, name, "/trees/" + std::to_string(scene.trees.size())));
    object.read("gravity", scene.gravity);
    if (object.has("wind")) scene.wind = read_wind_value(object.need("wind"), name);
    object.read("air_density", scene.air_density);
    for (const json& value : object.list("pulls"))
        scene.pulls.push_back(read_pull(value, name, "/pulls/" + std::to_string(scene.pulls.size())));
    for (const json& value : object.list("root_motion"))
        scene.root_motion.push_back(
            read_root_motion(value, name, "/root_motion/" + std::to_string(scene.root_motion.size())));
    scene.pose = Pose(object.word("pose", poses, std::size_t(scene.pose)));
    scene.joint_inertia = JointInertia(object.word("joint_inertia", inertias, std::size_t(scene.joint_inertia)));
    if (object.has("joint_limit")) scene.joint_limit = read_joint_limit(object.need("joint_limit"), name);
    if (object.has("fracture")) scene.fracture = read_fracture(object.need("fracture"), name);
    for (const json& value : object.list("balls"))
        scene.balls.push_back(read_ball(value, name, "/balls/" + std::to_string(scene.balls.size())));
    if (object.has("contact")) scene.contact = read_contact(object.need("contact"), name);
    if (object.has("leaves")) scene.leaves = read_leaves(object.need("leaves"), name);
    object.read("stiffness_scale", scene.stiffness_scale);
    object.read("damping_scale", scene.damping_scale);
    object.finish();
    refuse(check(scene), name, {});
    return scene;
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

void write_scene(Output& output, const Scene& scene, Form form) {
    if (const std::optional<Defect> defect = check(scene))
        throw OutputError(output.name(), "/" + defect->field + " " + defect->message);
    const ordered_json fields = value_of(scene);
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
        if (key == "trees" || key == "pulls" || key == "root_motion" || key == "balls") { // one a line
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

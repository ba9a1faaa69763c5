#include "scene_parts.h"

namespace bough {

using nlohmann::json;
using nlohmann::ordered_json;

std::string text_of(const ordered_json& value) {
    return value.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

ordered_json numbers(const Vec3& v) {
    return {v.x(), v.y(), v.z()};
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
    if (object.has("point")) object.read("point", on.point.emplace());
    object.finish();
    if (given.empty()) throw InputError(name + ": " + at, "names no body, expected body, branch, nearest or level");
    if (given.size() > 1) object.fail(given[1], "stands beside " + in_quotes(given[0]) + ", expected only one of them");
    only_for("tree", on.by == Selector::By::body || on.by == Selector::By::branch, "body or branch");
    only_for("at", on.by == Selector::By::branch, "branch");
    only_for("point", on.by == Selector::By::body, "body");
    return on;
}

ordered_json value_of(const Selector& on) {
    switch (on.by) {
    case Selector::By::body: {
        ordered_json fields{{"tree", on.tree}, {"body", on.body}};
        if (on.point) fields["point"] = numbers(*on.point);
        return fields;
    }
    case Selector::By::branch:
        return {{"tree", on.tree}, {"branch", on.branch}, {"at", on.at}};
    case Selector::By::nearest:
        return {{"nearest", numbers(on.nearest)}};
    case Selector::By::level:
        break;
    }
    return {{"level", on.level}};
}

} // namespace bough

#include "set_option.h"
#include "exits.h"

namespace bough {

void add_set_option(OptionList& list, std::vector<std::string>& set) {
    list.add("--set", set,
             "Replaces a field of the scene (of an empty one where INPUT is a tree), any number of times: names "
             "with points between them, elements of lists by number. wind.velocity=[8,0,0], trees.0.yaw=30, "
             "pose=settled, material.E=9e9. VALUE is JSON, or else text. Comes last: after what the scene says "
             "and options such as --wind, in the order given")
        .takes("PATH=VALUE")
        .any_number_of_times();
}

std::vector<SceneOverride> overrides_of(const std::vector<std::string>& set) {
    std::vector<SceneOverride> overrides;
    for (const std::string& text : set) {
        try {
            overrides.push_back(parse_override("--set", text));
        } catch (const std::invalid_argument& error) {
            throw UsageError(std::string("--set ") + error.what());
        }
    }
    return overrides;
}

bool sets_field(const std::vector<std::string>& set, const std::string& field) {
    for (const SceneOverride& change : overrides_of(set))
        if (change.path.front() == field) return true;
    return false;
}

} // namespace bough

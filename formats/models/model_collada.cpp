#include "model_collada.h"
#include "formats/plain_text.h"
#include <pugixml.hpp>

namespace bough {
namespace {

std::string_view without_prefix(std::string_view name) {
    const std::size_t colon = name.find(':');
    return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

std::optional<Vec3> tip_of(const pugi::xml_node& node) {
    for (const pugi::xml_node& extra : node.children("extra"))
        for (const pugi::xml_node& technique : extra.children("technique")) {
            Vec3 tip;
            const char* const names[3] = {"tip_x", "tip_y", "tip_z"};
            bool whole = true;
            for (int k = 0; k < 3 && whole; ++k) {
                const std::optional<double> number = parse_number(trimmed(technique.child(names[k]).text().get()));
                whole = number.has_value();
                if (whole) tip[k] = *number;
            }
            if (whole) return tip;
        }
    return {};
}

struct Walker : pugi::xml_tree_walker {
    std::unordered_map<std::string, ColladaJoint> joints;
    bool for_each(pugi::xml_node& node) override {
        if (without_prefix(node.name()) != "node" || node.attribute("type").as_string() != std::string_view("JOINT"))
            return true;
        const char* const id = node.attribute("id").as_string();
        joints.try_emplace(*id != '\0' ? id : node.attribute("name").as_string(),
                           ColladaJoint{node.attribute("sid").as_string(), tip_of(node)});
        return true;
    }
};

} // namespace

std::unordered_map<std::string, ColladaJoint> collada_joints(std::string_view content) {
    pugi::xml_document document;
    Walker walker;
    if (document.load_buffer(content.data(), content.size())) document.traverse(walker);
    return std::move(walker.joints);
}

} // namespace bough

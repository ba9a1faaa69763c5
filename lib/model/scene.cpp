#include "scene.h"

namespace bough {

std::size_t Scene::add(Tree tree, const Vec3& position, double yaw) {
    return add(std::make_shared<const Tree>(std::move(tree)), position, yaw);
}

std::size_t Scene::add(std::shared_ptr<const Tree> tree, const Vec3& position, double yaw) {
    trees.push_back({"", position, yaw, 0, std::move(tree)});
    return trees.size() - 1;
}

} // namespace bough

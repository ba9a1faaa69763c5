#include "plan.h"

namespace bough {

const char* free_part(const Scene& scene) {
    return scene.fracture           ? "/fracture"
           : !scene.balls.empty()   ? "/balls"
           : !scene.walkers.empty() ? "/walkers"
                                    : nullptr;
}

bool may_push(const Scene& scene) {
    const Contact contact = scene.contact.value_or(Contact());
    if (!contact.trees) return false;
    if (!scene.balls.empty()) return true;
    if (!scene.fracture) return false;
    const Fracture& f = *scene.fracture;
    const bool wood =
        f.branch < Fracture::never || f.fruit < Fracture::never || f.strength < Fracture::never || !f.joints.empty();
    return wood || contact.leaves;
}

} // namespace bough

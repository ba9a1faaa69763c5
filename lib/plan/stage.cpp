#include "stage.h"

namespace bough {

const char* stage_name(Stage stage) {
    static constexpr const char* names[stage_count] = {
        "wind_field", "external_forces", "composite",   "drag",       "root_motion", "fictitious",
        "spring",     "articulated",     "midpoint",    "body_loads", "attachments", "resolvent",
        "lanes",      "state_update",    "free_flight", "contacts",   "fracture",    "walkers"};
    return names[std::size_t(stage)];
}

} // namespace bough

// lib/growth/stand.h: grown trees stand as they are drawn, by the exact stiffness of study/small_motion.h, whole and on any number of bodies.
#include "lib/growth/stand.h"
#include "formats/documents/species.h"
#include "lib/growth/grow.h"
#include "lib/growth/segment.h"
#include "lib/study/small_motion.h"
#include "tests/support/hand_made.h"
#include "tests/support/sanitized.h"
#include <numbers>

using namespace bough;
using namespace hand_made;

namespace {

using std::numbers::pi;

bool stands(const Splines& splines, const Material& wood) {
    return SmallMotion(segment(splines, wood, {}), Vec3(0, -9.81, 0), Pose::drawn).buckled().empty();
}

// A twig that stands on a level arm: an L, whose arm twists under it.
Splines corner(double radius) {
    Splines s;
    add_branch(s, -1, 0, {{0, 0, 0}, {0, 1, 0}}, {0.1, 0.1});
    add_branch(s, 0, 1, {{0, 1, 0}, {1, 1, 0}}, {radius, radius});
    add_branch(s, 1, 1, {{1, 1, 0}, {1, 2, 0}}, {radius, radius});
    return s;
}

} // namespace

TEST_CASE("Default trees of all species stand as drawn, in leaf, on 300 to 20 000 bodies") {
    for (const SpeciesFile& file : species_files()) {
        const Species species = read_species(file.content, std::string(file.name));
        Splines splines = grow(species.growth, 1, {true, false, true});
        for (const std::int64_t bodies : cases<std::int64_t>(1, {300, 20000})) {
            INFO(species.name << ", " << bodies << " bodies");
            splines.bodies = bodies;
            CHECK(stands(splines, species.growth.wood));
        }
    }
    for (const std::uint64_t seed : cases<std::uint64_t>(1, {0, 1, 2}))
        CHECK(stands(grow(default_growth(), seed, {true, false, true}), default_growth().wood));
}

TEST_CASE("What twists over under its weight is made thicker until twice as much would stand, and no more than that") {
    Splines s = corner(0.0035);
    REQUIRE_FALSE(stands(s, wood()));
    CHECK(thicken_to_stand(s, wood(), 3) == 0);
    CHECK(stands(s, wood()));
    Material heavy = wood(); // twice the weight on the same wood, and a little less than that
    heavy.density *= 1.99;
    CHECK(stands(s, heavy));
    const double radius = s.radius[2];
    CHECK(radius > 0.0035);
    CHECK(thicken_to_stand(s, wood(), 3) == 0);
    CHECK(s.radius[2] == radius);
}

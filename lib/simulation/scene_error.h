// scene_error.h: what the library throws for a scene, a tree or an option that it cannot run: the one exception type of the door (simulation.h).
#pragma once
#include <stdexcept>
#include <string>

namespace bough {

// what(): the place in the scene where there is one, what is wrong and what was expected, in one line, as treesim prints it behind the file.
struct SceneError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

} // namespace bough

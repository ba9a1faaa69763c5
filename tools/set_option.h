// set_option.h: --set PATH=VALUE, which replaces a field of the scene's document before it is read.
#pragma once
#include "common.h"
#include "formats/documents/scene.h"

namespace bough {

void add_set_option(CLI::App&, std::vector<std::string>& set);

// In the order given. Throws UsageError for what is no PATH=VALUE.
std::vector<SceneOverride> overrides_of(const std::vector<std::string>& set);

} // namespace bough

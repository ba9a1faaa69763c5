// set_option.h: --set PATH=VALUE, which replaces a field of the scene's document before it is read.
#pragma once
#include "formats/documents/scene.h"
#include "option_list.h"

namespace bough {

void add_set_option(OptionList&, std::vector<std::string>& set);

// In the order given. Throws UsageError for what is no PATH=VALUE.
std::vector<SceneOverride> overrides_of(const std::vector<std::string>& set);

// Whether one of them replaces this field of the scene, or a part of it. Throws UsageError.
bool sets_field(const std::vector<std::string>& set, const std::string& field);

} // namespace bough

// eztree.h: preset files of ez-tree (JSON, as its site saves them and its package holds them).
#pragma once
#include "formats/error.h"
#include "lib/growth/eztree.h"
#include <string>
#include <string_view>
#include <vector>

namespace bough {

// A JSON object with "branch" and "leaves" of which one has ez-tree's names. Any other JSON, or none: false.
bool is_eztree(std::string_view content);

// Every geometric parameter is taken; where the preset leaves one out, it has ez-tree's own default (its options.js).
// What is not honoured because bodies have no such thing is named in `notes` (bark, radial segments, the leaves' picture,
// tint and second quad, the trellis' own bars). A field that ez-tree does not have, or of a wrong type, and a value out of
// its range throw InputError with place `name`: its JSON pointer.
EzTreeParameters read_eztree(std::string_view content, const std::string& name, std::vector<std::string>& notes);

} // namespace bough

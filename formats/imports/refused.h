// refused.h: files that hold no tree we can read: what each is, by its content first, its name second, and what its user
// should export instead, in one line.
#pragma once
#include <string>
#include <string_view>

namespace bough {

// Throws InputError (place `name`) for content that no reader recognizes: a well-known format with advice, another kind
// of bough document, parameters of a generator, prose, blanks or nothing. O(1): looks at the head, and at the name.
[[noreturn]] void refuse_unread(std::string_view content, const std::string& name);

// Whether it is a well-known format of these, by how it begins or, where that is no JSON, by its name's ending. O(1).
bool is_known_unread(std::string_view content, const std::string& name);

} // namespace bough

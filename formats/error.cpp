// error.cpp: an error's text is one line of UTF-8, whatever a file's words or a path are.
#include "error.h"
#include "plain_text.h"

namespace bough {

InputError::InputError(const std::string& place, const std::string& message)
    : std::runtime_error(valid_utf8(place + ": " + message)) {}
OutputError::OutputError(const std::string& file, const std::string& message)
    : std::runtime_error(valid_utf8(file + ": " + message)) {}

} // namespace bough

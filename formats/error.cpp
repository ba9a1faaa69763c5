// error.cpp: an error's text is one line of UTF-8, whatever a file's words or a path are, and no longer than someone reads.
#include "error.h"
#include "plain_text.h"
#include <utility>

namespace bough {
namespace {

// A path has up to 4096 bytes, and stays whole.
constexpr std::size_t longest = 6000, kept_at_end = 1000;

std::string said(std::string text) {
    if (text.size() > longest)
        text = text.substr(0, longest - kept_at_end) + " ... " + text.substr(text.size() - kept_at_end);
    return valid_utf8(std::move(text));
}

} // namespace

InputError::InputError(const std::string& place, const std::string& message)
    : std::runtime_error(said(place + ": " + message)) {}
OutputError::OutputError(const std::string& file, const std::string& message)
    : std::runtime_error(said(file + ": " + message)) {}

} // namespace bough

// in_shell.h: what a message tells the user to type.
#pragma once
#include <string>

namespace bough {

// An argument as a shell takes it, on one line: quoted where it has to be.
std::string in_shell(const std::string& argument);

} // namespace bough

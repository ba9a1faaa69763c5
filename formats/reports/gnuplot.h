// gnuplot.h: pictures by gnuplot, as a child process without a shell and without temporary files.
#pragma once
#include <string>
#include <string_view>

namespace bough {

// The <svg> element, fit for a page, that gnuplot makes of a script (without `set terminal` and `set output`), width x height in pixels,
// UTF-8, without the user's own gnuplot settings. `name` is the file the picture is for: throws OutputError for it where
// gnuplot is not installed or refuses the script.
std::string gnuplot_svg(const std::string& script, int width, int height, const std::string& name);
// Throws that OutputError where gnuplot cannot be started: before work whose result needs it.
void require_gnuplot(const std::string& name);

// A text for a gnuplot script, in quotes; gnuplot takes it literally. In one line, control characters as '?'.
std::string gnuplot_text(std::string_view);

} // namespace bough

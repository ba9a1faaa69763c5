#include "bark_form.h"
#include <initializer_list>
#include <stdexcept>

namespace bough {

void check_bark_form(const BarkForm& f) {
    bool known = false;
    for (const char* name : {"furrowed", "plated", "papery", "banded", "ringed"}) known |= f.pattern == name;
    const auto require = [](bool good, const char* text) {
        if (!good) throw std::invalid_argument(text);
    };
    require(known, "bark is out of range, expected furrowed, plated, papery, banded or ringed");
    require(f.cells >= 1 && f.cells <= 64, "bark_cells is out of range, expected 1 to 64");
    require(f.stretch > 0 && f.stretch <= 20, "bark_stretch is out of range, expected more than 0 and at most 20");
    require(f.depth >= 0 && f.depth <= 1, "bark_depth is out of range, expected 0 to 1");
}

} // namespace bough

// bark_form.h: how a species' bark looks: a pattern and its measures. Nothing of it moves a tree.
#pragma once
#include <string>

namespace bough {

struct BarkForm {
    std::string pattern = "furrowed"; // furrowed, plated, papery, banded or ringed
    double cells = 10;  // ridges, plates or rows of marks around a stem; rings on as much of its length as it is around
    double stretch = 4; // [1] how much longer than wide they are
    double depth = 0.6; // [1] 0: smooth, 1: deep
};

// Throws std::invalid_argument for the first value out of its range, named as in the species document ("bark_cells").
void check_bark_form(const BarkForm&);

} // namespace bough

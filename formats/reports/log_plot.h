// log_plot.h: what the plots on logarithmic axes share (error_plot.cpp, scaling_plot.cpp).
#pragma once
#include <array>
#include <cmath>

namespace bough {

// Told apart by people of any colour vision (Okabe and Ito); the marks tell them apart too.
constexpr std::array<const char*, 8> colours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                "#e69f00", "#56b4e9", "#1b1b1b", "#8c8c8c"};
constexpr int picture_width = 1080, plot_height = 560, key_line = 21; // pixels

// A logarithm has a place for it.
inline bool drawable(double value) {
    return std::isfinite(value) && value > 0;
}

} // namespace bough

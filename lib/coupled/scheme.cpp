#include "scheme.h"
#include <cstddef>

namespace bough {

const RationalScheme& scheme_of(Scheme scheme) {
    using Z = std::complex<double>;
    constexpr double root2 = 1.4142135623730950488;
    static const std::array<RationalScheme, all_schemes.size()> table{{
        {"P12", {{{Z(2, root2), Z(-0.5, -root2)}}}},
        {"P.25", {{{Z(2.25, 1.5612494995995995515), Z(-0.375, -1.8614897879841379267)}}}},
        {"P.5", {{{Z(2.5, 1.6583123951776999246), Z(-0.25, -2.3367129204776680755)}}}},
        {"P34",
         {{{Z(4.7871931031284660167, 1.5674764168952081241), Z(-1.2013771353770559552, -12.155056450829214566)},
           {Z(3.2128068968715339829, 4.7730874332766424998), Z(0.70137713537705595524, 2.8398661208922514883)}}},
         2},
        {"LIE", {{{Z(1), Z(-1)}}}, 1, true, false},
    }};
    return table[std::size_t(scheme)];
}

} // namespace bough

// rustle.h: how the leaves that a clump is drawn as (clump.h) move on their own, which is drawn alone: no force comes of it and no step knows
// of it. A clump's body moves them all; each turns besides about its own foot.
//
// Law. In a wind of speed U a leaf turns about an axis in its blade, through its foot and up to 45 degrees off its width (so that some flap
// more and some twist more), by
//   theta = A(U) (sin(phi) + sin(psi)),   A(U) = 20 deg (1 - e^(-(U / 6 m/s)^2))
//   d phi / dt = 2 pi c f(U),   d psi / dt = 0.62 d phi / dt,   f(U) = 1.45 Hz sqrt(U / (1 m/s)), at most 4.2 Hz
// c a leaf's own, 0.8 to 1.05, as are the phases at time 0. A is theta's root mean square: 0 in a calm, 2 degrees at 2 m/s, 12.6 at 6, 16.6 at 8,
// never above 20. The two tones, whose ratio is no simple fraction, make it come and go as a leaf's fluttering does.
// Sizes are those of leaves in wind tunnels and on trees, the curves our own: a leaf's torsional galloping begins at a low speed and grows
// (Tadrist, Julio, Saudreau, de Langre 2015, J. Fluids Struct. 56, 1); at low wind leaves flutter at their own few Hz while their branches
// stand, and are carried by these at high wind (Tadrist et al. 2018, J. R. Soc. Interface 15: 20180010); they reconfigure with speed (Vogel
// 1989, J. Exp. Bot. 40, 941), why A saturates. The ceiling of f keeps a leaf from turning by more than 30 degrees between frames at 30 a
// second, beyond which leaves flicker.
//
// Phases are integrated over the frames (trapezoidal rule) from time 0 at each clump's place as drawn, so that they are continuous whatever
// the wind does, and a run that is resumed, or made by other threads, has the same leaves. Where the wind repeats after a whole number of frames
// each rate is changed by the little that makes its phase come to whole turns then.
// Cost: O(clumps) wind speeds and O(leaves) a frame; nothing where the skin has no clumps.
#pragma once
#include "skin.h"
#include <functional>
#include <optional>

namespace bough {

double rustle_amplitude(double wind); // [rad] RMS in a wind of so many m/s
double rustle_frequency(double wind); // [Hz]

// The body of each clump of the skin, in order.
std::vector<std::int32_t> clumps_of(const Skin&);

// Fills in the wind's speed [m/s] at each of clumps_of() at a time [s].
using ClumpWind = std::function<void(double time, std::vector<double>& speed)>;

struct RustleOptions {
    double fps = 30;
    std::optional<double> period; // [s] after which the wind repeats
    // All leaves by the mean of the clumps' wind speeds, with c = 1: what few morph targets can hold.
    bool together = false;
};

class Rustle {
public:
    // Keeps a reference to the skin.
    Rustle(const Skin&, ClumpWind, const RustleOptions&);
    // Frames may only rise; those left out are gone through.
    void go_to(std::int64_t frame);
    // Turns the leaves of a skin that its bodies have moved (SkinDeformer), each by itself.
    void turn(std::vector<Vec3>& position, std::vector<Vec3>& normal) const;

    // As morph targets: position and normal of each vertex go by the sum over four of weight times change, to first order in theta: a blade
    // seems longer by sqrt(1 + theta^2), 4 % at 16 degrees. Only of a rustle that goes together.
    static constexpr std::size_t targets = 4;
    std::array<double, targets> weights() const; // of the frame [rad]
    // Of leaf k of the skin's clump_leaf, as drawn: its axis times how target m goes with its phases; what moves is r from the foot, by this x r.
    Vec3 target(std::size_t leaf, std::size_t m) const;
    Vec3 foot(std::size_t leaf) const; // [m] drawn

private:
    struct Leaf {
        std::int32_t clump;
        double off_width;    // [rad] of its axis
        double rate, second; // of the clump's phase: c, and of the second tone
        double phase, psi;   // [rad] at time 0
    };
    void advance();
    std::size_t paths() const { return together_ ? 1 : clumps_.size(); }

    const Skin& skin_;
    ClumpWind wind_;
    double fps_;
    bool together_;
    std::vector<std::int32_t> clumps_;
    std::vector<Leaf> leaves_;
    std::int64_t frame_ = 0;
    std::vector<double> speed_;                    // [m/s] of clumps
    std::vector<double> amplitude_, rate_, phase_; // of each path: [rad], [rad/s], [rad]
};

} // namespace bough

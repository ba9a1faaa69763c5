// dynamic_wind.h: which joints of a .glb move together in Unreal's wind: the JSON that the plugin Dynamic Wind (Unreal
// 5.7, experimental) imports onto a skeletal mesh (Import Dynamic Wind Skeletal Data from File).
//
// The fields are those of its structs FDynamicWindSkeletalImportData, FDynamicWindJointImportData and
// FDynamicWindSimulationGroupData (Epic's API reference), laid out as SpeedAssembly's exporter writes them (github.com/
// VitalyVishnev/SpeedAssembly, docs/raw/wind_dynamic_json.md, from Epic's and Quixel's own files):
//   Joints            JointName (the .glb's, body_N), SimulationGroupIndex
//   SimulationGroups  bUseDualInfluence, Influence, MinInfluence, MaxInfluence, ShiftTop, bIsTrunkGroup: of group 0
//   bIsGroundCover false, GustAttenuation 0
// Influences are fitted to a run's motion. A joint's turn is the root mean square, over frames, of the angle that it has turned from where it was
// drawn, in the joint that bears it. Of a group, the turns of its joints of wood are fitted by least squares:
//     turn = T Influence,      or, where that leaves 5 % less of their squares and does not fall towards the tip (bUseDualInfluence),
//     turn = T (MinInfluence + (MaxInfluence - MinInfluence) max(0, (s - ShiftTop) / (1 - ShiftTop))),
// s from 0 at the first joint of the group's branch to 1 at its last; T makes the largest of all 1, the most that the fields take. (What the plugin
// makes of the two influences is told by no source that we know: that it goes from one to the other along the branch, and that ShiftTop moves that
// towards the top, is what its fields' names and SpeedAssembly's page say.) A group without wood has 1: leaves turn most.
// A joint's group is how many branches it is away from a trunk, whatever the tree's levels say: the plugin takes a path of
// joints of one group for a branch, so of those that leave a joint only the one that goes on its branch may have its group.
// O(joints). Throws OutputError.
#pragma once
#include "formats/open.h"
#include "lib/growth/merge_joints.h"
#include <span>

namespace bough {

// The group of each joint, 0 for trunks.
std::vector<std::int32_t> wind_groups(const Tree&, const JointGroups&);

// Joints outside the trunks whose branch stands vertically, to 1e-4: the plugin's shader crosses their x axis with the vertical, which says nothing
// of them unless they are turned a little.
std::vector<std::int32_t> vertical_joints(const Tree&, const JointGroups&);

struct WindInfluence { // of a group, 0 to 1
    double influence = 1, least = 0, most = 0, shift = 0;
    bool dual = false;
    // What that is for a joint at s along its branch.
    double at(double s) const;
};

struct WindFit {
    std::vector<WindInfluence> group;
    double unit = 0;      // [rad] that influence 1 stands for: T
    double rms = 0;       // [rad] of the fitted joints' turns
    double off = 0;       // [rad] root mean square of what is left of them
    double explained = 0; // share of their variance; 0 where they do not vary
};

// Adds up the turns of a run's frames.
class WindMotion {
public:
    WindMotion(const Tree&, const JointGroups&);
    void add(std::span<const Quat> R_wb); // world from body, of all bodies
    // After at least one frame. O(joints).
    WindFit fit() const;

private:
    const Tree& tree_;
    const JointGroups groups_;
    std::vector<Quat> drawn_; // in the joint that bears it
    std::vector<double> squares_;
    std::int64_t frames_ = 0;
};

void write_dynamic_wind(Output&, const Tree&, const JointGroups&, const WindFit&);

} // namespace bough

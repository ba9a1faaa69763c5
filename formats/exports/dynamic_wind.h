// dynamic_wind.h: which joints of a .glb move together in Unreal's wind: the JSON that the plugin Dynamic Wind (Unreal
// 5.7, experimental) imports onto a skeletal mesh (Import Dynamic Wind Skeletal Data from File).
//
// The fields are those of its structs FDynamicWindSkeletalImportData, FDynamicWindJointImportData and
// FDynamicWindSimulationGroupData (Epic's API reference), laid out as SpeedAssembly's exporter writes them (github.com/
// VitalyVishnev/SpeedAssembly, docs/raw/wind_dynamic_json.md, from Epic's and Quixel's own files):
//   Joints            JointName (the .glb's, body_N), SimulationGroupIndex
//   SimulationGroups  bUseDualInfluence false, Influence 1, MinInfluence 0, MaxInfluence 0, ShiftTop 0 (the plugin's own
//                     defaults: how much each group moves is the artist's choice), bIsTrunkGroup: of group 0
//   bIsGroundCover false, GustAttenuation 0
// A joint's group is how many branches it is away from a trunk, whatever the tree's levels say: the plugin takes a path of
// joints of one group for a branch, so of those that leave a joint only the one that goes on its branch may have its group.
// O(joints). Throws OutputError.
#pragma once
#include "formats/open.h"
#include "lib/growth/merge_joints.h"

namespace bough {

// The group of each joint, 0 for trunks.
std::vector<std::int32_t> wind_groups(const Tree&, const JointGroups&);

void write_dynamic_wind(Output&, const Tree&, const JointGroups&);

} // namespace bough

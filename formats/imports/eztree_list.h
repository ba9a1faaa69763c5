// eztree_list.h: the numbers of a list of ez-tree's branches (JSON), nothing interpreted; eztree_branches.cpp makes a tree
// of them.
#pragma once
#include "lib/base/math.h"
#include <string>
#include <string_view>
#include <vector>

namespace bough::eztree {

struct Listed {
    std::int64_t level = 0, parent = -1;                    // parent: number of a branch before
    bool has_parent = false;                                // the list says it
    Vec3 origin = Vec3::Zero(), orientation = Vec3::Zero(); // [file unit], [rad] about x, y, z
    double length = 0, radius = 0;                          // [file unit]
};

struct Dump {
    std::vector<Listed> branches;
    std::string_view options; // text of the preset, if the file holds it
};

// Of {"branches": [...], "options": {...}} or the array alone; other keys are left alone. Throws InputError FILE:LINE for
// broken JSON, a field that is missing or of the wrong kind, and a list without branches. O(size).
Dump read_dump(std::string_view content, const std::string& name);

// "NAME: /branches/AT MESSAGE".
[[noreturn]] void refuse(const std::string& name, std::size_t at, const std::string& message);

} // namespace bough::eztree

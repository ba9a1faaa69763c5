#include "armature.h"
#include "formats/plain_text.h"
#include "lib/base/counted.h"
#include <algorithm>
#include <array>

namespace bough {
namespace {

bool named_as_end(std::string_view name) {
    const std::string small = lower_case(name);
    for (const char* ending : {"_end", ".end", "end site", "nub"})
        if (small.ends_with(ending)) return true;
    return false;
}

struct Choice {
    const ModelScene& scene;
    std::vector<char> candidate, leaf;    // leaf: no candidate below
    std::vector<std::int32_t> above;      // nearest candidate above each node
    std::vector<std::int64_t> own, below; // vertices that a node moves most; with all below it
};

Choice candidates(const ModelScene& scene) {
    const std::size_t n = scene.parent.size();
    Choice c{scene,
             std::vector<char>(n, false),
             std::vector<char>(n, true),
             std::vector<std::int32_t>(n, -1),
             std::vector<std::int64_t>(n, 0),
             {}};
    std::vector<char> has_child(n, false);
    for (const std::int32_t p : scene.parent)
        if (p >= 0) has_child[p] = true;
    for (std::size_t i = 0; i < n; ++i) {
        const std::int32_t p = scene.parent[i];
        if (p >= 0) c.above[i] = c.candidate[p] ? p : c.above[p];
        const bool is_end = c.above[i] >= 0 && !has_child[i] && named_as_end(scene.name[i]);
        c.candidate[i] =
            scene.role[i] == NodeRole::joint || (scene.role[i] == NodeRole::open && (scene.open_are_joints || is_end));
    }
    for (const std::int32_t node : scene.vertex_node) ++c.own[node];
    return c;
}

void sum_below(Choice& c) {
    c.below = c.own;
    std::fill(c.leaf.begin(), c.leaf.end(), true);
    for (std::size_t i = c.candidate.size(); i-- > 0;) {
        if (!c.candidate[i] || c.above[i] < 0) continue;
        c.below[c.above[i]] += c.below[i];
        c.leaf[c.above[i]] = false;
    }
}

void find_above(Choice& c) {
    for (std::size_t i = 0; i < c.candidate.size(); ++i) {
        const std::int32_t p = c.scene.parent[i];
        c.above[i] = p < 0 ? -1 : c.candidate[p] ? p : c.above[p];
    }
}

// Topmost nodes that are the armature's frame. Two at most, one above the other.
std::size_t leave_out_frames(Choice& c, const Vec3& up) {
    std::size_t count = 0;
    for (int round = 0; round < 2; ++round) {
        find_above(c);
        std::vector<char> rises(c.candidate.size(), false), has_child(c.candidate.size(), false);
        for (std::size_t i = 0; i < c.candidate.size(); ++i) {
            if (!c.candidate[i] || c.above[i] < 0) continue;
            const Vec3 step = c.scene.place[i] - c.scene.place[c.above[i]];
            const double rise = step.dot(up);
            has_child[c.above[i]] = true;
            if (rise > (step - rise * up).norm()) rises[c.above[i]] = true;
        }
        std::size_t found = 0;
        for (std::size_t i = 0; i < c.candidate.size(); ++i)
            if (c.candidate[i] && c.above[i] < 0 && c.scene.role[i] == NodeRole::open && has_child[i] && !rises[i]) {
                c.candidate[i] = false;
                ++found;
            }
        count += found;
        if (found == 0) break;
    }
    find_above(c);
    return count;
}

// Nodes below which no vertex moves, where others move some: kept is the one that ends a chain. Returns how many go.
std::size_t leave_out_idle(Choice& c, std::vector<char>& mark) {
    sum_below(c);
    const std::size_t n = c.candidate.size();
    std::vector<std::int32_t> moving(n, 0), idle(n, 0); // children of each kind
    for (std::size_t i = 0; i < n; ++i)
        if (c.candidate[i] && c.above[i] >= 0) ++(c.below[i] > 0 ? moving : idle)[c.above[i]];
    std::size_t count = 0;
    for (std::size_t i = 0; i < n; ++i) {
        if (!c.candidate[i] || c.below[i] > 0) continue;
        const std::int32_t p = c.above[i];
        if (p >= 0 && !c.candidate[p]) { // goes with what it hangs on
            c.candidate[i] = false;
            ++count;
            continue;
        }
        if (mark[i]) continue;
        const bool ends_chain = p >= 0 && (c.below[p] == 0 || (moving[p] == 0 && idle[p] == 1));
        if (!ends_chain) {
            c.candidate[i] = false;
            ++count;
        } else if (c.leaf[i]) {
            mark[i] = true;
        }
    }
    return count;
}

// A topmost bone with a chain of others below it, where none of them moves a vertex and other bones do: an armature of its
// own (a second tree, a rig that the mesh has left) rather than controls, which stand alone. Leaves all of its bones out.
struct Bare {
    std::size_t armatures = 0, bones = 0;
    std::string name; // of the first
};

Bare leave_out_bare_armatures(Choice& c) {
    Bare bare;
    const std::size_t n = c.candidate.size();
    std::vector<char> is_bare(n, false);
    std::vector<std::int32_t> top(n);
    for (std::size_t i = 0; i < n; ++i) top[i] = c.above[i] < 0 ? std::int32_t(i) : top[c.above[i]];
    for (std::size_t i = 0; i < n; ++i) // one with a bone below it that carries another
        if (c.candidate[i] && c.above[i] >= 0 && c.above[c.above[i]] >= 0 && c.below[top[i]] == 0)
            is_bare[top[i]] = true;
    for (std::size_t i = 0; i < n; ++i) { // parents first
        if (!c.candidate[i]) continue;
        if (c.above[i] >= 0 && is_bare[c.above[i]]) is_bare[i] = true;
        if (!is_bare[i]) continue;
        if (c.above[i] < 0 && ++bare.armatures == 1) bare.name = c.scene.name[i];
        ++bare.bones;
    }
    for (std::size_t i = 0; i < n; ++i)
        if (is_bare[i]) c.candidate[i] = false;
    if (bare.bones > 0) find_above(c), sum_below(c);
    return bare;
}

// A word of a name, between what is no letter, that riggers give to bones which move others: IK_tip, hand.ctrl, PoleTarget.
bool named_as_control(std::string_view name) {
    constexpr std::array<std::string_view, 8> words{"ik",         "ctrl",   "ctl",  "control",
                                                    "controller", "target", "pole", "mch"};
    std::string word;
    const auto known = [&] { return std::find(words.begin(), words.end(), word) != words.end(); };
    for (std::size_t i = 0; i < name.size(); ++i) {
        const bool upper = name[i] >= 'A' && name[i] <= 'Z', lower = name[i] >= 'a' && name[i] <= 'z';
        const bool after_lower = i > 0 && name[i - 1] >= 'a' && name[i - 1] <= 'z';
        if ((!upper && !lower) || (upper && after_lower)) {
            if (known()) return true;
            word.clear();
        }
        if (upper || lower) word += lower_case(name[i]);
    }
    return known();
}

// Where no bone moves a vertex names alone tell: such bones go, with nothing but such bones below them, unless that would be all.
// Returns what goes: how many, and the first one's name.
std::pair<std::size_t, std::string> leave_out_named_controls(Choice& c) {
    const std::size_t n = c.candidate.size();
    std::vector<char> control(n, false);
    std::size_t bones = 0, controls = 0;
    for (std::size_t i = 0; i < n; ++i) control[i] = c.candidate[i] && named_as_control(c.scene.name[i]);
    for (std::size_t i = n; i-- > 0;)
        if (c.candidate[i] && !control[i] && c.above[i] >= 0) control[c.above[i]] = false;
    std::string first;
    for (std::size_t i = 0; i < n; ++i) {
        bones += c.candidate[i] != 0;
        if (control[i] && ++controls == 1) first = c.scene.name[i];
    }
    if (controls == 0 || controls == bones) return {0, ""};
    for (std::size_t i = 0; i < n; ++i)
        if (control[i]) c.candidate[i] = false;
    find_above(c), sum_below(c);
    return {controls, first};
}

// Nodes that could be an armature's, with others of their kind, where the file says which nodes are joints and names
// none of these.
std::size_t unnamed_chains(const Choice& c) {
    const std::size_t n = c.candidate.size();
    if (c.scene.open_are_joints) return 0;
    std::vector<char> carries(n, false); // a joint, or something to be seen
    for (std::size_t i = n; i-- > 0;) {
        if (c.candidate[i] || c.scene.role[i] != NodeRole::open) carries[i] = true;
        if (carries[i] && c.scene.parent[i] >= 0) carries[c.scene.parent[i]] = true;
    }
    std::vector<char> in_a_row(n, false);
    for (std::size_t i = 0; i < n; ++i) {
        const std::int32_t p = c.scene.parent[i];
        if (p >= 0 && !carries[i] && !carries[p] && c.above[i] < 0) in_a_row[i] = in_a_row[p] = true;
    }
    return std::size_t(std::count(in_a_row.begin(), in_a_row.end(), true));
}

void note(std::size_t count, const char* one, const char* many, ImportNotes& notes) {
    if (count > 0) notes.lines.push_back(counted(count, one, many));
}

} // namespace

ChosenJoints choose_joints(const ModelScene& scene, const Vec3& up, ImportNotes& notes) {
    Choice c = candidates(scene);
    const std::size_t n = c.candidate.size();
    const std::size_t unnamed = unnamed_chains(c);
    const std::size_t frames = leave_out_frames(c, up);
    sum_below(c);
    std::vector<char> mark(n, false);
    std::size_t neutral = 0;
    for (std::size_t i = 0; i < n; ++i) {
        if (!c.candidate[i] || !c.leaf[i]) continue;
        mark[i] = c.above[i] >= 0 && c.own[i] == 0 && named_as_end(scene.name[i]);
        if (c.above[i] < 0 && lower_case(scene.name[i]).ends_with("neutral_bone")) c.candidate[i] = false, ++neutral;
    }
    bool moves = false; // a bone of them, some vertex: else the mesh says nothing of any
    for (std::size_t i = 0; i < n; ++i) moves = moves || (c.candidate[i] && c.own[i] > 0);
    const Bare bare = moves ? leave_out_bare_armatures(c) : Bare();
    const auto [controls, control] = moves ? std::pair<std::size_t, std::string>() : leave_out_named_controls(c);
    const std::size_t idle = moves ? leave_out_idle(c, mark) : 0;
    // Where nothing says how long a bone is.
    sum_below(c);
    std::size_t alone = 0;
    for (std::size_t i = 0; i < n; ++i)
        if (c.candidate[i] && c.above[i] < 0 && c.leaf[i] && c.own[i] < 3 && !scene.tip[i].allFinite())
            c.candidate[i] = false, ++alone;
    find_above(c);

    ChosenJoints chosen;
    std::vector<std::int32_t> bone_of(n, -1);
    chosen.above.assign(n, -1);
    for (std::size_t i = 0; i < n; ++i) {
        if (c.above[i] >= 0) chosen.above[i] = bone_of[c.above[i]];
        if (!c.candidate[i]) continue;
        if (mark[i] && chosen.above[i] >= 0) {
            chosen.mark.push_back(std::int32_t(i));
            bone_of[i] = chosen.above[i];
        } else {
            bone_of[i] = std::int32_t(chosen.bone.size());
            chosen.bone.push_back(std::int32_t(i));
        }
    }
    note(frames, "node taken as the armature's frame, no bone: what is below begins beside it",
         "nodes taken as the armature's frame, no bone: what is below begins beside them", notes);
    note(idle, "bone that moves no vertex, nor anything below it, left out (control)",
         "bones that move no vertex, nor anything below them, left out (controls)", notes);
    if (bare.bones > 0)
        notes.lines.push_back(counted(bare.bones, "bone", "bones") + " of " +
                              counted(bare.armatures, "armature", "armatures") + " that move no vertex left out (" +
                              in_ascii_quotes(bare.name) + (bare.armatures > 1 ? " ..." : "") +
                              "): export what is a tree with its mesh, or alone");
    if (controls > 0)
        notes.lines.push_back(counted(controls, "bone", "bones") + " left out as " +
                              (controls == 1 ? "a control by its name (" : "controls by their names (") +
                              in_ascii_quotes(control) + (controls > 1 ? " ..." : "") + "): rename what is wood");
    note(unnamed, "node that no skin names left out: a bone of an armature without a mesh?",
         "nodes in a row that no skin names left out: bones of an armature without a mesh?", notes);
    if (!moves && !scene.vertex.empty()) notes.lines.push_back("the mesh is moved by no bone of the armature");
    note(neutral + alone, "bone that stands alone left out", "bones that stand alone left out", notes);
    return chosen;
}

} // namespace bough

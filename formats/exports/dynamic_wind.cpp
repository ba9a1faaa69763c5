#include "dynamic_wind.h"
#include "formats/text.h"
#include <algorithm>
#include <cmath>

namespace bough {

std::vector<std::int32_t> wind_groups(const Tree& tree, const JointGroups& groups) {
    std::vector<std::int32_t> made(groups.size(), 0);
    for (std::size_t g = 0; g < groups.size(); ++g) {
        if (groups.parent[g] < 0) continue;
        const std::size_t p = std::size_t(groups.parent[g]);
        const std::size_t own = std::size_t(groups.first[g]), above = std::size_t(groups.first[p]);
        const bool goes_on = tree.kind[own] == Kind::branch && tree.kind[above] == Kind::branch &&
                             tree.branch[own] == tree.branch[above];
        made[g] = made[p] + !goes_on;
    }
    return made;
}

std::vector<std::int32_t> vertical_joints(const Tree& tree, const JointGroups& groups) {
    const GroupFrames drawn = drawn_frames(tree, groups);
    const std::vector<std::int32_t> group = wind_groups(tree, groups);
    std::vector<std::int32_t> found;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const Vec3 along = drawn.R_wg[g].col(2);
        if (group[g] > 0 && std::hypot(along.x(), along.z()) < 1e-4) found.push_back(std::int32_t(g));
    }
    return found;
}

double WindInfluence::at(double s) const {
    return dual ? least + (most - least) * std::max(0.0, (s - shift) / (1 - shift)) : influence;
}

namespace {

// From 0 at the first joint of a group's branch to 1 at its last, by length.
std::vector<double> along_branches(const GroupFrames& drawn, const JointGroups& joints,
                                   const std::vector<std::int32_t>& group) {
    std::vector<double> s(joints.size(), 0), length(joints.size(), 0);
    std::vector<std::size_t> foot(joints.size());
    for (std::size_t j = 0; j < joints.size(); ++j) {
        foot[j] = j;
        const std::int32_t p = joints.parent[j];
        if (p < 0 || group[std::size_t(p)] != group[j]) continue;
        foot[j] = foot[std::size_t(p)];
        s[j] = s[std::size_t(p)] + drawn.position[j].norm();
        length[foot[j]] = std::max(length[foot[j]], s[j]);
    }
    for (std::size_t j = 0; j < joints.size(); ++j)
        if (length[foot[j]] > 0) s[j] /= length[foot[j]];
    return s;
}

struct Turn {
    double s, angle;
};

double squares_left(const std::vector<Turn>& turns, const WindInfluence& by) {
    double sum = 0;
    for (const Turn& t : turns) sum += (t.angle - by.at(t.s)) * (t.angle - by.at(t.s));
    return sum;
}

// By least squares, in radians.
WindInfluence fitted(const std::vector<Turn>& turns) {
    WindInfluence best;
    double mean = 0;
    for (const Turn& t : turns) mean += t.angle / double(turns.size());
    best.influence = mean;
    double left = 0.95 * squares_left(turns, best);
    for (int k = 0; k < 20; ++k) {
        WindInfluence tried = best;
        tried.dual = true;
        tried.least = 0;
        tried.most = 1;
        tried.shift = k / 20.0;
        double x = 0, xx = 0, xy = 0;
        for (const Turn& t : turns) {
            const double at = tried.at(t.s);
            x += at;
            xx += at * at;
            xy += at * t.angle;
        }
        const double n = double(turns.size()), spread = n * xx - x * x;
        if (!(spread > 1e-12 * n * n)) continue;
        const double slope = (n * xy - x * n * mean) / spread;
        tried.least = mean - slope * x / n;
        if (tried.least < 0) tried.least = 0;
        tried.most = tried.least > 0 ? tried.least + slope : xy / xx;
        if (tried.most < tried.least) continue;
        if (const double now = squares_left(turns, tried); now < left) {
            left = now;
            best = tried;
        }
    }
    return best;
}

} // namespace

WindMotion::WindMotion(const Tree& tree, const JointGroups& groups)
    : tree_(tree), groups_(groups), drawn_(drawn_frames(tree, groups).rotation), squares_(groups.size(), 0) {}

void WindMotion::add(std::span<const Quat> R_wb) {
    for (std::size_t j = 0; j < groups_.size(); ++j) {
        const Quat& own = R_wb[std::size_t(groups_.lead[j])];
        const std::int32_t p = groups_.parent[j];
        const Quat local = p < 0 ? own : Quat(R_wb[std::size_t(groups_.lead[std::size_t(p)])].conjugate() * own);
        const double angle = local.angularDistance(drawn_[j]);
        squares_[j] += angle * angle;
    }
    ++frames_;
}

WindFit WindMotion::fit() const {
    const std::vector<std::int32_t> group = wind_groups(tree_, groups_);
    const std::vector<double> s = along_branches(drawn_frames(tree_, groups_), groups_, group);
    std::vector<std::vector<Turn>> turns(std::size_t(*std::max_element(group.begin(), group.end())) + 1);
    for (std::size_t j = 0; j < groups_.size(); ++j)
        if (tree_.kind[std::size_t(groups_.first[j])] == Kind::branch)
            turns[std::size_t(group[j])].push_back({s[j], std::sqrt(squares_[j] / double(frames_))});
    WindFit fit;
    double n = 0, sum = 0, squares = 0, left = 0;
    for (const std::vector<Turn>& of : turns) {
        fit.group.push_back(of.empty() ? WindInfluence() : fitted(of));
        if (of.empty()) continue;
        fit.unit = std::max({fit.unit, fit.group.back().influence, fit.group.back().most});
        left += squares_left(of, fit.group.back());
        for (const Turn& t : of) ++n, sum += t.angle, squares += t.angle * t.angle;
    }
    if (n == 0) return fit;
    const double variance = squares / n - sum * sum / (n * n);
    fit.rms = std::sqrt(squares / n);
    fit.off = std::sqrt(left / n);
    fit.explained = variance > 1e-12 * squares / n ? 1 - left / n / variance : 0;
    for (std::size_t g = 0; g < turns.size(); ++g)
        if (WindInfluence& of = fit.group[g]; !turns[g].empty() && fit.unit > 0)
            for (double* number : {&of.influence, &of.least, &of.most}) *number /= fit.unit;
    return fit;
}

void write_dynamic_wind(Output& output, const Tree& tree, const JointGroups& joints, const WindFit& fit) {
    const std::vector<std::int32_t> group = wind_groups(tree, joints);
    Text text(output);
    text.add("{\n\"Joints\": [\n");
    for (std::size_t j = 0; j < joints.size(); ++j) {
        text.add("{\"JointName\": \"body_");
        text.add_number(joints.first[j]);
        text.add("\", \"SimulationGroupIndex\": ");
        text.add_number(group[j]);
        text.add(j + 1 < joints.size() ? "},\n" : "}\n");
    }
    text.add("],\n\"SimulationGroups\": [\n");
    const auto add = [&text](const char* name, double value) {
        text.add(name);
        text.add_json(value, {false, 4});
    };
    for (std::size_t g = 0; g < fit.group.size(); ++g) {
        const WindInfluence& of = fit.group[g];
        text.add(of.dual ? "{\"bUseDualInfluence\": true" : "{\"bUseDualInfluence\": false");
        add(", \"Influence\": ", of.influence);
        add(", \"MinInfluence\": ", of.least);
        add(", \"MaxInfluence\": ", of.most);
        add(", \"ShiftTop\": ", of.shift);
        text.add(", \"bIsTrunkGroup\": ");
        text.add(g == 0 ? "true" : "false");
        text.add(g + 1 < fit.group.size() ? "},\n" : "}\n");
    }
    text.add("],\n\"bIsGroundCover\": false,\n\"GustAttenuation\": 0\n}\n");
    text.hand_on();
}

} // namespace bough

#include "grow.h"

namespace bough {

GrowthParameters default_growth() {
    GrowthParameters p;
    p.name = "broadleaf";
    p.shape = 7;
    p.levels = 4;
    p.scale = 6.7;
    p.ratio = 0.0125;
    p.ratio_power = 1.15;
    p.flare = 0.5;
    LevelParameters& trunk = p.level[0];
    trunk.branches = 1;
    trunk.base_size = 0.2;
    trunk.length = 1;
    trunk.rotate_v = 180;
    trunk.taper = 0.95;
    trunk.curve_res = 10;
    trunk.curve_v = 60;
    LevelParameters& bough = p.level[1];
    bough.branches = 32;
    bough.down_angle = 60;
    bough.down_angle_v = -20;
    bough.rotate = 137.5;
    bough.rotate_v = 20;
    bough.length = 0.5;
    bough.length_v = 0.08;
    bough.taper = 0.95;
    bough.seg_splits = 0.15;
    bough.split_angle = 25;
    bough.split_angle_v = 10;
    bough.curve_res = 8;
    bough.curve = -20;
    bough.curve_v = 90;
    LevelParameters& branch = p.level[2];
    branch.branches = 16;
    branch.attraction_up = 0.3;
    branch.down_angle = 48;
    branch.down_angle_v = 12;
    branch.rotate = 140;
    branch.rotate_v = 25;
    branch.length = 0.42;
    branch.length_v = 0.1;
    branch.taper = 0.95;
    branch.curve_res = 5;
    branch.curve = -15;
    branch.curve_v = 80;
    LevelParameters& twig = p.level[3];
    twig.branches = 10;
    twig.attraction_up = 0.3;
    twig.down_angle = 45;
    twig.down_angle_v = 15;
    twig.rotate = 140;
    twig.rotate_v = 30;
    twig.length = 0.4;
    twig.length_v = 0.1;
    twig.taper = 0.9;
    twig.curve_res = 3;
    twig.curve_v = 40;
    p.leaves = 8;
    p.leaf_scale = 0.09;
    p.leaf_scale_x = 0.55;
    p.leaf_bend = 0.3;
    p.fruits = 0.3;
    p.fruit_radius = 0.008;
    p.least_radius = 0.0005;
    p.most_sag = 0.35;
    p.pipe_exponent = 2;
    return p;
}

} // namespace bough

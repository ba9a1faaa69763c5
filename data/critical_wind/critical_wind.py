#!/usr/bin/python3
"""At which wind does a tree break, and where first?

    critical_wind.py --wood WOOD --table TABLE.csv --picture PICTURE.png TREE.json WIND_0.safetensors WIND_5.safetensors ...

WIND_V.safetensors is a motion of the tree in a wind of V m/s: treesim TREE.json --set 'wind.velocity=[V,0,0]' --fields pose,stress. Its largest stress
at each joint over the wood's strength is the ratio; where that passes 1 the wood breaks. Between two winds the ratio goes with the wind's square, as drag does.
"""
import argparse
import json
import os
import re
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.collections import LineCollection
from wood_strength import strength


def tensors(path):
    """Of a safetensors file, by name."""
    with open(path, "rb") as file:
        size = int.from_bytes(file.read(8), "little")
        head, data = json.loads(file.read(size)), file.read()
    return {name: np.frombuffer(data[slice(*t["data_offsets"])], "<f8").reshape(t["shape"])
            for name, t in head.items() if name != "__metadata__" and t["dtype"] == "F64"}


def wind_of(path):
    found = re.search(r"wind_([\d.]+)\.safetensors$", path)
    if not found:
        sys.exit(f"critical_wind: {path} is not called wind_V.safetensors, V the wind in m/s")
    return float(found[1])


def crossing(winds, ratios):
    """[m/s] Where each column of ratios (winds, joints) passes 1; infinite where it does not."""
    wind = np.full(ratios.shape[1], np.inf)
    wind[ratios[0] >= 1] = winds[0]
    for a, b, low, high in zip(winds, winds[1:], ratios, ratios[1:]):
        now = np.isinf(wind) & (high >= 1)
        wind[now] = np.sqrt(a * a + (1 - low[now]) / (high[now] - low[now]) * (b * b - a * a))
    return wind


def picture(path, joints, ratios, motion, named, title):
    x, q, length = motion["position"][0], motion["rotation"][0], joints.length_m.to_numpy()
    ahead = np.stack([2 * (q[:, 0] * q[:, 2] + q[:, 3] * q[:, 1]), 2 * (q[:, 1] * q[:, 2] - q[:, 3] * q[:, 0]),
                      1 - 2 * (q[:, 0] ** 2 + q[:, 1] ** 2)], 1)
    end = x + length[:, None] * ahead
    wood = (joints.kind == 0).to_numpy()
    wind = joints.wind_m_s.to_numpy()
    most = ratios.index[-1]
    figure, (tree, rise) = plt.subplots(1, 2, figsize=(11, 6.5), width_ratios=(1, 1.15))
    order = np.flatnonzero(wood)
    lines = LineCollection(np.stack([x[order][:, :2], end[order][:, :2]], 1), cmap="turbo_r", linewidths=np.clip(joints.diameter_mm[order] / 30, 0.4, 8),
                           array=np.minimum(wind[order], most), norm=plt.Normalize(0, most), capstyle="round")
    tree.add_collection(lines)
    tree.autoscale()
    tree.set_aspect("equal")
    tree.set_xlabel("along the wind [m]")
    tree.set_ylabel("height [m]")
    tree.set_title(title)
    figure.colorbar(lines, ax=tree, label=f"wind at which the wood breaks, {most:g} or more [m/s]", shrink=0.7)
    for k, (what, row) in enumerate(named.items()):
        line, = rise.plot(ratios.index, ratios[int(row.body)], marker="o", markersize=3, linewidth=2,
                          label=f"{what}: " + (f"{row.wind_m_s:.1f} m/s" if np.isfinite(row.wind_m_s) else f"over {most:g} m/s"))
        tree.plot(*x[int(row.body)][:2], marker="o", markersize=9, markerfacecolor="none", markeredgewidth=2, color=line.get_color())
    rise.axhline(1, color="black", linewidth=1, linestyle="--")
    rise.set_ylim(0, 2)
    rise.set_xlim(ratios.index[0], most)
    rise.set_xlabel("wind at 10 m [m/s]")
    rise.set_ylabel("largest bending stress over strength")
    rise.grid(alpha=0.3)
    rise.legend()
    figure.tight_layout()
    figure.savefig(path, dpi=110)


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("tree")
    options.add_argument("motion", nargs="+")
    options.add_argument("--wood", required=True, help="preset or material's file, for its strength")
    options.add_argument("--thick", type=float, default=0.05, help="[m] branches at least so thick are named (0.05)")
    options.add_argument("--table", required=True)
    options.add_argument("--picture", required=True)
    o = options.parse_args()
    with open(o.tree) as file:
        tree = json.load(file)
    size = np.array(tree["size"]).reshape(-1, 3)
    kind = tree.get("kind", [0] * len(size))
    joints = pd.DataFrame({"branch": tree["branch"], "level": tree["level"], "kind": kind, "length_m": size[:, 0], "diameter_mm": 2000 * size[:, 1]})
    allowed = strength(o.wood)
    paths = sorted(o.motion, key=wind_of)
    motions = [tensors(path) for path in paths]
    for path, motion in zip(paths, motions):
        if motion.get("stress", np.empty((0, 0))).shape[1] != len(joints):
            sys.exit(f"critical_wind: {path} has no stress of each of the tree's {len(joints)} bodies, expected a run of it with --fields pose,stress")
    ratios = pd.DataFrame([motion["stress"].max(0) / allowed for motion in motions], index=[wind_of(path) for path in paths])
    joints["height_m"] = motions[0]["position"][0][:, 1]
    joints["ratio"] = ratios.iloc[-1]
    joints["wind_m_s"] = crossing(ratios.index.to_numpy(), ratios.to_numpy())
    joints["body"] = joints.index
    # The weakest joint of each branch; of those that stand, the one nearest to breaking.
    weakest = joints[joints.kind == 0].sort_values(["wind_m_s", "ratio"], ascending=[True, False]).drop_duplicates("branch")
    weakest[["branch", "level", "body", "height_m", "diameter_mm", "wind_m_s", "ratio"]].round(3).to_csv(o.table, index=False)
    stem, others = weakest[weakest.level == 0].iloc[0], weakest[weakest.level > 0]
    named = {"stem": stem}
    for what, rows in (("first branch", others[others.diameter_mm >= 1000 * o.thick]), ("first twig", others[others.diameter_mm < 1000 * o.thick])):
        if len(rows):
            named[what] = rows.iloc[0]
    print(f"{o.tree}: {tree.get('material') or o.wood}, strength {allowed / 1e6:g} MPa, winds {ratios.index[0]:g} to {ratios.index[-1]:g} m/s")
    for what, row in named.items():
        broken = f"breaks at {row.wind_m_s:.1f} m/s" if np.isfinite(row.wind_m_s) else f"stands at {ratios.index[-1]:g} m/s, stress {row.ratio:.2f} of its strength"
        if row.wind_m_s == 0:
            broken = "its own weight bends it past its strength, so the scan has it too thin or too long"
        print(f"{what} (branch {row.branch:.0f}, level {row.level:.0f}): {broken}; {row.diameter_mm:.0f} mm thick there, at a height of {row.height_m:.1f} m")
    bends = [motion["stress"][:, int(stem.body)] for motion in motions]
    swing = max(np.ptp(bend) / bend.max() if bend.max() > 0 else 0 for bend in bends)
    print(f"stress at the stem's joint changes by at most {100 * swing:.1f} % in the frames of a wind")
    picture(o.picture, joints, ratios, motions[0], named, f"{tree.get('name', '')} as it stands in {ratios.index[0]:g} m/s")


if __name__ == "__main__":
    main()

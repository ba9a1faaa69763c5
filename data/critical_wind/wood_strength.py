#!/usr/bin/python3
"""wood_strength.py WOOD: the strength of a preset or of a material's file, in Pa. Needs treeconvert and nothing that is to be installed."""
import csv
import json
import os
import subprocess
import sys


def strength(wood):
    """[Pa] Of a preset, or of a material's file: its own, or that of the preset that it is like."""
    name = wood
    if os.path.isfile(wood):
        try:
            with open(wood) as file:
                material = json.load(file)
            if "strength" in material:
                return float(material["strength"])
            name = material["like"]
        except (OSError, ValueError, TypeError, KeyError) as error:
            sys.exit(f"critical_wind: WOOD is '{wood}', a file without the strength of a wood, and without a preset that it is like ({error!r})")
    listed = subprocess.run(["treeconvert", "--list-materials"], stdout=subprocess.PIPE, text=True, check=True).stdout
    presets = {row["name"]: float(row["strength[Pa]"]) for row in csv.DictReader(listed.splitlines(), delimiter="\t")}
    if name not in presets:
        sys.exit(f"critical_wind: WOOD is '{wood}', no preset (treeconvert --list-materials) and no file of one")
    return presets[name]


if __name__ == "__main__":
    print(strength(sys.argv[1]))

"""own_bark.py IN.xml OUT.xml: a SpeedTree XML of spines, with a mesh of bark in it as SpeedTree's own export has: around each spine a tube with UVs,
normals, colours and BoneID. The page's young maple is made so: a tree that wears a file's own mesh. The furrows are relief and vertex colours, as the
page reads no textures."""

import math
import sys
import xml.etree.ElementTree as xml


def numbers(element, name):
    return [float(word) for word in element.find(name).text.split()]


def minus(a, b):
    return [p - q for p, q in zip(a, b)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(a):
    length = math.hypot(*a)
    return [p / length for p in a]


def distance(point, start, end):
    way = minus(end, start)
    square = sum(w * w for w in way)
    share = 0 if square == 0 else max(0, min(1, sum(w * q for w, q in zip(way, minus(point, start))) / square))
    return math.dist(point, [s + share * w for s, w in zip(start, way)])


def finer(points, radii, longest):  # [cm] so that furrows wander
    out, out_radii = [points[0]], [radii[0]]
    for k in range(1, len(points)):
        pieces = max(1, math.ceil(math.dist(points[k - 1], points[k]) / longest))
        for j in range(1, pieces + 1):
            out.append([a + j / pieces * (b - a) for a, b in zip(points[k - 1], points[k])])
            out_radii.append(radii[k - 1] + j / pieces * (radii[k] - radii[k - 1]))
    return out, out_radii


class Bark:
    def __init__(self):
        self.points, self.normals, self.uvs, self.colors, self.bones, self.triangles = [], [], [], [], [], []

    def tube(self, spine, radii, place, bones, sides, trunk):
        first, along = len(self.points), 0
        across = [1, 0, 0]
        for k, centre in enumerate(spine):
            if k > 0:
                along += math.dist(spine[k - 1], centre)
            axis = unit(minus(spine[min(k + 1, len(spine) - 1)], spine[max(k - 1, 0)]))
            side = unit(cross(axis, across))
            across = cross(side, axis)  # carried along, so that the tube is not wound
            bone = min(bones, key=lambda one: distance([c + p for c, p in zip(centre, place)], one[1], one[2]))[0]
            flare = 1 + 0.9 * math.exp(-along / 12) if trunk else 1
            for s in range(sides + 1):  # the last stands where the first does, with another u
                turn = 2 * math.pi * s / sides
                ridge = math.cos(sides / 2 * turn + 1.7 * math.sin(along / 17)) if trunk or sides > 8 else 0
                roots = 0.35 * (flare - 1) * math.cos(5 * turn)
                radius = radii[k] * (flare + roots + 0.07 * ridge)
                out = [math.cos(turn) * a + math.sin(turn) * b for a, b in zip(across, side)]
                self.points.append([c + radius * o for c, o in zip(centre, out)])
                self.normals.append(out)
                self.uvs.append((s / sides, along / 40))
                shade = 0.8 + 0.2 * ridge + 0.06 * math.sin(0.9 * along + 3 * turn)
                self.colors.append([max(0, min(1, shade * tint)) for tint in (1, 0.97, 0.92)])
                self.bones.append(bone)
                if k > 0 and s < sides:
                    a, b = first + (k - 1) * (sides + 1) + s, first + k * (sides + 1) + s
                    self.triangles += [a, a + 1, b + 1, a, b + 1, b]

    def write(self, to):
        def lists(parent, names, rows, decimals):
            for name, column in zip(names, zip(*rows)):
                xml.SubElement(parent, name).text = " ".join(f"{round(value, decimals) + 0:g}" for value in column)

        count = str(len(self.points))
        lists(xml.SubElement(to, "Points", Count=count), "XYZ", self.points, 2)  # cm
        vertices = xml.SubElement(to, "Vertices", Count=count)
        lists(vertices, ["NormalX", "NormalY", "NormalZ"], self.normals, 2)
        lists(vertices, ["TexcoordU", "TexcoordV"], self.uvs, 3)
        lists(vertices, ["VertexColorR", "VertexColorG", "VertexColorB"], self.colors, 2)
        xml.SubElement(vertices, "BoneID").text = " ".join(map(str, self.bones))
        triangles = xml.SubElement(to, "Triangles", Material="0", Count=str(len(self.triangles) // 3))
        for name in ("PointIndices", "VertexIndices"):
            xml.SubElement(triangles, name).text = " ".join(map(str, self.triangles))


def main():
    if len(sys.argv) != 3:
        sys.exit("usage: own_bark.py IN.xml OUT.xml")
    tree = xml.parse(sys.argv[1])
    root = tree.getroot()
    bones = [(int(one.get("ID")), *([float(one.get(end + axis)) for axis in "XYZ"] for end in ("Start", "End"))) for one in root.iter("Bone")]
    for one in root.iter("Object"):
        spine = one.find("Spine")
        if spine is None:
            continue
        points = [list(p) for p in zip(*(numbers(spine, axis) for axis in "XYZ"))]
        radii = [100 * r for r in numbers(spine, "Radius")]  # metres, beside positions in centimetres
        trunk = one.get("Name") == "Trunk"
        bark = Bark()
        place = [float(one.get("Abs" + axis)) for axis in "XYZ"]
        bark.tube(*finer(points, radii, 5 if trunk else 20), place, bones, 16 if trunk else 6, trunk)
        bark.write(one)
        spine.find("Radius").text = " ".join(f"{r:.5g}" for r in radii)
    for name, color in (("Bark", "0.43 0.36 0.29"), ("Leaf", "0.36 0.55 0.16")):
        material = next(one for one in root.iter("Material") if one.get("Name") == name)
        xml.SubElement(material, "Map", dict(zip(["Name", "ColorR", "ColorG", "ColorB"], ["Color", *color.split()])))
    root.attrib.update(units="cm", upAxis="Z")
    tree.write(sys.argv[2], encoding="utf-8", xml_declaration=True)


if __name__ == "__main__":
    main()

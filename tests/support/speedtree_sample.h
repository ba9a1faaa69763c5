// speedtree_sample.h: a SpeedTree file of our own making, whose mesh is known in closed form: a trunk, a branch that leaves it, leaf cards
// and twigs. In metres, Z up.
#pragma once
#include <array>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

namespace speedtree_sample {

using Point = std::array<double, 3>;

inline std::string list(const char* name, const std::vector<double>& values) {
    std::ostringstream text;
    text.precision(9);
    text << "<" << name << ">";
    for (const double v : values) text << v << " ";
    text << "</" << name << ">\n";
    return text.str();
}

// A tube along +z, or turned over to +x, of rings with `sides` corners, u once around, v its length.
struct Tube {
    Point from{0, 0, 0};
    bool level = false; // along x
    double length = 6, radius = 0.1;
    int rings = 61, sides = 12;
};

inline std::string object(int id, int parent, const Tube& tube, const std::vector<int>& bone_of_ring, bool spine) {
    std::vector<double> p[3], n[3], t[3], b[3], u, v, bone; // t: along u, b: along v
    const auto put = [&](std::vector<double>* to, double x, double y, double z) {
        to[0].push_back(tube.level ? z : x), to[1].push_back(y), to[2].push_back(tube.level ? -x : z);
    };
    for (int r = 0; r < tube.rings; ++r)
        for (int s = 0; s <= tube.sides; ++s) {
            const double a = 2 * std::numbers::pi * s / tube.sides, z = tube.length * r / (tube.rings - 1);
            if (s < tube.sides) put(p, tube.radius * std::cos(a), tube.radius * std::sin(a), z);
            put(n, std::cos(a), std::sin(a), 0);
            put(t, -std::sin(a), std::cos(a), 0);
            put(b, 0, 0, 1);
            u.push_back(double(s) / tube.sides);
            v.push_back(z);
            bone.push_back(bone_of_ring[std::size_t(r)]);
        }
    std::ostringstream points, vertices;
    for (int r = 0; r + 1 < tube.rings; ++r)
        for (int s = 0; s < tube.sides; ++s) {
            const int next = (s + 1) % tube.sides;
            for (const auto& [ring, corner, record] : {std::array{r, s, s},
                                                       {r, next, s + 1},
                                                       {r + 1, next, s + 1},
                                                       {r, s, s},
                                                       {r + 1, next, s + 1},
                                                       {r + 1, s, s}}) {
                points << ring * tube.sides + corner << " ";
                vertices << ring * (tube.sides + 1) + record << " ";
            }
        }
    std::ostringstream text;
    text << "<Object ID=\"" << id << "\" ParentID=\"" << parent << "\" Name=\"o\" AbsX=\"" << tube.from[0]
         << "\" AbsY=\"" << tube.from[1] << "\" AbsZ=\"" << tube.from[2] << "\">\n<Points>" << list("X", p[0])
         << list("Y", p[1]) << list("Z", p[2]) << "</Points>\n<Vertices>" << list("NormalX", n[0])
         << list("NormalY", n[1]) << list("NormalZ", n[2]) << list("TangentX", t[0]) << list("TangentY", t[1])
         << list("TangentZ", t[2]) << list("BinormalX", b[0]) << list("BinormalY", b[1]) << list("BinormalZ", b[2])
         << list("TexcoordU", u) << list("TexcoordV", v) << list("VertexColorR", std::vector<double>(u.size(), 0.5))
         << list("VertexColorG", u) << list("VertexColorB", std::vector<double>(u.size(), 0.25)) << list("BoneID", bone)
         << "</Vertices>\n<Triangles Material=\"7\"><PointIndices>" << points.str() << "</PointIndices><VertexIndices>"
         << vertices.str() << "</VertexIndices></Triangles>\n";
    if (spine) {
        std::vector<double> s[3], radius;
        for (int k = 0; k <= 10; ++k) {
            put(s, 0, 0, tube.length * k / 10);
            radius.push_back(tube.radius);
        }
        text << "<Spine Count=\"11\">" << list("X", s[0]) << list("Y", s[1]) << list("Z", s[2])
             << list("Radius", radius) << "</Spine>";
    }
    text << "</Object>\n";
    return text.str();
}

// `maps`: of material 7. The twig (mesh 1) is a triangular stalk without ends and six square leaves of 0.1 m, a metre long in all.
inline std::string file(const Tube& trunk, const std::string& maps, const std::string& leaves, bool spine = true) {
    std::ostringstream text;
    text << "<?xml version=\"1.0\"?>\n<SpeedTreeRaw VersionMajor=\"10\" VersionMinor=\"0\" units=\"m\" upAxis=\"Z\">\n"
         << "<Materials><Material ID=\"7\" Name=\"Bark\">" << maps
         << "</Material>\n<Material ID=\"3\" Name=\"Leaf\" TwoSided=\"1\"><Map Name=\"Color\" ColorR=\"0\" "
            "ColorG=\"0.5\" ColorB=\"0\"/></Material></Materials>\n<Meshes>\n<Mesh ID=\"1\" Name=\"twig\"><LOD "
            "Level=\"0\">";
    std::vector<double> x, y, z;
    std::ostringstream quads, triangles;
    const double r = 0.01;
    for (const double at : {0.0, 1.0})
        for (int k = 0; k < 3; ++k) {
            x.push_back(r * std::cos(2 * std::numbers::pi * k / 3));
            y.push_back(at);
            z.push_back(r * std::sin(2 * std::numbers::pi * k / 3));
        }
    for (int k = 0; k < 3; ++k) triangles << k << " " << (k + 1) % 3 << " " << 3 + k << " ";
    for (int k = 0; k < 3; ++k) triangles << (k + 1) % 3 << " " << 3 + (k + 1) % 3 << " " << 3 + k << " ";
    for (int k = 0; k < 6; ++k) {
        const double base = 0.15 * k, side = k % 2 ? 1 : -1;
        for (const auto& [a, b] : {std::array{0.02, 0.0}, {0.12, 0.0}, {0.12, 0.1}, {0.02, 0.1}}) {
            quads << x.size() << " ";
            x.push_back(side * a), y.push_back(base + b), z.push_back(0);
        }
    }
    text << "<Vertices Count=\"" << x.size() << "\">" << list("X", x) << list("Y", y) << list("Z", z)
         << "</Vertices><TriangleIndices>" << triangles.str() << "</TriangleIndices><QuadIndices>" << quads.str()
         << "</QuadIndices></LOD></Mesh>\n</Meshes>\n<Objects>\n";
    std::vector<int> bones(std::size_t(trunk.rings), 0);
    text << object(1, -1, trunk, bones, spine);
    Tube branch;
    branch.from = {0, 0, 3};
    branch.level = true;
    branch.length = 2;
    branch.radius = 0.04;
    branch.rings = 21;
    std::vector<int> own(std::size_t(branch.rings), 1);
    own[0] = 0; // as SpeedTree has it: the first ring is of the parent's bone
    text << object(2, 1, branch, own, spine) << leaves << "</Objects>\n<Bones Count=\"2\">"
         << "<Bone ID=\"0\" ParentID=\"-1\" Radius=\"" << trunk.radius
         << "\" StartX=\"0\" StartY=\"0\" StartZ=\"0\" EndX=\"0\" EndY=\"0\" EndZ=\"" << trunk.length
         << "\" Generator=\"Trunk\"/>\n<Bone ID=\"1\" ParentID=\"0\" Radius=\"0.04\" StartX=\"0\" StartY=\"0\" "
            "StartZ=\"3\" "
            "EndX=\"2\" EndY=\"0\" EndZ=\"3\" Generator=\"Branches\"/></Bones>\n</SpeedTreeRaw>\n";
    return text.str();
}

inline std::string references(int mesh) {
    return "<Object ID=\"5\" ParentID=\"2\" Name=\"Twigs\"><LeafReferences Material=\"3\" Count=\"2\"><X>1 2 </X><Y>0 "
           "0 "
           "</Y><Z>3.04 3 </Z><RotAxisX>1 0</RotAxisX><RotAxisY>0 0</RotAxisY><RotAxisZ>0 1</RotAxisZ><RotAngle>90 -90"
           "</RotAngle><Scale>1 0.5</Scale><MeshID>" +
           std::to_string(mesh) + " " + std::to_string(mesh) +
           "</MeshID><MeshLOD>0 0</MeshLOD><BoneID>1 1</BoneID></LeafReferences></Object>\n";
}

} // namespace speedtree_sample

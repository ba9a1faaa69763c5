// live_meshes.cpp: what the page draws: vertices once, and after each step how far each body is from where it was drawn.
#include "lib/model/drawn_pose.h"
#include "live.h"
#include <algorithm>
#include <cmath>
#include <numbers>

using namespace bough;
using namespace bough::c;
using namespace bough::live;

namespace {

void take_poses(MeshObject& mesh, const Simulation& run) {
    const auto x = run.positions();
    const auto r = run.rotations();
    for (std::size_t i = 0; i < mesh.now.size(); ++i) {
        const Eigen::Quaternionf turn = Eigen::Quaternionf(r[i].cast<float>()) * mesh.back[i];
        const Eigen::Vector3f place = x[i].cast<float>() - turn * mesh.joint[i];
        mesh.now[i] = {{place.x(), place.y(), place.z(), 0}, turn.coeffs()};
    }
}

// sRGB 0..255 times what a file's own vertex has, which is linear as in a .glb.
std::uint8_t tinted(std::uint8_t color, float by) {
    const double s = color / 255., linear = s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
    const double l = std::clamp(linear * double(by), 0., 1.);
    return std::uint8_t(std::lround(255 * (l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1 / 2.4) - 0.055)));
}

} // namespace

// Of a run's trees as they were drawn; a model (NULL: none) is bound where the scene has one tree. Sides: of the thickest tube.
LIVE void* live_mesh(const bough_simulation* simulation, const bough_scene* scene, const void* model, int sides) {
    return handle_of([&] {
        const Use<SimulationObject> use(simulation);
        auto mesh = std::make_shared<MeshObject>();
        mesh->drawn = std::make_shared<const Tree>(use->simulation.tree());
        const Scene own = scene_of(scene);
        if (model && own.trees.size() == 1) {
            const Placement& at = own.trees[0];
            const Eigen::Affine3d place =
                Eigen::Translation3d(at.position) * Eigen::AngleAxisd(at.yaw * std::numbers::pi / 180, Vec3::UnitY());
            std::vector<std::string> notes;
            mesh->own = bound_to(find<ModelObject>(model)->model, *mesh->drawn, place, notes);
            mesh->skin = skin_of(*mesh->own);
        } else {
            SkinOptions options;
            options.sides = sides;
            mesh->skin = build_skin(*mesh->drawn, options);
        }
        const DrawnPose pose = drawn_pose(*mesh->drawn);
        for (std::size_t i = 0; i < mesh->drawn->size_bodies(); ++i) {
            mesh->back.push_back(Eigen::Quaternionf(Quat(pose.R_wb[i]).conjugate().cast<float>()));
            mesh->joint.push_back(pose.x_w[i].cast<float>());
        }
        mesh->now.resize(mesh->back.size());
        return mesh;
    });
}

// counts: vertices, triangles, parts, bodies.
LIVE bough_result live_mesh_counts(const void* mesh, std::size_t* counts) {
    return call([&] {
        const auto own = find<MeshObject>(mesh);
        counts[0] = own->skin.position.size();
        counts[1] = own->skin.triangle.size();
        counts[2] = own->skin.part.size();
        counts[3] = own->now.size();
    });
}

// vertex: 9 floats each: position, normal (world, drawn), the two bodies that move it most and the second one's share. color: r g b 255, sRGB, its
// part's, times the vertex's own.
// index: 3 for each triangle. part: name's length in bytes, first triangle, triangles, for each. Arrays of the sizes that live_mesh_counts says.
LIVE bough_result live_mesh_arrays(const void* mesh, float* vertex, std::uint8_t* color, std::uint32_t* index,
                                   std::uint32_t* part) {
    return call([&] {
        const auto shown = find<MeshObject>(mesh);
        const Skin& skin = shown->skin;
        for (std::size_t v = 0; v < skin.position.size(); ++v) {
            float* const to = vertex + 9 * v;
            Eigen::Vector3f::Map(to) = skin.position[v].cast<float>();
            Eigen::Vector3f::Map(to + 3) = skin.normal[v].cast<float>();
            const float first = skin.weight[v][0], second = skin.weight[v][1];
            to[6] = float(skin.joint[v][0]);
            to[7] = float(skin.joint[v][1]);
            to[8] = first + second > 0 ? second / (first + second) : 0;
        }
        for (std::size_t k = 0; k < skin.part.size(); ++k) {
            const SkinPart& own = skin.part[k];
            part[3 * k] = std::uint32_t(own.name.size());
            part[3 * k + 1] = std::uint32_t(own.first_index);
            part[3 * k + 2] = std::uint32_t(own.index_count);
            for (std::size_t t = own.first_index; t < own.first_index + own.index_count; ++t)
                for (const std::int32_t v : skin.triangle[t]) {
                    for (int c = 0; c < 3; ++c) color[4 * v + c] = std::uint8_t(std::lround(255 * own.color[c]));
                    color[4 * v + 3] = 255;
                }
        }
        std::size_t v = 0; // the skin has a file's own vertices in their order
        if (shown->own)
            for (const OwnPart& part : shown->own->part)
                each_vertex(*shown->own, part, [&](const OwnSurface& from, std::size_t k, const OwnPlace*) {
                    for (std::size_t c = 0; c < 3 && !from.color.empty(); ++c)
                        color[4 * v + c] = tinted(color[4 * v + c], from.color[k][c]);
                    ++v;
                });
        for (std::size_t t = 0; t < skin.triangle.size(); ++t)
            for (std::size_t c = 0; c < 3; ++c) index[3 * t + c] = std::uint32_t(skin.triangle[t][c]);
    });
}
LIVE const char* live_mesh_part(const void* mesh, std::size_t part) {
    std::string name;
    call([&] { name = find<MeshObject>(mesh)->skin.part.at(part).name; });
    return given_out(name);
}

// After each step, and where a run begins (again: 0, before the first one).
LIVE bough_result live_take_poses(const void* mesh, const bough_simulation* simulation, int again) {
    return call([&] {
        const auto own = find<MeshObject>(mesh);
        const Use<SimulationObject> use(simulation);
        if (use->simulation.tree().size_bodies() != own->now.size()) throw WrongCall("mesh: is of other trees");
        if (again) own->before = own->now;
        take_poses(*own, use->simulation);
        if (!again) own->before = own->now;
    });
}
// At a fraction (0..1) of the way from the step before to the last: 8 floats a body, the offset's place, 0, turn.
LIVE bough_result live_write_poses(const void* mesh, float fraction, float* to) {
    return call([&] {
        const auto own = find<MeshObject>(mesh);
        for (std::size_t i = 0; i < own->now.size(); ++i, to += 8) {
            const MeshObject::Offset &a = own->before[i], &b = own->now[i];
            const float side = a.turn.dot(b.turn) < 0 ? -1.f : 1.f;
            Eigen::Vector4f::Map(to) = a.place + fraction * (b.place - a.place);
            Eigen::Vector4f::Map(to + 4) = (a.turn + fraction * (side * b.turn - a.turn)).normalized();
        }
    });
}

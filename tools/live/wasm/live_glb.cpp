// live_glb.cpp: the scene's motion from its start as an animated .glb.
#include "formats/exports/gltf.h"
#include "lib/growth/merge_joints.h"
#include "lib/simulation/loop.h"
#include "live.h"
#include <cmath>
#include <numbers>

using namespace bough;
using namespace bough::c;
using namespace bough::live;

namespace {

constexpr std::size_t most_joints = 1000;                      // some viewers fail beyond 1020
constexpr double key_tolerance = 0.1 * std::numbers::pi / 180; // [rad] as treesim's

MotionFrame frame_of(const Simulation& run, std::size_t bodies, std::int64_t frame, double fps) {
    MotionFrame made;
    made.frame = frame;
    made.time = double(frame) / fps;
    made.position.assign(run.positions().begin(), run.positions().begin() + std::ptrdiff_t(bodies));
    made.rotation.assign(run.rotations().begin(), run.rotations().begin() + std::ptrdiff_t(bodies));
    return made;
}

void step_on(Simulation& run, int steps) {
    const StepReport made = run.step(steps);
    if (!made.finite()) throw NonFinite("the simulation became non-finite: " + made.non_finite);
}

// To the page, which may show it: frames so far, and of how many (0: until it repeats).
void tell(std::int64_t done, std::int64_t of) {
    EM_ASM({ Module.progress($0, $1); }, double(done), double(of));
}

struct Asked {
    double fps;
    int steps; // a frame
    std::int64_t frames;
    bool loop;
};

// take(frame) for each frame of the scene's motion.
template <class Take> void run_frames(Scene scene, const SimulationOptions& options, const Asked& asked, Take&& take) {
    std::size_t bodies = 0;
    if (!asked.loop) {
        Simulation run(std::move(scene), options);
        bodies = run.tree().size_bodies();
        for (std::int64_t f = 0; f < asked.frames; ++f) {
            if (f > 0) step_on(run, asked.steps);
            take(frame_of(run, bodies, f, asked.fps));
        }
        return;
    }
    make_periodic(double(asked.frames) / asked.fps, scene);
    Simulation run(std::move(scene), options);
    bodies = run.tree().size_bodies();
    const ToFrame to = [&](Simulation& of, std::int64_t frame) {
        while (of.steps() < frame * asked.steps) {
            step_on(of, asked.steps);
            tell(of.steps() / asked.steps, 0);
        }
    };
    LoopOptions loop;
    loop.frames = asked.frames;
    loop.blend = true; // leaves that turn over never repeat by themselves
    LoopStart start = close_loop(run, loop, to);
    LoopBlend blend(std::move(*start.before), asked.frames, to);
    const std::int64_t first = run.steps() / asked.steps;
    MotionFrame begin;
    for (std::int64_t f = 0; f < asked.frames; ++f) {
        to(run, first + f);
        MotionFrame frame = frame_of(run, bodies, f, asked.fps);
        if (f >= asked.frames - blended_frames(asked.frames)) blend.blend(frame);
        if (f == 0) begin = frame;
        take(frame);
    }
    begin.frame = asked.frames; // players go on from the first frame again without a jump
    begin.time = double(asked.frames) / asked.fps;
    take(begin);
}

} // namespace

// frames at fps, each of so many steps; loop: one period that repeats. *size: bytes of what is given, the page's to free. NULL where it failed.
LIVE void* live_glb(const bough_scene* scene, const void* mesh, double step, int precision, double fps, int steps,
                    double frames, int loop, std::size_t* size) {
    void* bytes = nullptr;
    call_of_running([&] {
        const auto own = find<MeshObject>(mesh);
        SimulationOptions options;
        options.step = step;
        options.precision = precision == BOUGH_FLOAT ? Precision::single : Precision::double_;
        options.threads = 1;
        const Asked asked{fps, steps, std::int64_t(frames), loop != 0};
        const JointGroups groups = merge_joints(*own->drawn, most_joints);
        GltfOptions how;
        how.fps = fps;
        how.key_tolerance = key_tolerance;
        how.generator = std::string("bough ") + bough_version() + " live";
        std::size_t room = 64 * own->skin.position.size() + 12 * own->skin.triangle.size() +
                           groups.size() * (2000 + std::size_t(24 * frames)) + 300 * own->drawn->size_bodies() +
                           (1u << 20);
        for (int again = 0; again < 2; ++again) { // the room is a guess; what did not fit says how much it takes
            bytes = std::malloc(room);
            if (!bytes) throw std::bad_alloc();
            try {
                Output output(static_cast<char*>(bytes), room, "motion.glb");
                std::optional<GltfWriter> writer;
                if (own->own)
                    writer.emplace(output, *own->own, *own->drawn, groups, how);
                else
                    writer.emplace(output, own->skin, *own->drawn, groups, how);
                run_frames(scene_of(scene), options, asked, [&](const MotionFrame& frame) {
                    writer->write(frame);
                    if (!asked.loop) tell(frame.frame, asked.frames - 1);
                });
                writer->finish();
                output.finish();
                *size = std::size_t(output.bytes());
            } catch (...) {
                std::free(std::exchange(bytes, nullptr));
                throw;
            }
            if (*size <= room) return;
            std::free(std::exchange(bytes, nullptr));
            room = *size;
        }
        throw OutputError("motion.glb", "does not fit into memory");
    });
    return bytes;
}

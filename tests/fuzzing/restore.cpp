// A run is given a saved state whose numbers and lists the bytes change: it goes on from it, or refuses it and stays as it was.
#include "fuzzing.h"
#include "lib/growth/grow.h"
#include "lib/growth/segment.h"
#include "lib/model/wood.h"
#include "lib/simulation/simulation.h"
#include <cstring>
#include <type_traits>

using namespace bough;

namespace {

// What may stand in a file, and what a reader of files would refuse before (formats/documents/state.cpp).
class Edits {
public:
    Edits(const std::uint8_t* data, std::size_t size) : at_(data), end_(data + size) {}
    bool more() const { return at_ < end_; }
    std::uint8_t byte() { return more() ? *at_++ : std::uint8_t(0); }
    double number() {
        std::uint8_t bytes[8];
        for (std::uint8_t& each : bytes) each = byte();
        double value;
        std::memcpy(&value, bytes, 8);
        return value;
    }

private:
    const std::uint8_t *at_, *end_;
};

template <class Value> void change(std::vector<Value>& list, Edits& edits) {
    const std::uint8_t where = edits.byte();
    if (where == 255) {
        Value zero{};
        if constexpr (std::is_same_v<Value, Vec3>) zero.setZero();
        return list.resize(edits.byte(), zero);
    }
    if (list.empty()) return;
    Value& value = list[where % list.size()];
    if constexpr (std::is_same_v<Value, Vec3>)
        value[edits.byte() % 3] = edits.number();
    else
        value = edits.number();
}

void change(SavedState& state, Edits& edits) {
    switch (edits.byte() % 13) {
    case 0:
        state.frame = std::int64_t(edits.byte()) << (edits.byte() % 64);
        break;
    case 1:
        state.fps = edits.number();
        break;
    case 2:
        state.substeps = edits.byte() - 128;
        break;
    case 3:
        state.part = edits.byte();
        break;
    case 4:
        state.scheme = std::string(1, char(edits.byte()));
        break;
    case 5:
        return change(state.theta, edits);
    case 6:
        return change(state.theta_dot, edits);
    case 7:
        return change(state.theta_change, edits);
    case 8:
        return change(state.theta_dot_change, edits);
    case 9:
        return change(state.free_bodies, edits);
    case 10:
        return change(state.sleep, edits);
    case 11:
        return change(state.attachments, edits);
    case 12:
        return change(state.step_change, edits);
    }
}

Scene scene() {
    Scene scene;
    scene.add(segment(grow_bodies(default_growth(), 7, {true, false, true}, 60), wood_presets().front(), {}));
    Ball ball;
    ball.position = {0.5, 9, 0.2};
    scene.balls.push_back(ball);
    scene.fracture.emplace();
    Attachment held;
    held.on.body = 12;
    held.stiffness = 100;
    scene.attachments.push_back(held);
    return scene;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const Simulation start(scene(), {.step = 1 / 30.});
    static const SavedState saved = [] {
        Simulation run = start.copy();
        run.step(3);
        return run.save();
    }();
    Simulation run = start.copy();
    SavedState changed = saved;
    for (Edits edits(data, size); edits.more();) change(changed, edits);
    const std::uint64_t before = run.hash();
    try {
        run.restore(changed);
    } catch (const SceneError& error) {
        fuzzing::check_message(error.what(), "");
        if (run.hash() != before) fuzzing::fail("a run that refused a state is another");
        return 0;
    }
    run.step(2);
    return 0;
}

// handle.h: what bough_c.h's handles stand for. A handle is a number, odd, counted up and never given again, so that a freed one is known to be
// freed, and no address of anything that is aligned is taken for one.
#pragma once
#include "call.h"
#include "formats/documents/scene.h"
#include "lib/simulation/run_error.h"
#include "lib/simulation/simulation.h"
#include <atomic>
#include <memory>
#include <vector>

namespace bough::c {

struct Object {
    virtual ~Object() = default;
    virtual const char* kind() const = 0;
    std::atomic<bool> in_use{false}; // Use
};

struct SplinesObject final : Object {
    static constexpr const char* name = "splines";
    const char* kind() const override { return name; }
    Splines splines;
};
struct TreeObject final : Object {
    static constexpr const char* name = "tree";
    const char* kind() const override { return name; }
    std::shared_ptr<const Tree> tree;
    std::vector<std::size_t> first_body;
};
struct SceneObject final : Object {
    static constexpr const char* name = "scene";
    const char* kind() const override { return name; }
    SceneDocument document;
};
struct SimulationObject final : Object {
    static constexpr const char* name = "simulation";
    const char* kind() const override { return name; }
    explicit SimulationObject(Simulation s) : simulation(std::move(s)) {}
    Simulation simulation;
    std::optional<Wind> wind; // as it is by now
    std::vector<std::size_t> first_body;
    std::vector<std::int32_t> events; // what they were, as numbers
    std::vector<double> radius, mass; // of balls and walkers
    std::string explained;
    std::optional<RunError> error; // refers to the simulation
    std::string non_finite;        // the message of the step that made it so; "": none did
};

std::shared_ptr<SplinesObject> object_of(Splines);
std::shared_ptr<TreeObject> object_of(Tree);

void* give(std::shared_ptr<Object>);
std::shared_ptr<Object> find(const void* handle,
                             const char* argument); // throws WrongCall: NULL, or no handle (any more)
void release(void* handle);

template <class T> std::shared_ptr<T> find(const void* handle) {
    std::shared_ptr<Object> object = find(handle, T::name);
    if (auto own = std::dynamic_pointer_cast<T>(object)) return own;
    throw WrongCall(std::string(T::name) + ": is a handle of " + object->kind() + ", expected one of " + T::name);
}

// One that changes, or whose reading does, for as long as a call has it: no two calls at once.
template <class T> class Use {
public:
    explicit Use(const void* handle) : object_(find<T>(handle)) {
        if (object_->in_use.exchange(true, std::memory_order_acquire))
            throw WrongCall(std::string(T::name) + ": another call is using it; one thread at a time may");
    }
    ~Use() { object_->in_use.store(false, std::memory_order_release); }
    Use(const Use&) = delete;
    Use& operator=(const Use&) = delete;
    T* operator->() const { return object_.get(); }

private:
    std::shared_ptr<T> object_;
};

// Arrays of a tree's bodies, which must stay.
bough_bodies bodies_of(const Tree&, const std::vector<std::size_t>& first_body);

} // namespace bough::c

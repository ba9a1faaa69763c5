#include "handle.h"
#include <mutex>
#include <shared_mutex>
#include <unordered_map>

namespace bough::c {
namespace {

struct Registry {
    std::shared_mutex mutex;
    std::uintptr_t next = 1;
    std::unordered_map<std::uintptr_t, std::shared_ptr<Object>> objects;
};

Registry& registry() {
    static Registry& all = *new Registry; // never destroyed: handles may be freed while the program ends
    return all;
}

std::uintptr_t number(const void* handle) {
    return reinterpret_cast<std::uintptr_t>(handle);
}

} // namespace

void* give(std::shared_ptr<Object> object) {
    Registry& all = registry();
    const std::unique_lock lock(all.mutex);
    const std::uintptr_t next = all.next;
    if (next + 2 < next) throw std::length_error("all handles that there are have been given");
    all.objects.emplace(next, std::move(object));
    all.next = next + 2;
    return reinterpret_cast<void*>(next);
}

std::shared_ptr<Object> find(const void* handle, const char* argument) {
    if (!handle) throw WrongCall(std::string(argument) + ": is NULL");
    Registry& all = registry();
    const std::shared_lock lock(all.mutex);
    const auto found = all.objects.find(number(handle));
    if (found == all.objects.end())
        throw WrongCall(std::string(argument) + ": is no handle; it was freed, or never one");
    return found->second;
}

void release(void* handle) {
    if (!handle) return;
    std::shared_ptr<Object> object = find(handle, "handle"); // destroyed outside of the lock
    Registry& all = registry();
    const std::unique_lock lock(all.mutex);
    if (all.objects.erase(number(handle)) == 0) throw WrongCall("handle: was freed by another thread just now");
}

} // namespace bough::c

bough_result bough_free(void* handle) {
    return bough::c::call([&] { bough::c::release(handle); });
}

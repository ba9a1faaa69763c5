#include "held_inputs.h"
#include "open.h"
#include <map>
#include <mutex>
#include <optional>

namespace bough {
namespace {

struct Held {
    std::mutex mutex;
    std::optional<std::map<std::string, FileVersion>> version; // none: off
};

Held& held() {
    static Held all;
    return all;
}

} // namespace

void hold_inputs(bool on) {
    const std::lock_guard lock(held().mutex);
    held().version.reset();
    if (on) held().version.emplace();
}

void require_held(const std::string& path, const FileVersion& opened) {
    const std::lock_guard lock(held().mutex);
    if (!held().version) return;
    const auto [found, first] = held().version->try_emplace(path, opened);
    if (!first && found->second != opened)
        throw InputError(input_name(path), "was replaced while it was read, expected a finished file");
}

} // namespace bough

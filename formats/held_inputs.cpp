#include "held_inputs.h"
#include "error.h"
#include "input_name.h"
#include <map>
#include <mutex>
#include <optional>

namespace bough {
namespace {

struct Held {
    std::mutex mutex;
    std::optional<std::map<std::string, FileVersion>> version; // none: off
    std::map<std::string, std::shared_ptr<const std::string>> pipe;
};

Held& held() {
    static Held all;
    return all;
}

} // namespace

void hold_inputs(bool on) {
    const std::lock_guard lock(held().mutex);
    held().version.reset();
    held().pipe.clear();
    if (on) held().version.emplace();
}

void require_held(const std::string& path, const FileVersion& opened) {
    const std::lock_guard lock(held().mutex);
    if (!held().version) return;
    const auto [found, first] = held().version->try_emplace(path, opened);
    if (!first && found->second != opened)
        throw InputError(input_name(path), "was replaced while it was read, expected a finished file");
}

std::shared_ptr<const std::string> held_pipe(const std::string& path) {
    const std::lock_guard lock(held().mutex);
    const auto found = held().pipe.find(path);
    return found == held().pipe.end() ? nullptr : found->second;
}

void hold_pipe(const std::string& path, const std::string& content) {
    const std::lock_guard lock(held().mutex);
    if (held().version) held().pipe.emplace(path, std::make_shared<const std::string>(content));
}

} // namespace bough

// call.h: what every function of bough_c.h is wrapped in: nothing leaves it but a result, and the message that goes with it.
#pragma once
#include "bough_c.h"
#include "lib/simulation/scene_error.h"
#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>

namespace bough::c {

struct WrongCall : std::runtime_error { // BOUGH_USAGE
    using std::runtime_error::runtime_error;
};
struct NonFinite : std::runtime_error { // BOUGH_NON_FINITE
    using std::runtime_error::runtime_error;
};

// In a handler: what the exception's result is; its message is kept for this thread. Allocates nothing.
bough_result caught() noexcept;

template <class F> bough_result call(F&& work) noexcept {
    try {
        work();
        return BOUGH_OK;
    } catch (...) {
        return caught();
    }
}

// The same where a SceneError is the caller's mistake, not the scene's.
template <class F> bough_result call_of_running(F&& work) noexcept {
    return call([&] {
        try {
            work();
        } catch (const SceneError& error) {
            throw WrongCall(error.what());
        }
    });
}

template <class T> T& required(T* pointer, const char* argument) {
    if (!pointer) throw WrongCall(std::string(argument) + ": is NULL");
    return *pointer;
}

inline const double* required_vector(const double* v, const char* argument) {
    required(v, argument);
    for (int k = 0; k < 3; ++k)
        if (!std::isfinite(v[k])) throw WrongCall(std::string(argument) + ": is not finite, expected three numbers");
    return v;
}

inline std::string_view content(const void* bytes, std::size_t size) {
    if (!bytes && size > 0) throw WrongCall("bytes: is NULL, with a size of " + std::to_string(size));
    return {static_cast<const char*>(bytes), size};
}
inline std::string name_or_memory(const char* name) {
    return name ? name : "<memory>";
}

// What a settings struct's default function leaves in `check`.
template <class Settings> constexpr std::uint64_t mark(unsigned kind) {
    return std::uint64_t(0x626f756768) << 24 | std::uint64_t(BOUGH_ABI) << 16 | kind << 12 | sizeof(Settings);
}
template <class Settings>
const Settings& marked(const Settings* settings, unsigned kind, const char* argument, const char* made_by) {
    if (required(settings, argument).check != mark<Settings>(kind))
        throw WrongCall(std::string(argument) + ": was not made by " + made_by + " of this version");
    return *settings;
}
enum : unsigned { growth_mark = 1, conversion_mark, wind_mark, settings_mark, ground_mark };

} // namespace bough::c

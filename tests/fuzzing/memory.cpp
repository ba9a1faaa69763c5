#include "fuzzing.h"
#include <atomic>
#include <sanitizer/allocator_interface.h>

namespace bough::fuzzing {
namespace {

std::atomic<std::int64_t> held{0}, most{0};

void taken(const volatile void*, std::size_t bytes) {
    const std::int64_t now = held += std::int64_t(bytes);
    if (now > most) most = now; // of another thread's at the same time one may be lost: a bound, no account
}
void given_back(const volatile void* at) {
    if (at) held -= std::int64_t(__sanitizer_get_allocated_size(at));
}

} // namespace

void begin_memory() {
    static const int installed = __sanitizer_install_malloc_and_free_hooks(taken, given_back);
    if (installed == 0) fail("allocations cannot be counted");
    held = 0;
    most = 0;
}

std::size_t memory_peak() {
    return std::size_t(most);
}

} // namespace bough::fuzzing

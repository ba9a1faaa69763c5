// machine.cpp: what the library asks of its machine, as a page has it: one thread, where the caller does all blocks itself, in their order
// (lib/base/parallel.h); caches and memory of which nothing is said; no files.
#include "formats/free_memory.h"
#include "formats/inside.h"
#include "lib/base/caches.h"
#include "lib/base/parallel.h"

namespace bough {

int machine_threads() {
    return 1;
}
int thread_limit() {
    return 1;
}
void set_thread_limit(int) {}
int threads_for(std::size_t, double) {
    return 1;
}

namespace parallel {
void run(std::size_t blocks, int, double, Order order, Work work, const void* what) {
    for (std::size_t k = 0; k < blocks; ++k) work(what, order == Order::forward ? k : blocks - 1 - k, 0);
}
std::size_t pieces(std::size_t count, double) {
    return count > 0 ? 1 : 0;
}
} // namespace parallel

std::size_t last_cache() {
    return 0;
}
std::size_t core_cache() {
    return 0;
}
std::optional<std::size_t> free_memory() {
    return std::nullopt;
}
// There is none, which who opens it says.
bool within_reach(const std::string&, const std::string&) {
    return true;
}
const char* const out_of_reach = "";
bool opens_at_once(const std::string&) {
    return true;
}
const char* const no_regular_file = "";
void note_named_file(const std::string&) {}

} // namespace bough

#include "call.h"
#include "formats/error.h"
#include "formats/plain_text.h"
#include <cstring>
#include <new>

namespace bough::c {
namespace {

thread_local char last_message[2048]; // of fixed size, so that it is there when memory has ended

void put(const char* message) noexcept {
    const std::size_t length = std::min(std::strlen(message), sizeof last_message - 1);
    std::memcpy(last_message, message, length);
    last_message[length] = 0;
}

// A setting is called as bough_c.h calls it, not as the library's door does.
std::string with_names_of_c(std::string message) {
    const std::string own = "SimulationOptions::", of_c = "settings.";
    for (std::size_t at = 0; (at = message.find(own, at)) != std::string::npos;) message.replace(at, own.size(), of_c);
    return message;
}

// As the tools print it: in one line of valid UTF-8, whatever bytes of a document it repeats.
bough_result keep(bough_result result, const char* message) noexcept {
    put(message);
    try {
        put(valid_utf8(in_words(with_names_of_c(last_message))).c_str());
    } catch (const std::bad_alloc&) { // as it is
    }
    for (char& c : last_message) c = c == '\n' ? ' ' : c;
    return result;
}

} // namespace

bough_result caught() noexcept {
    try {
        throw;
    } catch (const WrongCall& error) {
        return keep(BOUGH_USAGE, error.what());
    } catch (const NonFinite& error) {
        return keep(BOUGH_NON_FINITE, error.what());
    } catch (const OutputError& error) {
        return keep(BOUGH_OUTPUT, error.what());
    } catch (const std::bad_alloc&) {
        return keep(BOUGH_INPUT, "out of memory");
    } catch (const std::exception& error) {
        return keep(BOUGH_INPUT, error.what());
    } catch (...) {
        return keep(BOUGH_INPUT, "an unknown error");
    }
}

} // namespace bough::c

int32_t bough_abi(void) {
    return BOUGH_ABI;
}

const char* bough_version(void) {
    return BOUGH_VERSION;
}

const char* bough_error(void) {
    return bough::c::last_message;
}

// write.h: a document into the caller's memory.
#pragma once
#include "call.h"
#include "formats/open.h"

namespace bough::c {

template <class Write> void write_to(void* buffer, std::size_t capacity, std::size_t* size, Write&& write) {
    required(size, "size");
    if (!buffer && capacity > 0) throw WrongCall("buffer: is NULL, with a capacity of " + std::to_string(capacity));
    Output to(static_cast<char*>(buffer), capacity, "<memory>");
    write(to);
    *size = std::size_t(to.bytes());
    if (capacity > 0 && *size > capacity)
        throw OutputError("<memory>",
                          "takes " + std::to_string(*size) + " bytes, the buffer has " + std::to_string(capacity));
}

} // namespace bough::c

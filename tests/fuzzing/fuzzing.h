// fuzzing.h: what the fuzzers of this folder share. A reader is given any bytes. It reads them, or refuses them as it promises: with an InputError
// of one line. Anything else that is thrown ends the fuzzer, and so does a reader that holds more memory at a time than
// most_memory() says.
#pragma once
#include "formats/error.h"
#include "formats/open.h"
#include "formats/plain_text.h"
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

namespace bough::fuzzing {

// [bytes] that reading a file of `size` bytes may take beside the file: what formats/README.md states.
constexpr std::size_t most_memory(std::size_t size, std::size_t for_each_byte) {
    return (std::size_t(4) << 20) + for_each_byte * size;
}

// Memory that was asked for since begin() and not given back, at its most. Of all threads.
void begin_memory();
std::size_t memory_peak();

[[noreturn]] inline void fail(const std::string& what) {
    std::fprintf(stderr, "fuzzing: %s\n", what.c_str());
    std::abort();
}

// As the tools print it, bytes of the file that are no text replaced (tools/tool.cpp). content: what it may repeat.
inline void check_message(const std::string& raw, std::string_view content) {
    const std::string text = valid_utf8(in_words(raw));
    if (text.empty() || raw.find('\n') != std::string::npos) fail("a message of no or several lines: " + text);
    // What the file says is not held against a message: a name that ends with "std:" before our colon, or what in_words() took for ours.
    const std::string own = lower_case(content);
    const bool has_colons = own.find("::") != std::string::npos || own.find("std:") != std::string::npos;
    if ((text.find("std::") != std::string::npos && !has_colons) ||
        (text.find("json.exception") != std::string::npos && own.find("json.exception") == std::string::npos))
        fail("a message for programmers: " + text);
}

// Calls read(content): whether it was read.
template <class Read> bool is_read(std::string_view content, Read read, std::size_t for_each_byte = 1000) {
    begin_memory();
    bool good = false;
    try {
        read(content);
        good = true;
    } catch (const InputError& error) {
        check_message(error.what(), content);
    }
    if (const std::size_t peak = memory_peak(); peak > most_memory(content.size(), for_each_byte))
        fail(std::to_string(peak) + " bytes of memory for a file of " + std::to_string(content.size()));
    return good;
}

inline std::string_view content_of(const std::uint8_t* data, std::size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

// What write(output) writes.
template <class Write> std::string written(Write write) {
    std::string bytes(1 << 16, '\0');
    for (;;) {
        Output output(bytes.data(), bytes.size(), "memory");
        write(output);
        output.finish();
        const std::size_t size = output.bytes();
        const bool whole = size <= bytes.size();
        bytes.resize(size);
        if (whole) return bytes;
    }
}

// A document of ours: what was read can be written in both forms, and each reads as the same.
template <class Read, class Write> int document(const std::uint8_t* data, std::size_t size, Read read, Write write) {
    is_read(content_of(data, size), [&](std::string_view content) {
        const auto value = read(content, "file");
        const std::string text = written([&](Output& to) { write(to, value, Form::json); });
        for (const Form form : {Form::json, Form::safetensors}) {
            const std::string again = written([&](Output& to) { write(to, value, form); });
            const auto second = read(again, "again");
            if (written([&](Output& to) { write(to, second, Form::json); }) != text)
                fail("what was written reads as something else");
        }
    });
    return 0;
}

} // namespace bough::fuzzing

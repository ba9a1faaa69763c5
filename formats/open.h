// open.h: files in and out. "-" is stdin or stdout for every format because it is decided here.
#pragma once
#include "error.h"
#include "file_version.h"
#include "input_name.h"
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace bough {

class Temporary;

// The whole content of a file, or of stdin for "-". Throws InputError for a missing or unreadable file, a directory, a device but a terminal
// and /dev/null, a read error, a file that was written to meanwhile, and a pipe that brings more than fits into free memory. An empty file
// gives an empty string (the reader of the format says what it expected).
std::string read_input(const std::string& path);

// An input of which no more is held than has been asked for: of a regular file that begins as a document in the binary form does
// (document.h), the header stands in content() and the arrays after it are read when they are wanted, so that a tree of gigabytes is
// not twice in memory. Of anything else content() is all.
class Input {
public:
    explicit Input(const std::string& path); // throws as read_input
    Input(const Input&) = delete;
    Input& operator=(const Input&) = delete;
    ~Input();
    const std::string& content() const { return content_; }
    std::string all() const; // the whole content, as read_input
    const std::string& name() const { return name_; }
    std::uint64_t size() const { return size_; } // [bytes] of all, in content() or not
    // `count` bytes from byte `at`, within size(). Throws InputError for a read error, and for a file that was written to since it was
    // opened.
    void read(std::uint64_t at, std::size_t count, char* to) const;

private:
    std::string name_, content_;
    std::uint64_t size_ = 0;
    int file_ = -1; // none: content() is all
    FileVersion opened_{};
};

// Where files stand that an input names: its folder, "." for a bare name, "" for "-", which has none.
std::string folder_of(const std::string& path);

// One output file. A regular file is written without a name or beside its own (temporary.h) and gets it by finish(), so that it appears
// whole or not at all; "-" (stdout), devices, named pipes and what another process has open (/dev/fd/3) are written directly. Buffered. A
// file that is not finished is removed by the destructor. write(), flush() and finish() throw OutputError (full disk, closed pipe, no
// permission ...). A symbolic link stays one: the file it names is replaced. A new file has the permissions that the umask gives, one
// that replaces another keeps that one's. A closed pipe, and a file larger than `ulimit -f`, are errors only where SIGPIPE and SIGXFSZ
// are ignored: tools do that first.
class Output {
public:
    explicit Output(const std::string& path);
    Output(const std::string& path, const std::string& name); // name: in messages, where the file is still to move
    // To memory, `capacity` bytes of it: what does not fit is counted (bytes()) and left out. `name` stands in messages.
    Output(char* to, std::size_t capacity, const std::string& name);
    Output(const Output&) = delete;
    Output& operator=(const Output&) = delete;
    ~Output();
    void write(std::string_view bytes);
    void flush();  // what was written so far reaches the reader of a pipe (once a frame for JSON lines)
    void finish(); // flush, close, check, rename
    // Whether what was written can still be changed: a file of our own, not stdout, a device or a pipe.
    bool changeable() const { return temporary_ != nullptr; }
    void replace(std::uint64_t at, std::string_view bytes); // from byte `at` on, within what was written
    void take_out(std::uint64_t at, std::uint64_t count);   // what follows moves up; O(what follows), 1 MiB of memory
    const std::string& name() const { return name_; }
    std::uint64_t bytes() const { return bytes_; } // written so far, taken out or not

private:
    void open_direct(const std::string& path);
    int close();
    void write_out(std::string_view bytes);
    [[noreturn]] void fail(const std::string& what, int error);

    std::string name_; // in messages
    std::string buffer_;
    std::uint64_t bytes_ = 0;
    char* memory_ = nullptr;
    std::size_t capacity_ = 0; // of memory_
    bool in_memory_ = false;
    int file_ = -1;                        // temporary_'s, or of direct output
    std::unique_ptr<Temporary> temporary_; // none: direct output
};

// Text or binary form of a document.
enum class Form { json, safetensors };

// "x.safetensors" -> safetensors, else json.
Form form_of_name(const std::string& path);

} // namespace bough

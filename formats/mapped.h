// mapped.h: an input whose content is looked at where it lies, so that files larger than the memory can be read from start to end.
#pragma once
#include "open.h"

namespace bough {

// Of a regular file its pages; of anything else ("-", pipes) all of it, as read_input. A file that becomes shorter by a page while it is
// looked at raises SIGBUS, of which tools say in a line what it means (tools/signals.cpp).
class MappedInput {
public:
    explicit MappedInput(const std::string& path); // throws as read_input
    MappedInput(const MappedInput&) = delete;
    MappedInput& operator=(const MappedInput&) = delete;
    ~MappedInput();
    std::string_view content() const { return pages_ ? std::string_view(pages_, size_) : content_; }
    // Pages leave the memory until they are looked at again, when the file is asked once more. What came from a pipe stays.
    void give_back() const;
    // Once all has been read: throws InputError if the file was written to since it was opened.
    void check() const;

private:
    std::string name_, content_;
    int file_ = -1; // of pages_
    FileVersion opened_{};
    const char* pages_ = nullptr;
    std::size_t size_ = 0;
};

} // namespace bough

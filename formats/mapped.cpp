#include "mapped.h"
#include "held_inputs.h"
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace bough {

MappedInput::MappedInput(const std::string& path) : name_(input_name(path)) {
    struct stat known {}; // asked before it is opened: a pipe is read once
    const bool regular = path != "-" && ::stat(path.c_str(), &known) == 0 && S_ISREG(known.st_mode);
    file_ = regular ? ::open(path.c_str(), O_RDONLY | O_CLOEXEC) : -1;
    if (file_ >= 0 && ::fstat(file_, &known) == 0 && S_ISREG(known.st_mode) && known.st_size > 0) {
        opened_ = settled_version(file_);
        try {
            require_held(path, opened_);
        } catch (...) {
            ::close(file_);
            throw;
        }
        void* pages = ::mmap(nullptr, std::size_t(opened_.size), PROT_READ, MAP_PRIVATE, file_, 0);
        if (pages != MAP_FAILED) {
            pages_ = static_cast<const char*>(pages);
            size_ = std::size_t(opened_.size);
        }
    }
    if (pages_) return;
    if (file_ >= 0) ::close(file_);
    content_ = read_input(path); // and what is wrong with it
}

void MappedInput::give_back() const {
    // It is advice: where it cannot be followed nothing is lost but memory.
    if (pages_) ::madvise(const_cast<char*>(pages_), size_, MADV_DONTNEED);
}

void MappedInput::check() const {
    if (pages_ && file_version(file_) != opened_)
        throw InputError(name_, "was written to while it was read, expected a finished file");
}

MappedInput::~MappedInput() {
    if (!pages_) return;
    ::munmap(const_cast<char*>(pages_), size_);
    ::close(file_);
}

} // namespace bough

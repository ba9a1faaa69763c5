#include "mapped.h"
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace bough {

MappedInput::MappedInput(const std::string& path) {
    struct stat known {}; // asked before it is opened: a pipe is read once
    const bool regular = path != "-" && ::stat(path.c_str(), &known) == 0 && S_ISREG(known.st_mode);
    const int file = regular ? ::open(path.c_str(), O_RDONLY | O_CLOEXEC) : -1;
    if (file >= 0 && ::fstat(file, &known) == 0 && S_ISREG(known.st_mode) && known.st_size > 0) {
        void* pages = ::mmap(nullptr, std::size_t(known.st_size), PROT_READ, MAP_PRIVATE, file, 0);
        if (pages != MAP_FAILED) {
            pages_ = static_cast<const char*>(pages);
            size_ = std::size_t(known.st_size);
        }
    }
    if (file >= 0) ::close(file);
    if (!pages_) content_ = read_input(path); // and what is wrong with it
}

void MappedInput::give_back() const {
    // It is advice: where it cannot be followed nothing is lost but memory.
    if (pages_) ::madvise(const_cast<char*>(pages_), size_, MADV_DONTNEED);
}

MappedInput::~MappedInput() {
    if (pages_) ::munmap(const_cast<char*>(pages_), size_);
}

} // namespace bough

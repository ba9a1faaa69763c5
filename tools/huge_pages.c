/* huge_pages.c: memory that the compiler maps comes in pages of 2 MB where the system has them (a hint, never an error). GCC takes its memory
   by mmap, a page of 4 KB at a time: on a virtual machine that is a tenth of a build. CMakeLists.txt lets compilers
   load this before their own libraries, in builds from nothing. */
#define _GNU_SOURCE
#if !(defined __x86_64__ && defined __LP64__) && !defined __aarch64__
#error "SYS_mmap is another call here"
#endif
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

void* mmap(void* at, size_t size, int protection, int flags, int file, off_t offset) {
    void* found = (void*)syscall(SYS_mmap, at, size, protection, flags, file, offset);
    if (found != MAP_FAILED && (flags & MAP_ANONYMOUS) && (protection & PROT_WRITE) && size >= 1 << 16) madvise(found, size, MADV_HUGEPAGE);
    return found;
}

void* mmap64(void* at, size_t size, int protection, int flags, int file, off64_t offset) {
    return mmap(at, size, protection, flags, file, (off_t)offset);
}

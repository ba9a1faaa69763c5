// temporary.h: a file that is being written beside the name that it is to have.
#pragma once
#include <string>

namespace bough {

// Without a name where the file system has such files (O_TMPFILE): however the process ends, nothing is left of it. Else it is
// `.bough-PID-N.tmp`, locked (flock) for as long as it is written: the destructor and remove_unfinished_outputs() remove it, and after a
// kill -9 the next process that writes in that folder does, to which the lock says that nobody writes it any more. Of other users, and
// where locks do not work, none is taken away. Errors are std::system_error.
class Temporary {
public:
    // For `path`, in whose folder it is made. mode: its permissions, 0: those that the umask gives.
    Temporary(const std::string& path, unsigned mode, bool nameless = true);
    Temporary(const Temporary&) = delete;
    Temporary& operator=(const Temporary&) = delete;
    ~Temporary();                      // gone, unless finish() has been called
    int file() const { return file_; } // open to read and write
    // Gets the name, in place of what has it, in one step that cannot be seen half done; then it is closed. Errors of the disk that the
    // system has kept back are thrown before.
    void finish();

private:
    bool open_nameless();
    void open_named();
    void give_name();

    std::string path_, folder_;
    std::string name_; // of its own; "": it has none
    int file_ = -1;
    void* registered_ = nullptr; // name_'s entry in the list of remove_unfinished_outputs()
};

// A folder that is being filled beside the name that it is to have, `.bough-PID-N.tmp`, locked and cleared away as temporary files are. Errors are
// std::system_error.
class TemporaryFolder {
public:
    explicit TemporaryFolder(const std::string& path); // path: its name to be, without a slash behind
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder(); // gone with what is in it, unless finish() has been called
    const std::string& name() const { return name_; }
    void finish(); // gets the name, which nothing, or an empty folder, may have

private:
    std::string path_, name_;
    int folder_ = -1; // holds the lock
    void* registered_ = nullptr;
};

// Removes the temporary files and folders of this process that have names, and lets no more come to be: a thread that begins one waits for ever. For
// a signal handler that is about to end the process (async-signal-safe); everywhere else the destructors do it.
void remove_unfinished_outputs() noexcept;

} // namespace bough

#include "gnuplot.h"
#include "formats/error.h"
#include "formats/plain_text.h"
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

extern char** environ;

namespace bough {
namespace {

struct Channel { // what the child reads from or writes to
    int ours = -1, its = -1;
    ~Channel() { close_its(), close_ours(); }
    void close_ours() { close_one(ours); }
    void close_its() { close_one(its); }
    static void close_one(int& fd) {
        if (fd >= 0) ::close(fd);
        fd = -1;
    }
};

struct Finished {
    std::string out, err;
    bool good = false; // ended by itself with 0
};

[[noreturn]] void fail(const std::string& name, int error) {
    if (error == ENOENT || error == EACCES)
        throw OutputError(name, "gnuplot was not found: install gnuplot, or ask for .json or .csv");
    throw OutputError(name, std::string("gnuplot cannot be started: ") + std::strerror(error));
}

// Sends and receives at the same time, so that neither side waits for the other for ever. Sockets, because a write to
// a child that has gone must be an error and not a SIGPIPE.
void talk(std::string_view input, Channel& in, Channel& out, Channel& err, Finished& result) {
    if (input.empty()) in.close_ours();
    while (out.ours >= 0 || err.ours >= 0) {
        pollfd ready[3] = {{in.ours, POLLOUT, 0}, {out.ours, POLLIN, 0}, {err.ours, POLLIN, 0}};
        if (::poll(ready, 3, -1) < 0 && errno != EINTR) break;
        if (ready[0].revents) {
            const ssize_t sent = ::send(in.ours, input.data(), input.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
            if (sent > 0) input.remove_prefix(std::size_t(sent));
            if (input.empty() || (sent < 0 && errno != EAGAIN && errno != EINTR)) in.close_ours();
        }
        const auto receive = [](Channel& from, short events, std::string& to) {
            if (!events) return;
            char buffer[1 << 16];
            const ssize_t got = ::read(from.ours, buffer, sizeof buffer);
            if (got > 0) to.append(buffer, std::size_t(got));
            if (got == 0 || (got < 0 && errno != EINTR && errno != EAGAIN)) from.close_ours();
        };
        receive(out, ready[1].revents, result.out);
        receive(err, ready[2].revents, result.err);
    }
}

int spawn(pid_t& child, const std::vector<const char*>& arguments, const Channel& in, const Channel& out,
          const Channel& err) {
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, in.its, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, out.its, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, err.its, STDERR_FILENO);
    posix_spawnattr_init(&attributes);
    sigset_t usual;
    sigemptyset(&usual);
    sigaddset(&usual, SIGPIPE);
    posix_spawnattr_setsigdefault(&attributes, &usual);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
    const int error = ::posix_spawnp(&child, arguments[0], &actions, &attributes,
                                     const_cast<char* const*>(arguments.data()), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    return error;
}

Finished run(const std::vector<const char*>& arguments, std::string_view input, const std::string& name) {
    Channel in, out, err;
    for (Channel* channel : {&in, &out, &err}) {
        int ends[2];
        if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) fail(name, errno);
        channel->ours = ends[0];
        channel->its = ends[1];
    }
    pid_t child = 0;
    if (const int error = spawn(child, arguments, in, out, err)) fail(name, error);
    for (Channel* channel : {&in, &out, &err}) channel->close_its();
    Finished result;
    talk(input, in, out, err, result);
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    result.good = WIFEXITED(status) && WEXITSTATUS(status) == 0;
    if (WIFEXITED(status) && WEXITSTATUS(status) == 127) fail(name, ENOENT); // a C library that finds out in the child
    return result;
}

} // namespace

std::string gnuplot_svg(const std::string& script, int width, int height, const std::string& name) {
    const std::string terminal = "set encoding utf8\nset terminal svg size " + std::to_string(width) + "," +
                                 std::to_string(height) +
                                 " noenhanced font 'Helvetica,Arial,sans-serif,13' background rgb 'white'\n";
    // -d: not the user's own settings. A refused line ends gnuplot, since its input is no terminal.
    const Finished result = run({"gnuplot", "-d", "-", nullptr}, terminal + script, name);
    const std::size_t start = result.out.find("<svg");
    if (!result.good || start == std::string::npos || result.out.find("</svg>") == std::string::npos) {
        std::string why = result.err;
        for (char& c : why)
            if (c == '\n') c = ' ';
        throw OutputError(name, "gnuplot failed: " + (why.empty() ? "no picture" : valid_utf8(why.substr(0, 400))));
    }
    return result.out.substr(start);
}

void require_gnuplot(const std::string& name) {
    run({"gnuplot", "--version", nullptr}, "", name);
}

std::string gnuplot_text(std::string_view raw) {
    // What means something to gnuplot stands as its octal code: a doubled quote at the start of a string, and backquotes
    // in any, are not taken literally.
    std::string text = "\"";
    for (const char c : valid_utf8(std::string(raw))) {
        switch (c) {
        case '"':
            text += "\\042";
            break;
        case '$':
            text += "\\044";
            break;
        case '\'':
            text += "\\047";
            break;
        case '@':
            text += "\\100";
            break;
        case '\\':
            text += "\\134";
            break;
        case '`':
            text += "\\140";
            break;
        default:
            text += c;
        }
    }
    return text + "\"";
}

} // namespace bough

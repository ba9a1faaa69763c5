#include "signals.h"
#include "exits.h"
#include "formats/temporary.h"
#include "progress.h"
#include <csignal>
#include <string_view>
#include <unistd.h>

namespace bough {
namespace {

volatile std::sig_atomic_t caught_signal = 0;
volatile std::sig_atomic_t at_boundary = 0;

extern "C" void on_signal(int signal) {
    const int before = caught_signal;
    caught_signal = signal;
    // At a boundary, unless this is the second one. The system sends SIGXCPU once a second.
    if (at_boundary && (before == 0 || signal == SIGXCPU)) return;
    remove_unfinished_outputs();
    clear_progress();
    _exit(128 + signal);
}

// Ends at once, as it is meant to, with the core that the system may keep.
extern "C" void on_quit(int signal) {
    remove_unfinished_outputs();
    clear_progress();
    std::signal(signal, SIG_DFL);
    std::raise(signal);
}

const char* running_tool = "";

// A page of an input that is looked at where it lies (mapped.h) is there no more, or cannot be read from its disk.
extern "C" void on_missing_page(int) {
    remove_unfinished_outputs();
    constexpr std::string_view text =
        ": an input became shorter while it was read, or its disk failed; expected a finished file\n";
    clear_progress();
    (void)!::write(STDERR_FILENO, running_tool, std::string_view(running_tool).size());
    (void)!::write(STDERR_FILENO, text.data(), text.size());
    _exit(exit_input);
}

} // namespace

void catch_signals(const char* tool) {
    running_tool = tool;
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
    std::signal(SIGBUS, on_missing_page);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXCPU, SIGQUIT}) {
        struct sigaction before;
        if (::sigaction(signal, nullptr, &before) == 0 && before.sa_handler != SIG_IGN)
            std::signal(signal, signal == SIGQUIT ? on_quit : on_signal);
    }
}

void interrupt_at_boundary() {
    at_boundary = 1;
}

bool interrupted() {
    return caught_signal != 0;
}

int interrupted_exit() {
    return 128 + (caught_signal ? int(caught_signal) : SIGINT);
}

} // namespace bough

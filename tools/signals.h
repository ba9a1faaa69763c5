// signals.h: what a tool does when it is interrupted, and when an input is cut short under it.
#pragma once

namespace bough {

// Interrupts (SIGINT, SIGTERM, SIGHUP, SIGXCPU of `ulimit -t`; not those that the caller has ignored) remove unfinished outputs and end
// the tool with 128 + the signal; SIGQUIT does so too, and dies of the signal. An input that becomes shorter, or whose disk fails, while it
// is looked at where it lies (formats/mapped.h) ends it in one line with exit_input. A closed pipe and a file larger than `ulimit -f` are
// errors of the output that is written to it. `tool` is kept.
void catch_signals(const char* tool);

// From now on the first interrupt only sets a flag: the caller looks at interrupted() at each frame and ends there. Before, in tools that
// never call it, and by a second one, the program ends at once; unfinished outputs are removed.
void interrupt_at_boundary();
bool interrupted();

// What the tool ends with when it was interrupted: 128 + the signal.
int interrupted_exit();

} // namespace bough

/// SIGINT and SIGTERM: the program ends at once with 130 or 143, except where work that looks at
/// interrupted_by() or must not be torn has asked to be told instead.
#pragma once

namespace blum::app {

/// Also of SIGXFSZ, which is ignored: a write beyond the limit on file sizes then fails like one on
/// a full disk, and the temporary file can be removed.
void catch_signals();

/// From here to the end of the program the first signal only sets a flag, which the caller looks at
/// until it writes: once files stand, the exit code is that of a run that was not interrupted. A
/// second signal ends the program all the same.
void defer_interrupts();

/// The signal that came while deferred, or 0.
[[nodiscard]] int interrupted_by();

/// Says that the run was interrupted and returns the exit code for it. Requires interrupted_by().
int report_interrupted();

}  // namespace blum::app

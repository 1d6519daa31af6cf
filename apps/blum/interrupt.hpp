/// SIGINT and SIGTERM: the program ends at once with 130 or 143, except where work that looks at
/// interrupted_by() or must not be torn has asked to be told instead.
#pragma once

namespace blum::app {

/// Also of SIGXFSZ, which is ignored: a write beyond the limit on file sizes then fails like one on a
/// full disk, and the temporary file can be removed.
void catch_signals();

/// While one is alive, the first signal only sets a flag; a second one ends the program all the
/// same. Not nested.
class DeferInterrupts {
 public:
  DeferInterrupts();
  ~DeferInterrupts();
  DeferInterrupts(const DeferInterrupts&) = delete;
  DeferInterrupts& operator=(const DeferInterrupts&) = delete;
};

/// The signal that came while deferred, or 0.
[[nodiscard]] int interrupted_by();

}  // namespace blum::app

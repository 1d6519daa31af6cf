#include "interrupt.hpp"

#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <iostream>

#include "exit_code.hpp"

namespace blum::app {
namespace {

std::atomic<bool> is_deferred{false};
std::atomic<int> caught_signal{0};
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free,
              "a signal handler may touch them");

void handle(int signal) {
  if (is_deferred && caught_signal == 0) {
    caught_signal = signal;
    return;
  }
  constexpr char kMessage[] = "blum: interrupted\n";
  // Nothing can be done about a failure here.
  [[maybe_unused]] const auto written = write(STDERR_FILENO, kMessage, sizeof kMessage - 1);
  _exit(kSignalBase + signal);
}

}  // namespace

void catch_signals() {
  struct sigaction action {};
  action.sa_handler = handle;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  action.sa_handler = SIG_IGN;
  sigaction(SIGXFSZ, &action, nullptr);
}

void defer_interrupts() { is_deferred = true; }

int interrupted_by() { return caught_signal; }

int report_interrupted() {
  std::cerr << "blum: interrupted\n";
  return kSignalBase + interrupted_by();
}

}  // namespace blum::app

/// Ends a run from outside the work: when its time is up, when the process takes too much memory,
/// or when the caller says so.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>

#include "blum/subdivision/subdivision.hpp"

namespace blum {

/// Resident memory of this process in bytes; 0 where the system does not tell.
[[nodiscard]] std::uint64_t resident_memory_bytes();

enum class Stop : std::uint8_t { kNone, kTime, kMemory, kInterrupted };

/// Watches time_limit_s, max_memory_bytes and on_progress of the options. A thread of its own looks
/// every few milliseconds if one of them is set, so that long steps end too; the workers ask in
/// between, so that no step begins too late. All functions may be called from any thread.
class RunWatch {
 public:
  /// The time counts from here.
  explicit RunWatch(const SubdivisionOptions& options);
  ~RunWatch();
  RunWatch(const RunWatch&) = delete;
  RunWatch& operator=(const RunWatch&) = delete;

  /// True from the moment on when the run should end; for ProductionEngine::stop_on.
  [[nodiscard]] const std::atomic<bool>& flag() const { return flag_; }

  /// Looks at clock and memory: should the run end, and why?
  Stop look();

  /// Seconds to the time limit, negative after it; infinite where there is none.
  [[nodiscard]] double remaining_s();

  /// How far the run is, at most as often as the worker likes. on_progress gets values that rise.
  void report(const Progress& progress);

  /// Adds to the time limit, if there is one; after kTime the run may go on. Requires that nobody
  /// works at the moment.
  void extend(double seconds);

  /// Rethrows what on_progress threw.
  void rethrow();

 private:
  using Clock = std::chrono::steady_clock;
  void stop(Stop why);
  void keep_looking();
  void tell();

  const std::uint64_t max_memory_bytes_;
  const std::function<bool(const Progress&)> on_progress_;

  std::atomic<bool> flag_{false};
  std::mutex mutex_;  // of these
  Stop why_ = Stop::kNone;
  Clock::time_point deadline_ = Clock::time_point::max();
  std::exception_ptr failure_;
  bool ended_ = false;
  std::condition_variable wake_;

  std::mutex progress_mutex_;  // of these; on_progress is called under it
  Progress progress_;
  Clock::time_point told_ = Clock::now();

  std::thread thread_;
};

}  // namespace blum

#include "blum/subdivision/run_watch.hpp"

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>

namespace blum {
namespace {

constexpr auto kPeriod = std::chrono::milliseconds(10);
/// Between two calls of on_progress during one long step.
constexpr auto kSilence = std::chrono::milliseconds(100);

std::chrono::steady_clock::duration of_seconds(double s) {
  constexpr double kYear = 3e7;  // more would overflow the clock's ticks
  return std::chrono::duration_cast<std::chrono::steady_clock::duration>(
      std::chrono::duration<double>(std::min(s, kYear)));
}

}  // namespace

std::uint64_t resident_memory_bytes() {
  std::ifstream file("/proc/self/statm");
  std::uint64_t pages = 0, resident = 0;
  if (!(file >> pages >> resident)) return 0;
  return resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

RunWatch::RunWatch(const SubdivisionOptions& options)
    : max_memory_bytes_(options.max_memory_bytes), on_progress_(options.on_progress) {
  if (options.time_limit_s > 0) deadline_ = Clock::now() + of_seconds(options.time_limit_s);
  if (options.time_limit_s > 0 || max_memory_bytes_ > 0 || on_progress_)
    thread_ = std::thread([this] { keep_looking(); });
}

RunWatch::~RunWatch() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void RunWatch::keep_looking() {
  std::unique_lock lock(mutex_);
  while (!wake_.wait_for(lock, kPeriod, [this] { return ended_; })) {
    lock.unlock();
    look();
    {
      const std::lock_guard progress_lock(progress_mutex_);
      if (Clock::now() - told_ > kSilence) tell();
    }
    lock.lock();
  }
}

Stop RunWatch::look() {
  const bool too_large = max_memory_bytes_ > 0 && resident_memory_bytes() > max_memory_bytes_;
  const std::lock_guard lock(mutex_);
  if (why_ == Stop::kNone) {
    if (too_large)
      why_ = Stop::kMemory;
    else if (Clock::now() > deadline_)
      why_ = Stop::kTime;
    flag_ = why_ != Stop::kNone;
  }
  return why_;
}

double RunWatch::remaining_s() {
  const std::lock_guard lock(mutex_);
  if (deadline_ == Clock::time_point::max()) return std::numeric_limits<double>::infinity();
  return std::chrono::duration<double>(deadline_ - Clock::now()).count();
}

void RunWatch::stop(Stop why) {
  const std::lock_guard lock(mutex_);
  why_ = why;
  flag_ = true;
}

void RunWatch::report(const Progress& progress) {
  const std::lock_guard lock(progress_mutex_);
  if (progress.leaves > progress_.leaves) progress_ = progress;
  tell();
}

void RunWatch::tell() {
  told_ = Clock::now();
  if (!on_progress_ || flag_) return;
  try {
    if (!on_progress_(progress_)) stop(Stop::kInterrupted);
  } catch (...) {
    stop(Stop::kInterrupted);
    const std::lock_guard lock(mutex_);
    failure_ = std::current_exception();
  }
}

void RunWatch::extend(double seconds) {
  const std::lock_guard lock(mutex_);
  if (deadline_ != Clock::time_point::max()) deadline_ += of_seconds(seconds);
  if (why_ != Stop::kTime) return;
  why_ = Stop::kNone;
  flag_ = false;
}

void RunWatch::rethrow() {
  const std::lock_guard lock(mutex_);
  if (failure_) std::rethrow_exception(failure_);
}

}  // namespace blum

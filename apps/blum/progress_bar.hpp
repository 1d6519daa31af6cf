/// A progress bar on stderr, drawn only if stderr is a terminal.
#pragma once

#include <chrono>
#include <mutex>

#include "blum/medial/medial_axis.hpp"

namespace blum::app {

class ProgressBar {
 public:
  ProgressBar();
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Draws at most ten times a second. May be called from any thread.
  void show(const Progress& progress);

 private:
  using Clock = std::chrono::steady_clock;
  const bool is_on_;
  bool is_drawn_ = false;
  Clock::time_point last_;
  std::mutex mutex_;
};

}  // namespace blum::app

#include "progress_bar.hpp"

#include <unistd.h>

#include <algorithm>
#include <iostream>
#include <string>

namespace blum::app {

ProgressBar::ProgressBar() : is_on_(isatty(STDERR_FILENO) == 1), last_(Clock::now()) {}

ProgressBar::~ProgressBar() {
  if (is_drawn_) std::cerr << "\r\033[K" << std::flush;
}

void ProgressBar::show(const Progress& progress) {
  if (!is_on_) return;
  const std::lock_guard lock(mutex_);
  const auto now = Clock::now();
  if (now - last_ < std::chrono::milliseconds(100)) return;
  last_ = now;
  is_drawn_ = true;
  constexpr int kWidth = 40;
  const double fraction = std::clamp(progress.volume_fraction, 0.0, 1.0);
  std::string bar(static_cast<std::size_t>(fraction * kWidth), '#');
  bar.resize(kWidth, '.');
  std::cerr << "\r[" << bar << "] " << static_cast<int>(100 * fraction) << " % of the volume, "
            << progress.leaves << " leaves\033[K" << std::flush;
}

}  // namespace blum::app

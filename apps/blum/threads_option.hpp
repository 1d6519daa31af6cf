/// --threads, the same in all commands that have it.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <thread>

namespace blum::app {

/// The number of cores, unless the option says otherwise. `what` does not depend on it.
inline CLI::Option* add_threads_option(CLI::App& command, int& threads,
                                       const std::string& what = "The result") {
  constexpr int kMost = 1024;
  threads = std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, kMost);
  return command
      .add_option("--threads", threads,
                  what + " does not depend on it (default: the number of cores)")
      ->check(CLI::Range(1, kMost));
}

}  // namespace blum::app

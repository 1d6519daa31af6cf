/// A child process that answers a line with a line, under limits.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace blum {

class HelperProcess {
 public:
  enum class Failure : std::uint8_t { kNone, kTimeout, kGone, kStopped };

  /// Starts `command` (a path and its arguments) with its standard input and output connected to
  /// this object and its address space limited (0: not at all). Failure to start shows at the
  /// first question.
  HelperProcess(const std::vector<std::string>& command, std::uint64_t memory_bytes);
  /// Kills the child if it still runs.
  ~HelperProcess();
  HelperProcess(const HelperProcess&) = delete;
  HelperProcess& operator=(const HelperProcess&) = delete;

  /// Sends the line and waits for one. After a failure the child has been killed.
  [[nodiscard]] Failure ask(std::string_view line, double wall_s, const std::atomic<bool>* stop,
                            std::string& answer);

 private:
  void kill_child();
  pid_t child_ = -1;
  int socket_ = -1;
  std::string received_;
};

}  // namespace blum

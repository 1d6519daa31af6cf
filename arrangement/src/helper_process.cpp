#include "helper_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>

namespace blum {
namespace {

using Clock = std::chrono::steady_clock;

/// In the child, between fork and exec: only what is allowed to a child of a program with threads.
[[noreturn]] void become(int socket, char* const* arguments, std::uint64_t memory_bytes) {
  dup2(socket, STDIN_FILENO);
  dup2(socket, STDOUT_FILENO);
  const int nowhere = open("/dev/null", O_WRONLY);
  if (nowhere >= 0) dup2(nowhere, STDERR_FILENO);  // CGAL explains its failures there
  const rlimit memory{memory_bytes, memory_bytes}, no_core{0, 0};
  if (memory_bytes > 0) setrlimit(RLIMIT_AS, &memory);
  setrlimit(RLIMIT_CORE, &no_core);
  execv(arguments[0], arguments);
  _exit(127);
}

}  // namespace

HelperProcess::HelperProcess(const std::vector<std::string>& command, std::uint64_t memory_bytes) {
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) return;
  std::vector<char*> arguments;
  for (const std::string& a : command) arguments.push_back(const_cast<char*>(a.c_str()));
  arguments.push_back(nullptr);
  child_ = fork();
  if (child_ == 0) become(ends[1], arguments.data(), memory_bytes);
  close(ends[1]);
  socket_ = ends[0];
}

HelperProcess::~HelperProcess() { kill_child(); }

void HelperProcess::kill_child() {
  if (socket_ >= 0) close(socket_);
  socket_ = -1;
  if (child_ <= 0) return;
  kill(child_, SIGKILL);
  while (waitpid(child_, nullptr, 0) < 0 && errno == EINTR) {
  }
  child_ = -1;
}

HelperProcess::Failure HelperProcess::ask(std::string_view line, double wall_s,
                                          const std::atomic<bool>* stop, std::string& answer) {
  const auto fail = [&](Failure f) {
    kill_child();
    return f;
  };
  const auto deadline = Clock::now() + std::chrono::duration<double>(wall_s);
  std::string out(line);
  out += '\n';
  std::size_t sent = 0;
  received_.clear();
  while (true) {
    if (const auto end = received_.find('\n'); end != std::string::npos) {
      answer = received_.substr(0, end);
      return Failure::kNone;
    }
    if (socket_ < 0) return fail(Failure::kGone);
    if (stop != nullptr && *stop) return fail(Failure::kStopped);
    if (Clock::now() >= deadline) return fail(Failure::kTimeout);
    constexpr int kStopsSeenAfterMs = 50;
    pollfd p{socket_, static_cast<short>(sent < out.size() ? POLLIN | POLLOUT : POLLIN), 0};
    if (poll(&p, 1, kStopsSeenAfterMs) < 0 && errno != EINTR) return fail(Failure::kGone);
    if ((p.revents & POLLOUT) != 0) {
      const ssize_t n =
          send(socket_, out.data() + sent, out.size() - sent, MSG_NOSIGNAL | MSG_DONTWAIT);
      if (n > 0) sent += static_cast<std::size_t>(n);
      if (n < 0 && errno != EAGAIN && errno != EINTR) return fail(Failure::kGone);
    }
    if ((p.revents & (POLLIN | POLLHUP | POLLERR)) != 0) {
      char buffer[1 << 16];
      const ssize_t n = recv(socket_, buffer, sizeof buffer, MSG_DONTWAIT);
      if (n > 0) received_.append(buffer, static_cast<std::size_t>(n));
      if (n == 0 || (n < 0 && errno != EAGAIN && errno != EINTR)) return fail(Failure::kGone);
    }
  }
}

}  // namespace blum

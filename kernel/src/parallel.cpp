#include "blum/kernel/parallel.hpp"

#include <flint/flint.h>

#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace blum {

void in_parallel(int threads, const std::function<void(int)>& body) {
  std::mutex mutex;
  std::exception_ptr failure;
  const auto guarded = [&](int thread) {
    try {
      body(thread);
    } catch (...) {
      const std::lock_guard lock(mutex);
      failure = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> started;
    for (int t = 1; t < threads; ++t) {
      try {
        started.emplace_back([&, t] {
          guarded(t);
          flint_cleanup();  // gives back what FLINT keeps for this thread
        });
      } catch (const std::system_error&) {
        break;
      }
    }
    guarded(0);
  }
  if (failure) std::rethrow_exception(failure);
}

void for_each_in_parallel(int threads, std::size_t count,
                          const std::function<void(int, std::size_t)>& body) {
  std::atomic<std::size_t> next{0};
  in_parallel(threads, [&](int thread) {
    try {
      for (std::size_t k = next++; k < count; k = next++) body(thread, k);
    } catch (...) {
      next = count;
      throw;
    }
  });
}

}  // namespace blum

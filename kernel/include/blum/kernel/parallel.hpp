/// The two shapes of parallel work that a run has.
#pragma once

#include <cstddef>
#include <functional>

namespace blum {

/// Calls body(thread) for thread = 0 .. threads - 1 at once, body(0) in the calling thread, and
/// returns when all have returned; then rethrows one of their exceptions, if there are any. Threads
/// that the system does not grant are missing: the work must not rely on all of them. With
/// threads == 1 no thread is started. Requires threads >= 1.
void in_parallel(int threads, const std::function<void(int)>& body);

/// Calls body(thread, k) once for every k in [0, count), in any order. After an exception no more
/// calls begin, and it is rethrown. Requires threads >= 1.
void for_each_in_parallel(int threads, std::size_t count,
                          const std::function<void(int, std::size_t)>& body);

}  // namespace blum

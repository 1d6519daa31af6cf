#pragma once

namespace blum::test {

/// Time limit of a run that is expected to end long before it. Sanitizers slow exact algebra down
/// most.
constexpr double patience_s(double seconds) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  return 20 * seconds;
#else
  return seconds;
#endif
}

}  // namespace blum::test

/// BLUM_CHECK: an invariant, always on. BLUM_REQUIRE: a precondition, on in debug and test builds.
#pragma once

#include <stdexcept>
#include <string>

namespace blum {
/// Thrown when an invariant is broken: a defect of the program, never of its input.
struct BrokenInvariant : std::logic_error {
  using std::logic_error::logic_error;
};
[[noreturn]] inline void broken_invariant(const char* what, const char* file, int line) {
  throw BrokenInvariant(std::string(file) + ":" + std::to_string(line) + ": " + what);
}
}  // namespace blum

#define BLUM_CHECK(condition) \
  ((condition) ? (void)0 : ::blum::broken_invariant(#condition, __FILE__, __LINE__))
#ifdef NDEBUG
#define BLUM_REQUIRE(condition) ((void)0)
#else
#define BLUM_REQUIRE(condition) BLUM_CHECK(condition)
#endif

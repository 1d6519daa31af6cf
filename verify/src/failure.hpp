/// How a check ends: a statement that does not hold, or that this checker cannot show.
#pragma once

#include <stdexcept>
#include <string>

namespace blum::verify {

/// Thrown inside the module only; verify() turns it into its answer.
class Failure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// This checker cannot tell: no statement of the certificate was found to be false.
class Undecided : public Failure {
 public:
  explicit Undecided(const std::string& what) : Failure("not shown: " + what) {}
};

inline void require(bool holds, const std::string& statement) {
  if (!holds) throw Failure(statement);
}

}  // namespace blum::verify

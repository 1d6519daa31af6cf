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

inline void require(bool holds, const std::string& statement) {
  if (!holds) throw Failure(statement);
}

}  // namespace blum::verify
